#include "recipe/field_json.h"
#include "recipe/fields.h"
#include "recipe/recipe.h"

namespace voxtet {
namespace {

using nlohmann::json;

class Writer {
 public:
  json object = json::object();

  template <class T>
  void field(const FieldInfo& info, T& value) {
    object[info.name] = json_of(value);
  }
  template <class Enum>
  void choice(const FieldInfo& info, Enum& value, const Choices<Enum>& choices) {
    for (const Choice<Enum>& choice : choices)
      if (choice.value == value) object[info.name] = choice.name;
  }
  template <class T>
  void group(const FieldInfo& info, T& value) {
    object[info.name] = write(value);
  }
  template <class T>
  void optional_group(const FieldInfo& info, std::optional<T>& value) {
    if (value) object[info.name] = write(*value);
  }
  template <class T>
  void list(const FieldInfo& info, std::vector<T>& items) {
    object[info.name] = json::array();
    for (T& item : items) object[info.name].push_back(write(item));
  }

  template <class T>
  static json write(T& value) {
    Writer writer;
    visit_fields(writer, value);
    return std::move(writer.object);
  }
};

/// Keeps what differs from the defaults. Lists and vectors are kept whole; an optional group that is present
/// is kept even when all its fields are at their defaults.
json difference(const json& value, const json& defaults) {
  json out = json::object();
  for (const auto& [key, entry] : value.items()) {
    const auto other = defaults.find(key);
    if (other == defaults.end()) {
      out[key] = entry;
    } else if (entry.is_object()) {
      json inner = difference(entry, *other);
      if (!inner.empty()) out[key] = std::move(inner);
    } else if (entry != *other) {
      out[key] = entry;
    }
  }
  return out;
}

}  // namespace

json recipe_to_json(const Recipe& recipe, bool minimal) {
  Recipe copy = recipe;
  json full = Writer::write(copy);
  if (!minimal) return full;
  Recipe defaults;
  json out = difference(full, Writer::write(defaults));
  out["version"] = recipe.version;
  if (recipe.source.phantom) {
    PhantomParams standard;
    out["source"]["phantom"] = difference(full["source"]["phantom"], Writer::write(standard));
    // The kind is what the reader of a link looks for.
    out["source"]["phantom"]["kind"] = full["source"]["phantom"]["kind"];
  }
  return out;
}

}  // namespace voxtet
