#include "recipe/field_json.h"
#include "recipe/fields.h"
#include "recipe/recipe.h"

namespace voxtet {
namespace {

using nlohmann::json;

bool is_bounded(const FieldInfo& info) {
  return info.min != info.max && info.min != kAnyMin;
}

json number_of(const FieldInfo& info, const char* type) {
  json out{{"type", type}};
  if (is_bounded(info)) {
    out["minimum"] = info.min;
    out["maximum"] = info.max;
  }
  return out;
}

json list_of(json items) {
  return {{"type", "array"}, {"maxItems", kMaxListItems}, {"items", std::move(items)}};
}

json type_of(const FieldInfo& info, const double&) {
  return number_of(info, "number");
}
template <class Whole>
requires std::is_integral_v<Whole> json type_of(const FieldInfo& info, const Whole&) {
  return number_of(info, "integer");
}
json type_of(const FieldInfo&, const bool&) {
  return {{"type", "boolean"}};
}
json type_of(const FieldInfo&, const std::string&) {
  return {{"type", "string"}};
}
json type_of(const FieldInfo& info, const Eigen::Vector3d&) {
  return {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", number_of(info, "number")}};
}
/// As many as there are labels.
json type_of(const FieldInfo& info, const std::vector<Label>&) {
  return {{"type", "array"}, {"items", number_of(info, "integer")}};
}
json type_of(const FieldInfo&, const std::vector<std::string>&) {
  return list_of({{"type", json::array({"string", "integer"})}});
}
json type_of(const FieldInfo& info, const std::vector<LabelGroup>&) {
  return list_of(type_of(info, std::vector<Label>{}));
}

class JsonSchemaWriter {
 public:
  json properties = json::object();

  template <class T>
  void field(const FieldInfo& info, T& value) {
    json& entry = add(info, type_of(info, value));
    entry["default"] = json_of(value);
    if (*info.unit) entry["description"] = std::string(info.description) + " Unit: " + info.unit + ".";
  }
  template <class Enum>
  void choice(const FieldInfo& info, Enum& value, const Choices<Enum>& choices) {
    json& entry = add(info, {{"enum", json::array()}});
    for (const Choice<Enum>& choice : choices) {
      entry["enum"].push_back(choice.name);
      if (choice.value == value) entry["default"] = choice.name;
    }
  }
  template <class T>
  void group(const FieldInfo& info, T& value) {
    add(info, object_of(value));
  }
  template <class T>
  void optional_group(const FieldInfo& info, std::optional<T>&) {
    T defaults;
    group(info, defaults);
  }
  template <class T>
  void list(const FieldInfo& info, std::vector<T>&) {
    T item;
    add(info, list_of(object_of(item)));
  }

  template <class T>
  static json object_of(T& value) {
    JsonSchemaWriter inner;
    visit_fields(inner, value);
    return {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(inner.properties)}};
  }

 private:
  json& add(const FieldInfo& info, json type) {
    json& entry = properties[info.name] = std::move(type);
    entry["description"] = info.description;
    return entry;
  }
};

}  // namespace

json recipe_json_schema() {
  Recipe defaults;
  json out = JsonSchemaWriter::object_of(defaults);
  out["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  out["title"] = "A case of voxtet: what is meshed and simulated, and how";
  // At most one of them says where the labels come from.
  json& source = out["properties"]["source"];
  source["not"]["anyOf"] = json::array();
  for (const auto& [one, other] : {std::pair{"phantom", "inline"}, {"phantom", "file"}, {"inline", "file"}})
    source["not"]["anyOf"].push_back({{"required", json::array({one, other})}});
  return out;
}

}  // namespace voxtet
