#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "recipe/fields.h"
#include "recipe/migrate.h"
#include "recipe/recipe.h"

namespace voxtet {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxRecipeBytes = 1 << 20;
constexpr int kMaxDepth = 16;

/// Thrown and caught within this file only.
struct FieldError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string shown(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string shown(const json& value) {
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

[[noreturn]] void expected(const std::string& path, const json& found, const std::string& what) {
  throw FieldError(path + ": found " + shown(found) + ", expected " + what);
}

class Reader {
 public:
  Reader(const json& object, std::string path) : object_(object), path_(std::move(path)) {
    if (!object.is_object()) expected(path_.empty() ? "recipe" : path_, object, "an object of fields");
  }

  /// To be called last: whatever was not asked for is unknown.
  void refuse_unknown() const {
    for (const auto& [key, value] : object_.items()) {
      bool known = false;
      for (const std::string& name : seen_) known = known || name == key;
      if (known) continue;
      std::string names;
      for (const std::string& name : seen_) names += (names.empty() ? "" : ", ") + name;
      throw FieldError(at(key.c_str()) + ": unknown field; known here: " + names);
    }
  }

  template <class T>
  void field(const FieldInfo& info, T& value) {
    if (const json* found = find(info)) read(info, at(info.name), *found, value);
  }

  template <class Enum>
  void choice(const FieldInfo& info, Enum& value, const Choices<Enum>& choices) {
    const json* found = find(info);
    if (!found) return;
    std::string names;
    for (const Choice<Enum>& choice : choices) {
      if (*found == choice.name) {
        value = choice.value;
        return;
      }
      names += (names.empty() ? "" : ", ") + std::string(choice.name);
    }
    expected(at(info.name), *found, "one of " + names);
  }

  template <class T>
  void group(const FieldInfo& info, T& value) {
    if (const json* found = find(info)) read_object(*found, at(info.name), value);
  }

  template <class T>
  void optional_group(const FieldInfo& info, std::optional<T>& value) {
    if (const json* found = find(info)) read_object(*found, at(info.name), value.emplace());
  }

  template <class T>
  void list(const FieldInfo& info, std::vector<T>& items) {
    const json* found = find(info);
    if (!found) return;
    check_list(at(info.name), *found);
    items.clear();
    for (std::size_t i = 0; i < found->size(); ++i)
      read_object((*found)[i], at(info.name) + "[" + std::to_string(i) + "]", items.emplace_back());
  }

  template <class T>
  static void read_object(const json& object, const std::string& path, T& value) {
    Reader reader(object, path);
    visit_fields(reader, value);
    reader.refuse_unknown();
  }

 private:
  std::string at(const char* name) const { return path_.empty() ? name : path_ + "." + name; }

  const json* find(const FieldInfo& info) {
    seen_.emplace_back(info.name);
    const auto it = object_.find(info.name);
    return it == object_.end() ? nullptr : &*it;
  }

  static void check_list(const std::string& path, const json& found) {
    if (!found.is_array()) expected(path, found, "a list");
    if (found.size() > kMaxListItems)
      throw FieldError(path + ": " + std::to_string(found.size()) + " items, at most " +
                       std::to_string(kMaxListItems) + " are accepted");
  }

  static double number(const FieldInfo& info, const std::string& path, const json& found, bool whole) {
    const std::string unit = *info.unit ? std::string(" ") + info.unit : "";
    std::string what = whole ? "a whole number" : "a number";
    if (info.min != kAnyMin) what += " from " + shown(info.min) + " to " + shown(info.max) + unit;
    if (!found.is_number()) expected(path, found, what);
    const double value = found.get<double>();
    if (!std::isfinite(value) || value < info.min || value > info.max ||
        (whole && value != std::floor(value)))
      expected(path, found, what);
    return value;
  }

  static void read(const FieldInfo& info, const std::string& path, const json& found, double& value) {
    value = number(info, path, found, false);
  }
  template <class Whole>
  requires std::is_integral_v<Whole>
  static void read(const FieldInfo& info, const std::string& path, const json& found, Whole& value) {
    value = static_cast<Whole>(number(info, path, found, true));
  }
  static void read(const FieldInfo&, const std::string& path, const json& found, bool& value) {
    if (!found.is_boolean()) expected(path, found, "true or false");
    value = found.get<bool>();
  }
  static void read(const FieldInfo&, const std::string& path, const json& found, std::string& value) {
    if (!found.is_string()) expected(path, found, "a text");
    value = found.get<std::string>();
  }
  /// Numbers count as their digits: labels stand beside names.
  static void read(const FieldInfo&, const std::string& path, const json& found,
                   std::vector<std::string>& value) {
    check_list(path, found);
    value.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i].is_string() && !found[i].is_number_unsigned())
        expected(path + "[" + std::to_string(i) + "]", found[i], "a text or a label");
      value.push_back(found[i].is_string() ? found[i].get<std::string>() : found[i].dump());
    }
  }
  static void read(const FieldInfo& info, const std::string& path, const json& found,
                   Eigen::Vector3d& value) {
    if (!found.is_array() || found.size() != 3) expected(path, found, "three numbers");
    for (int d = 0; d < 3; ++d)
      value[d] =
          number(info, path + "[" + std::to_string(d) + "]", found[static_cast<std::size_t>(d)], false);
  }
  static void read(const FieldInfo& info, const std::string& path, const json& found,
                   std::vector<Label>& value) {
    if (!found.is_array()) expected(path, found, "a list of labels");
    value.clear();
    for (std::size_t i = 0; i < found.size(); ++i)
      read(info, path + "[" + std::to_string(i) + "]", found[i], value.emplace_back());
  }
  static void read(const FieldInfo& info, const std::string& path, const json& found,
                   std::vector<LabelGroup>& value) {
    check_list(path, found);
    value.clear();
    for (std::size_t i = 0; i < found.size(); ++i)
      read(info, path + "[" + std::to_string(i) + "]", found[i], value.emplace_back());
  }

