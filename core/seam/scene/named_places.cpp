// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <map>

#include "seam/scene/cross_check.hpp"

namespace seam {

namespace {

/// What an object speaks of, and the fields that it and those around it name, by key.
struct Around : NamedPlace {
  std::map<std::string, std::string> fields;
  void speak_of(const NamedPlace& other) { static_cast<NamedPlace&>(*this) = other; }
};

/// Walks values and schema side by side. Objects inside a field or next to a key `field` speak of that
/// field's mesh.
class Walker {
 public:
  Walker(const Parameters& root, const Registry& registry) : registry_(registry) {
    if (!root.has("fields")) return;
    for (const auto& [name, values] : root.map("fields")) {
      const Registry::Entry* entry = registry_.find("field", values.type());
      if (entry && names_target(values, entry->schema, "mesh", "mesh"))
        mesh_of_field_[name] = values.text("mesh");
    }
  }

  void object(const Parameters& values, const Schema& schema, const std::string& path, Around around) {
    for (const Parameter& p : schema.parameters())
      if (names_target(values, schema, p.name, "field")) around.fields[p.name] = values.text(p.name);
    if (names_target(values, schema, "field", "field")) around.speak_of(of_field(values.text("field")));
    if (names_target(values, schema, "mesh", "mesh")) around.mesh = values.text("mesh");
    for (const Parameter& p : schema.parameters()) {
      if (values.has(p.name)) parameter(values, p, path.empty() ? p.name : path + "." + p.name, around);
    }
  }

  std::vector<NamedPlace> places;

 private:
  static bool names_target(const Parameters& values, const Schema& schema, const std::string& key,
                           const std::string& target) {
    const Parameter* p = schema.find(key);
    return p && p->kind == ValueKind::reference && p->target == target && values.has(key);
  }

  /// A place that speaks of the mesh of a field, when both are there.
  [[nodiscard]] NamedPlace of_field(const std::string& name) const {
    NamedPlace place;
    place.field = name;
    const auto it = mesh_of_field_.find(name);
    if (it != mesh_of_field_.end()) place.mesh = it->second;
    return place;
  }

  void add(const Parameters& values, const Parameter& p, const std::string& name, const std::string& path,
           const Around& around) {
    NamedPlace place = around;
    const std::size_t colon = p.target.find(':');
    place.target = p.target.substr(0, colon);
    if (colon != std::string::npos) {
      const auto field = around.fields.find(p.target.substr(colon + 1));
      place = field != around.fields.end() ? of_field(field->second) : NamedPlace{};
      place.target = p.target.substr(0, colon);
    }
    place.types = p.types;
    place.name = name;
    place.path = path;
    place.where = values.where(p.name);
    places.push_back(std::move(place));
  }

  /// Inverses for single fields stand under the names of these.
  void add_field(const std::string& name, const std::string& path, const Location& where) {
    NamedPlace place;
    place.target = "field";
    place.name = name;
    place.path = path;
    place.where = where;
    places.push_back(std::move(place));
  }

  void typed(const Parameters& values, const std::string& kind, const std::string& path,
             const Around& around) {
    if (const Registry::Entry* entry = registry_.find(kind, values.type()))
      object(values, entry->schema, path, around);
  }

  void parameter(const Parameters& values, const Parameter& p, const std::string& path,
                 const Around& around) {
    switch (p.kind) {
      case ValueKind::reference:
        add(values, p, values.text(p.name), path, around);
        break;
      case ValueKind::names:
        for (const std::string& name : values.names(p.name)) add(values, p, name, path, around);
        break;
      case ValueKind::object:
        object(values.object(p.name), *p.sub, path, around);
        break;
      case ValueKind::typed:
        typed(values.object(p.name), p.target, path, around);
        break;
      case ValueKind::list:
      case ValueKind::typed_list: {
        int i = 0;
        for (const Parameters& entry : values.list(p.name)) {
          const std::string place = fmt::format("{}[{}]", path, i++);
          p.kind == ValueKind::list ? object(entry, *p.sub, place, around)
                                    : typed(entry, p.target, place, around);
        }
        break;
      }
      case ValueKind::map:
      case ValueKind::typed_map:
        for (const auto& [name, entry] : values.map(p.name)) {
          const std::string place = path + "." + name;
          Around inside = around;
          if (path == "fields") inside.speak_of(of_field(name));
          if (p.target == "block_inverse") add_field(name, place, entry.where());
          p.kind == ValueKind::map ? object(entry, *p.sub, place, inside)
                                   : typed(entry, p.target, place, inside);
        }
        break;
      default:
        break;
    }
  }

  const Registry& registry_;
  std::map<std::string, std::string> mesh_of_field_;
};

}  // namespace

std::vector<NamedPlace> named_places(const Parameters& root, const Registry& registry) {
  static const Schema schema = scene_schema();
  Walker walker(root, registry);
  walker.object(root, schema, "", {});
  return std::move(walker.places);
}

}  // namespace seam
