#include "io/volume/read_metaimage.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include "io/bytes/header_text.h"
#include "io/volume/data_block.h"

namespace voxtet {
namespace {

constexpr const char* kMetaImageReader = "read_metaimage";

Error bad_metaimage(const std::string& message) {
  return bad_input(kMetaImageReader, message);
}

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

constexpr std::array<std::pair<const char*, VoxelType>, 12> kMetaElementTypes{{
    {"MET_CHAR", VoxelType::kInt8},
    {"MET_UCHAR", VoxelType::kUint8},
    {"MET_SHORT", VoxelType::kInt16},
    {"MET_USHORT", VoxelType::kUint16},
    {"MET_INT", VoxelType::kInt32},
    {"MET_UINT", VoxelType::kUint32},
    {"MET_LONG", VoxelType::kInt32},  // four bytes in MetaIO on every platform
    {"MET_ULONG", VoxelType::kUint32},
    {"MET_LONG_LONG", VoxelType::kInt64},
    {"MET_ULONG_LONG", VoxelType::kUint64},
    {"MET_FLOAT", VoxelType::kFloat32},
    {"MET_DOUBLE", VoxelType::kFloat64},
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

struct MetaImageHeader {
  std::map<std::string, std::string> fields;  ///< by canonical name
  std::size_t data_at = 0;

  const std::string* find(const char* name) const {
    const auto at = fields.find(name);
    return at == fields.end() ? nullptr : &at->second;
  }
};

Result<MetaImageHeader> parse_header(std::span<const std::uint8_t> bytes) {
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

Result<bool> flag(const MetaImageHeader& header, const char* name, bool otherwise) {
  const std::string* value = header.find(name);
  if (value == nullptr) return otherwise;
  const std::string lower = lower_case(*value);
  if (lower == "true" || lower == "1" || lower == "t") return true;
  if (lower == "false" || lower == "0" || lower == "f") return false;
  return bad_metaimage(std::string(name) + " is " + in_quotes(*value) + "; expected True or False");
}

Result<std::vector<double>> numbers(const MetaImageHeader& header, const char* name, std::size_t count,
                                    std::vector<double> otherwise) {
  const std::string* value = header.find(name);
  if (value == nullptr) return otherwise;
  const auto parsed = parse_doubles(*value);
  if (!parsed || parsed->size() != count)
    return bad_metaimage(std::string(name) + " is " + in_quotes(*value) + "; expected " +
                         std::to_string(count) + " numbers");
  return *parsed;
}

Result<std::int64_t> integer(const MetaImageHeader& header, const char* name, std::int64_t otherwise) {
  const std::string* value = header.find(name);
  if (value == nullptr) return otherwise;
  const auto parsed = parse_integer(*value);
  if (!parsed)
    return bad_metaimage(std::string(name) + " is " + in_quotes(*value) + "; expected a whole number");
  return *parsed;
}

/// What other readers would silently ignore or apply differently.
Status check_kind(const MetaImageHeader& header) {
  if (const std::string* type = header.find("ObjectType"); type != nullptr && *type != "Image")
    return bad_metaimage("ObjectType is " + in_quotes(*type) + "; expected Image");
  const Result<std::int64_t> channels = integer(header, "ElementNumberOfChannels", 1);
  if (!channels) return channels.error();
  if (*channels != 1)
    return bad_metaimage("ElementNumberOfChannels is " + std::to_string(*channels) +
                         "; expected 1, one label per voxel");
  for (const auto& [name, neutral] : {std::pair("ElementToIntensityFunctionSlope", 1.0),
                                      std::pair("ElementToIntensityFunctionOffset", 0.0)}) {
    const Result<std::vector<double>> value = numbers(header, name, 1, {neutral});
    if (!value) return value.error();
    if ((*value)[0] != neutral)
      return bad_metaimage(std::string(name) + " is " + number_text((*value)[0]) + "; expected " +
                           number_text(neutral) + ", labels are not rescaled");
  }
  return std::monostate{};
}

Result<VoxelLayout> layout_of(const MetaImageHeader& header, std::size_t& dims) {
  VoxelLayout layout;
  layout.stage = kMetaImageReader;
  for (const char* name : {"NDims", "DimSize", "ElementType"})
    if (header.find(name) == nullptr) return bad_metaimage("the header has no " + std::string(name));
  const Result<std::int64_t> axes = integer(header, "NDims", 0);
  if (!axes) return axes.error();
  if (*axes != 3 && *axes != 4)
    return bad_metaimage("NDims is " + std::to_string(*axes) + "; expected 3, or 4 with one frame");
  dims = static_cast<std::size_t>(*axes);
  const std::string& size = *header.find("DimSize");
  const auto extents = parse_integers(size);
  if (!extents || extents->size() != dims)
    return bad_metaimage("DimSize is " + in_quotes(size) + "; expected " + std::to_string(dims) +
                         " whole numbers");
  if (dims == 4 && (*extents)[3] != 1)
    return bad_metaimage("DimSize has " + std::to_string((*extents)[3]) + " frames; expected 1");
  layout.size = {(*extents)[0], (*extents)[1], (*extents)[2]};

  const std::string& type = *header.find("ElementType");
  bool known = false;
  for (const auto& [name, meaning] : kMetaElementTypes) {
    if (type != name) continue;
    layout.type = meaning;
    known = true;
  }
  if (!known)
    return bad_metaimage("ElementType is " + in_quotes(type) +
                         "; expected an integer type, MET_FLOAT or MET_DOUBLE");
  const Result<bool> msb = flag(header, "BinaryDataByteOrderMSB", false);
  if (!msb) return msb.error();
  layout.big_endian = *msb;
  if (Status good = check_extents(layout, "DimSize"); !good) return good.error();
  return layout;
}

Result<double> mm_per_unit(const MetaImageHeader& header) {
  const std::string* unit = header.find("DistanceUnits");
  if (unit == nullptr || *unit == "mm" || *unit == "?") return 1.0;
  if (*unit == "um") return 0.001;
  if (*unit == "cm") return 10.0;
  if (*unit == "m") return 1000.0;
  return bad_metaimage("DistanceUnits is " + in_quotes(*unit) + "; expected mm, um, cm or m");
}

Result<Eigen::Matrix4d> affine_of(const MetaImageHeader& header, std::size_t dims) {
  std::vector<double> identity(dims * dims, 0.0);
  for (std::size_t d = 0; d < dims; ++d) identity[d * dims + d] = 1;
  const Result<std::vector<double>> axes = numbers(header, "TransformMatrix", dims * dims, identity);
  if (!axes) return axes.error();
  const Result<std::vector<double>> offset = numbers(header, "Offset", dims, std::vector<double>(dims, 0.0));
  if (!offset) return offset.error();
  const Result<std::vector<double>> size =
      numbers(header, "ElementSize", dims, std::vector<double>(dims, 1.0));
  if (!size) return size.error();
  const Result<std::vector<double>> spacing = numbers(header, "ElementSpacing", dims, *size);
  if (!spacing) return spacing.error();
  const Result<double> scale = mm_per_unit(header);
  if (!scale) return scale.error();

  Eigen::Matrix4d affine = Eigen::Matrix4d::Identity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!((*spacing)[axis] > 0))
      return bad_metaimage("ElementSpacing holds " + number_text((*spacing)[axis]) +
                           "; expected voxel sizes above 0");
    for (std::size_t row = 0; row < 3; ++row)
      affine(static_cast<int>(row), static_cast<int>(axis)) =
          *scale * (*axes)[axis * dims + row] * (*spacing)[axis];
    affine(static_cast<int>(axis), 3) = *scale * (*offset)[axis];
  }
  affine.topRows<2>() *= -1;  // LPS to RAS
  if (Status good = check_affine(kMetaImageReader, "TransformMatrix, Offset or ElementSpacing", affine);
      !good)
    return good.error();
  return affine;
}

Result<DataBlock> data_block_of(const MetaImageHeader& header, std::uint64_t available, bool attached) {
  DataBlock block;
  const Result<bool> binary = flag(header, "BinaryData", true);
  if (!binary) return binary.error();
  const Result<bool> compressed = flag(header, "CompressedData", false);
  if (!compressed) return compressed.error();
  if (*compressed && !*binary) return bad_metaimage("CompressedData is True although BinaryData is False");
  block.packing = *compressed ? Packing::kDeflated : *binary ? Packing::kRaw : Packing::kText;
  const Result<std::int64_t> skip = integer(header, "HeaderSize", 0);
  if (!skip) return skip.error();
  if (*skip > 0 && (*compressed || attached))
    return bad_metaimage("HeaderSize is " + std::to_string(*skip) +
                         "; expected 0, but for raw data in another file");
  block.skip_bytes = *skip;
  block.skip_field = "HeaderSize";
  const Result<std::int64_t> packed =
      integer(header, "CompressedDataSize", static_cast<std::int64_t>(available));
  if (!packed) return packed.error();
  if (*compressed && (*packed < 0 || static_cast<std::uint64_t>(*packed) != available))
    return bad_metaimage("CompressedDataSize is " + std::to_string(*packed) + ", but the data have " +
                         std::to_string(available) + " bytes");
  return block;
}

}  // namespace

bool looks_like_metaimage(std::span<const std::uint8_t> bytes) {
  std::size_t at = 0;
  bool ended = false;
  const auto line = next_line(bytes.first(std::min<std::size_t>(bytes.size(), 200)), at, ended);
  if (!line) return false;
  const std::size_t equals = line->find('=');
  if (equals == std::string_view::npos || equals == 0) return false;
  for (const char c : line->substr(0, equals))
    if (c < ' ' || c > '~') return false;
  return line->substr(0, 1) != "#" && line->find(":=") == std::string_view::npos;
}

Result<LabelVolume> read_metaimage(const VolumeFile& file) {
  const Result<MetaImageHeader> header = parse_header(file.bytes);
  if (!header) return header.error();
  if (Status kind = check_kind(*header); !kind) return kind.error();
  std::size_t dims = 3;
  const Result<VoxelLayout> layout = layout_of(*header, dims);
  if (!layout) return layout.error();
  const Result<Eigen::Matrix4d> affine = affine_of(*header, dims);
  if (!affine) return affine.error();

  std::span<const std::uint8_t> data = file.bytes.subspan(header->data_at);
  Bytes sibling;
  const std::string& name = *header->find("ElementDataFile");
  const bool attached = lower_case(name) == "local";
  if (!attached) {
    if (name.starts_with("LIST") || name.find('%') != std::string::npos)
      return bad_metaimage("ElementDataFile is " + in_quotes(name) +
                           "; expected LOCAL or the name of one file");
    if (!data.empty())
      return bad_metaimage(std::to_string(data.size()) +
                           " bytes follow ElementDataFile although it names another file");
    Result<Bytes> bytes = read_sibling(file, kMetaImageReader, "ElementDataFile", name);
    if (!bytes) return bytes.error();
    sibling = std::move(*bytes);
    data = sibling;
  }
  const Result<DataBlock> block = data_block_of(*header, data.size(), attached);
  if (!block) return block.error();
  Result<std::vector<Label>> labels = read_data_block(data, *block, *layout);
  if (!labels) return labels.error();
  return make_volume(*layout, *affine, std::move(*labels));
}

}  // namespace voxtet