  const json& object_;
  std::string path_;
  std::vector<std::string> seen_;
};

}  // namespace

Result<Recipe> parse_recipe(std::string_view text) {
  if (text.size() > kMaxRecipeBytes)
    return usage_error("recipe", "the recipe has " + std::to_string(text.size()) + " bytes, at most " +
                                     std::to_string(kMaxRecipeBytes) + " are accepted");
  const auto bounded = [](int depth, json::parse_event_t, json&) {
    if (depth > kMaxDepth) throw FieldError("nested deeper than " + std::to_string(kMaxDepth) + " levels");
    return true;
  };
  try {
    return parse_recipe(json::parse(text, bounded));
  } catch (const json::parse_error& error) {
    return usage_error("recipe", std::string("not valid JSON: ") + error.what());
  } catch (const json::out_of_range& error) {
    return usage_error("recipe", std::string("a number is out of range: ") + error.what());
  } catch (const FieldError& error) {
    return usage_error("recipe", error.what());
  }
}

Result<Recipe> parse_recipe(const json& value) {
  const Result<json> today = migrated(value);
  if (!today) return today.error();
  Recipe recipe;
  try {
    Reader::read_object(*today, "", recipe);
    const Source& source = recipe.source;
    if (source.phantom.has_value() + source.inlined.has_value() + source.file.has_value() > 1)
      throw FieldError(std::string("source: found ") + (source.phantom ? "phantom" : "inline") + " and " +
                       (source.file ? "file" : "inline") + ", expected one of them");
    if (const std::string fault = fault_of(recipe.legend); !fault.empty()) throw FieldError(fault);
  } catch (const FieldError& error) {
    return usage_error("recipe", error.what());
  }
  return recipe;
}

Result<Recipe> with_field(const Recipe& recipe, const std::string& path, const std::string& text) {
  json value = json::parse(text, nullptr, false);
  if (value.is_discarded()) value = text;
  std::string today = path;
  migrate_field(today, value);
  std::string pointer = "/" + today;
  for (char& c : pointer)
    if (c == '.' || c == '[') c = '/';
  std::erase(pointer, ']');
  json whole = recipe_to_json(recipe);
  try {
    whole[json::json_pointer(pointer)] = value;
  } catch (const json::exception&) {
    return usage_error("recipe", path + ": no such field");
  }
  return parse_recipe(whole);
}

}  // namespace voxtet
