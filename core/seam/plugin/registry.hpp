// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "seam/base/plugin_fault.hpp"
#include "seam/scene/parameters.hpp"
#include "seam/scene/schema.hpp"

namespace seam {

/// A number that a type makes, for `seam explain`: what probes and pictures may ask a field for, or a series
/// that is recorded at every step as `NAME.name`, with the scene's name of the field or interface.
struct Published {
  enum class As { quantity, series };
  As as;
  std::string name;
  std::string unit;  ///< "" for a pure number; d stands for the dimension of space
  std::string help;
};

/// All types that scenes may name, by kind ("field", "interface", "coupling", and any kind a plugin defines,
/// such as "hyperelastic"). Each entry carries the schema of its parameters and the plugin it came from.
class Registry {
 public:
  Registry();
  Registry(const Registry&);
  Registry(Registry&&) noexcept;
  Registry& operator=(const Registry&);
  Registry& operator=(Registry&&) noexcept;
  ~Registry();
  struct Entry {
    std::string kind;
    std::string name;
    std::string plugin;  ///< "core" for what is built in
    Schema schema;
    std::type_index interface = typeid(void);
    /// Holds a std::function<std::unique_ptr<Interface>(const Parameters&, const Registry&)>.
    std::shared_ptr<void> factory;
  };

  template <class Interface>
  using Factory = std::function<std::unique_ptr<Interface>(const Parameters&, const Registry&)>;

  /// Registers a type that implements `Interface`.
  /// @throws Error when the kind already has this name, naming both plugins.
  template <class Interface>
  void add(const std::string& kind, const std::string& name, Schema schema, Factory<Interface> factory) {
    insert({kind, name, current_plugin_, std::move(schema), typeid(Interface),
            std::make_shared<Factory<Interface>>(std::move(factory))});
  }

  /// Builds an object of the type that `parameters.type()` names.
  /// @throws Error when the kind has no such type or it implements another interface;
  /// PluginFault when the plugin's code throws what is no seam::Error.
  template <class Interface>
  std::unique_ptr<Interface> create(const std::string& kind, const Parameters& parameters) const {
    const Entry& entry = require(kind, parameters.type(), typeid(Interface), parameters.where());
    return call_plugin(
        parameters.where(), [&] { return describe(entry); },
        [&] { return (*static_cast<const Factory<Interface>*>(entry.factory.get()))(parameters, *this); });
  }

  /// "coupling 'contact' of plugin 'nitsche_fsci'", for messages.
  [[nodiscard]] static std::string describe(const Entry& entry);
  /// Says what a type that was added makes, all that it can: what a scene gets of it may depend on its keys.
  /// The conformance kit compares it with what is made.
  /// @throws Error when there is no such type
  void publishes(const std::string& kind, const std::string& name, std::vector<Published> what);
  [[nodiscard]] const std::vector<Published>& published(const std::string& kind,
                                                        const std::string& name) const;

  [[nodiscard]] const Entry* find(const std::string& kind, const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names(const std::string& kind) const;
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

  /// Entries added from now on belong to this plugin.
  void set_current_plugin(const std::string& name) { current_plugin_ = name; }
  /// Takes out everything a plugin has added (when its registration failed half way).
  void remove_plugin(const std::string& name);

 private:
  void insert(Entry entry);
  [[nodiscard]] const Entry& require(const std::string& kind, const std::string& name,
                                     std::type_index interface, const Location& where) const;
  std::vector<Entry> entries_;
  std::string current_plugin_ = "core";
  std::map<std::pair<std::string, std::string>, std::vector<Published>> published_;  ///< by kind and name
};

}  // namespace seam
