# seam_add_plugin(name
#   VERSION 1.0.0                 of the plugin
#   LICENSE BSD-3-Clause          SPDX identifier
#   SOURCES a.cpp b.cpp           one of them holds SEAM_PLUGIN(registry) { ... }
#   PROVIDES kind:name ...        the types it registers, all of them
#   [REQUIRES plugin ...])        plugins whose types it builds on
#
# Scenes in the folder conformance/ beside its CMakeLists.txt are what `seam plugin test` checks it on; they go where
# the plugin goes.
#
# Makes the target seam_plugin_<name>, the file lib/plugins/libseam_<name>.so in the build folder, and installs it
# into the folder where an installed Seam looks for plugins. It may link further libraries as any target does.
function(seam_add_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 plugin "" "VERSION;LICENSE" "SOURCES;PROVIDES;REQUIRES")
  if(plugin_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "seam_add_plugin(${name}): unknown arguments ${plugin_UNPARSED_ARGUMENTS}")
  endif()
  foreach(needed VERSION LICENSE SOURCES PROVIDES)
    if(NOT plugin_${needed})
      message(FATAL_ERROR "seam_add_plugin(${name}): ${needed} is missing")
    endif()
  endforeach()
  list(JOIN plugin_PROVIDES " " provides)
  list(JOIN plugin_REQUIRES " " requires)

  set(target seam_plugin_${name})
  add_library(${target} MODULE ${plugin_SOURCES})
  target_link_libraries(${target} PRIVATE Seam::core)
  target_compile_features(${target} PRIVATE cxx_std_20)
  if(TARGET seam_precompiled)  # those of Seam itself
    target_precompile_headers(${target} REUSE_FROM seam_precompiled)
  endif()
  target_compile_definitions(
    ${target} PRIVATE "SEAM_PLUGIN_NAME=\"${name}\"" "SEAM_PLUGIN_VERSION=\"${plugin_VERSION}\""
                      "SEAM_PLUGIN_LICENSE=\"${plugin_LICENSE}\"" "SEAM_PLUGIN_REQUIRES=\"${requires}\""
                      "SEAM_PLUGIN_PROVIDES=\"${provides}\"")
  set_target_properties(
    ${target} PROPERTIES OUTPUT_NAME seam_${name} PREFIX lib SUFFIX .so CXX_VISIBILITY_PRESET hidden
                         LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/plugins)
  install(TARGETS ${target} LIBRARY DESTINATION ${SEAM_PLUGIN_DIR})
  set(scenes ${CMAKE_CURRENT_SOURCE_DIR}/conformance)
  if(IS_DIRECTORY ${scenes})
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/lib/plugins/conformance)
    file(CREATE_LINK ${scenes} ${CMAKE_BINARY_DIR}/lib/plugins/conformance/${name} SYMBOLIC)
    install(DIRECTORY ${scenes}/ DESTINATION ${SEAM_PLUGIN_DIR}/conformance/${name})
  endif()
endfunction()
