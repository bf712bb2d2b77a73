#include "io/volume/formats/metaimage_header.h"

#include <array>
#include <string_view>
#include <utility>

#include "io/bytes/header_text.h"

namespace voxtet {
namespace {

/// Fields that decide where or what the voxels are; synonyms share a canonical name.
constexpr std::array<std::pair<const char*, const char*>, 26> kFields{{
    {"ObjectType", "ObjectType"},
    {"ObjectSubType", "ObjectSubType"},
    {"NDims", "NDims"},
    {"BinaryData", "BinaryData"},
    {"BinaryDataByteOrderMSB", "BinaryDataByteOrderMSB"},
    {"ElementByteOrderMSB", "BinaryDataByteOrderMSB"},
    {"CompressedData", "CompressedData"},
    {"CompressedDataSize", "CompressedDataSize"},
    {"TransformMatrix", "TransformMatrix"},
    {"Rotation", "TransformMatrix"},
    {"Orientation", "TransformMatrix"},
    {"Offset", "Offset"},
    {"Position", "Offset"},
    {"Origin", "Offset"},
    {"DistanceUnits", "DistanceUnits"},
    {"AnatomicalOrientation", "AnatomicalOrientation"},
    {"ElementSpacing", "ElementSpacing"},
    {"ElementSize", "ElementSize"},
    {"DimSize", "DimSize"},
    {"HeaderSize", "HeaderSize"},
    {"ElementNumberOfChannels", "ElementNumberOfChannels"},
    {"ElementToIntensityFunctionSlope", "ElementToIntensityFunctionSlope"},
    {"ElementToIntensityFunctionOffset", "ElementToIntensityFunctionOffset"},
    {"ElementType", "ElementType"},
    {"ElementDataFile", "ElementDataFile"},
    {"CenterOfRotation", "CenterOfRotation"},
}};

/// Whether one inserted, dropped or replaced character, or two swapped ones, turn `a` into `b`.
bool one_edit_apart(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  if (b.size() - a.size() > 1 || a == b) return false;
  std::size_t same = 0;
  while (same < a.size() && a[same] == b[same]) ++same;
  if (a.size() < b.size()) return a.substr(same) == b.substr(same + 1);
  if (a.substr(same + 1) == b.substr(same + 1)) return true;
  return same + 1 < a.size() && a[same] == b[same + 1] && a[same + 1] == b[same] &&
         a.substr(same + 2) == b.substr(same + 2);
}

}  // namespace

Result<MetaImageHeader> parse_metaimage_header(std::span<const std::uint8_t> bytes) {
  MetaImageHeader header;
  bool ended = false;
  while (const auto line = next_line(bytes, header.data_at, ended)) {
    if (trimmed(*line).empty() && ended) continue;
    const std::size_t equals = line->find('=');
    if (equals == std::string_view::npos)
      return bad_metaimage("the header line " + in_quotes(*line) + " is not of the form Key = Value");
    const std::string key(trimmed(line->substr(0, equals)));
    const std::string value(trimmed(line->substr(equals + 1)));
    if (!ended) return bad_metaimage("the header is truncated inside the field " + in_quotes(key));
    const char* canonical = nullptr;
    for (const auto& [name, meaning] : kFields) {
      if (key == name) canonical = meaning;
      if (one_edit_apart(key, name))
        return bad_metaimage("unknown field " + in_quotes(key) + "; expected " + std::string(name) + "?");
    }
    if (canonical == nullptr) continue;
    if (!header.fields.emplace(canonical, value).second)
      return bad_metaimage("the field " + key + " (or a synonym) is given twice");
    if (key == "ElementDataFile") return header;
  }
  return bad_metaimage("the header is truncated: it has no ElementDataFile");
}

Result<bool> meta_flag(const MetaImageHeader& header, const char* name, bool otherwise) {
  const std::string* value = header.find(name);
  if (value == nullptr) return otherwise;
  const std::string lower = lower_case(*value);
  if (lower == "true" || lower == "1" || lower == "t") return true;
  if (lower == "false" || lower == "0" || lower == "f") return false;
  return bad_metaimage(std::string(name) + " is " + in_quotes(*value) + "; expected True or False");
}

Result<std::vector<double>> meta_numbers(const MetaImageHeader& header, const char* name, std::size_t count,
                                         std::vector<double> otherwise) {
  const std::string* value = header.find(name);
  if (value == nullptr) return otherwise;
  const auto parsed = parse_doubles(*value);
  if (!parsed || parsed->size() != count)
    return bad_metaimage(std::string(name) + " is " + in_quotes(*value) + "; expected " +
                         std::to_string(count) + " numbers");
  return *parsed;
}

Result<std::int64_t> meta_integer(const MetaImageHeader& header, const char* name, std::int64_t otherwise) {
  const std::string* value = header.find(name);
  if (value == nullptr) return otherwise;
  const auto parsed = parse_integer(*value);
  if (!parsed)
    return bad_metaimage(std::string(name) + " is " + in_quotes(*value) + "; expected a whole number");
  return *parsed;
}

}  // namespace voxtet
