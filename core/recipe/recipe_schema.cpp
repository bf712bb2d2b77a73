#include "recipe/field_json.h"
#include "recipe/fields.h"
#include "recipe/recipe.h"
#include "volume/clean/clean_volume.h"

namespace voxtet {
namespace {

using nlohmann::json;

const char* type_name(const double&) {
  return "number";
}
const char* type_name(const bool&) {
  return "boolean";
}
const char* type_name(const std::string&) {
  return "string";
}
const char* type_name(const Eigen::Vector3d&) {
  return "vec3";
}
const char* type_name(const std::vector<Label>&) {
  return "labels";
}
const char* type_name(const std::vector<std::string>&) {
  return "names";
}
const char* type_name(const std::vector<LabelGroup>&) {
  return "label_groups";
}
template <class Whole>
requires std::is_integral_v<Whole>
const char* type_name(const Whole&) {
  return "integer";
}

class SchemaWriter {
 public:
  explicit SchemaWriter(std::string path = {}) : path_(std::move(path)) {}
  json fields = json::array(), optional_groups = json::array();

  template <class T>
  void field(const FieldInfo& info, T& value) {
    json& entry = add(info, type_name(value));
    entry["default"] = json_of(value);
    if (info.min != info.max && info.min != kAnyMin) {
      entry["min"] = info.min;
      entry["max"] = info.max;
    }
  }
  template <class Enum>
  void choice(const FieldInfo& info, Enum& value, const Choices<Enum>& choices) {
    json& entry = add(info, "enum");
    for (const Choice<Enum>& choice : choices) {
      entry["values"].push_back(choice.name);
      if (choice.value == value) entry["default"] = choice.name;
    }
  }
  template <class T>
  void group(const FieldInfo& info, T& value) {
    SchemaWriter inner(at(info.name));
    visit_fields(inner, value);
    for (json& entry : inner.fields) fields.push_back(std::move(entry));
    for (json& entry : inner.optional_groups) optional_groups.push_back(std::move(entry));
  }
  template <class T>
  void optional_group(const FieldInfo& info, std::optional<T>&) {
    optional_groups.push_back(at(info.name));
    T defaults;
    group(info, defaults);
  }
  template <class T>
  void list(const FieldInfo& info, std::vector<T>&) {
    T item;
    SchemaWriter inner;
    visit_fields(inner, item);
    json& entry = add(info, "list");
    entry["default"] = json::array();
    entry["items"] = std::move(inner.fields);
  }

 private:
  std::string at(const char* name) const { return path_.empty() ? name : path_ + "." + name; }
  json& add(const FieldInfo& info, const char* type) {
    fields.push_back({{"path", at(info.name)}, {"type", type}, {"description", info.description}});
    if (*info.unit) fields.back()["unit"] = info.unit;
    return fields.back();
  }
  std::string path_;
};

}  // namespace

json thick_stack_preset() {
  return {{"volume", {{"slice_ratio", 2}, {"align_slices", true}}},
          {"smooth", {{"iterations", 100}, {"slice_share", 0.4}}}};
}

json cleaning_preset() {
  return {{"volume",
           {{"speck_voxels", kUsualCleaning.speck_voxels},
            {"hole_voxels", kUsualCleaning.hole_voxels},
            {"handle_voxels", kUsualCleaning.handle_voxels}}}};
}

json recipe_schema() {
  Recipe defaults;
  SchemaWriter writer;
  visit_fields(writer, defaults);
  return {{"fields", std::move(writer.fields)},
          {"optional_groups", std::move(writer.optional_groups)},
          {"presets", {{"thick_stack", thick_stack_preset()}, {"cleaning", cleaning_preset()}}}};
}

}  // namespace voxtet
