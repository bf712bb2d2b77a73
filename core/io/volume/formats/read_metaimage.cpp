#include "io/volume/formats/read_metaimage.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "io/bytes/header_text.h"
#include "io/volume/formats/metaimage_header.h"
#include "io/volume/voxels/data_block.h"
#include "io/volume/voxels/length_unit.h"
#include "io/volume/voxels/merge_frames.h"

namespace voxtet {
namespace {

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

/// What other readers would silently ignore or apply differently.
Status check_kind(const MetaImageHeader& header) {
  if (const std::string* type = header.find("ObjectType"); type != nullptr && *type != "Image")
    return bad_metaimage("ObjectType is " + in_quotes(*type) + "; expected Image");
  for (const auto& [name, neutral] : {std::pair("ElementToIntensityFunctionSlope", 1.0),
                                      std::pair("ElementToIntensityFunctionOffset", 0.0)}) {
    const Result<std::vector<double>> value = meta_numbers(header, name, 1, {neutral});
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
  const Result<std::int64_t> axes = meta_integer(header, "NDims", 0);
  if (!axes) return axes.error();
  if (*axes == 2) return one_slice(kMetaImageReader, "NDims", "2");
  if (*axes != 3 && *axes != 4)
    return bad_metaimage("NDims is " + std::to_string(*axes) + "; expected 3, or 4 with frames");
  dims = static_cast<std::size_t>(*axes);
  const std::string& size = *header.find("DimSize");
  const auto extents = parse_integers(size);
  if (!extents || extents->size() != dims)
    return bad_metaimage("DimSize is " + in_quotes(size) + "; expected " + std::to_string(dims) +
                         " whole numbers");
  layout.size = {(*extents)[0], (*extents)[1], (*extents)[2]};
  if (dims == 4) layout.frames = (*extents)[3];
  const Result<std::int64_t> channels = meta_integer(header, "ElementNumberOfChannels", 1);
  if (!channels) return channels.error();
  layout.layers = *channels;
  if (layout.layers > 1 && layout.frames > 1)
    return bad_metaimage("ElementNumberOfChannels is " + std::to_string(layout.layers) + " and DimSize has " +
                         std::to_string(layout.frames) + " frames; expected one of them at most");
  layout.frames_said = layout.layers > 1 ? "ElementNumberOfChannels is " + std::to_string(layout.layers)
                                         : "DimSize has " + std::to_string(layout.frames) + " frames";

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
  const Result<bool> msb = meta_flag(header, "BinaryDataByteOrderMSB", false);
  if (!msb) return msb.error();
  layout.big_endian = *msb;
  if (Status good = check_extents(layout, "DimSize"); !good) return good.error();
  return layout;
}

Result<double> mm_per_unit(const MetaImageHeader& header, Reading& reading) {
  if (const auto asked = mm_per_unit_of(reading.options)) return *asked;
  const std::string* unit = header.find("DistanceUnits");
  if (unit == nullptr || *unit == "?") return 1.0;
  const std::optional<double> mm = mm_per_length_unit(*unit);
  if (!mm)
    return bad_metaimage("DistanceUnits is " + in_quotes(*unit) + "; expected mm, um, cm or m, or " +
                         kSayUnit);
  reading.said_mm = *mm;
  return *mm;
}

Result<Eigen::Matrix4d> affine_of(const MetaImageHeader& header, std::size_t dims, Reading& reading) {
  std::vector<double> identity(dims * dims, 0.0);
  for (std::size_t d = 0; d < dims; ++d) identity[d * dims + d] = 1;
  const Result<std::vector<double>> axes = meta_numbers(header, "TransformMatrix", dims * dims, identity);
  if (!axes) return axes.error();
  const Result<std::vector<double>> offset =
      meta_numbers(header, "Offset", dims, std::vector<double>(dims, 0.0));
  if (!offset) return offset.error();
  const Result<std::vector<double>> size =
      meta_numbers(header, "ElementSize", dims, std::vector<double>(dims, 1.0));
  if (!size) return size.error();
  const Result<std::vector<double>> spacing = meta_numbers(header, "ElementSpacing", dims, *size);
  if (!spacing) return spacing.error();
  const Result<double> scale = mm_per_unit(header, reading);
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

Result<DataBlock> data_block_of(const MetaImageHeader& header, bool attached) {
  DataBlock block;
  const Result<bool> binary = meta_flag(header, "BinaryData", true);
  if (!binary) return binary.error();
  const Result<bool> compressed = meta_flag(header, "CompressedData", false);
  if (!compressed) return compressed.error();
  if (*compressed && !*binary) return bad_metaimage("CompressedData is True although BinaryData is False");
  block.packing = *compressed ? Packing::kDeflated : *binary ? Packing::kRaw : Packing::kText;
  const Result<std::int64_t> skip = meta_integer(header, "HeaderSize", 0);
  if (!skip) return skip.error();
  if (*skip > 0 && (*compressed || attached))
    return bad_metaimage("HeaderSize is " + std::to_string(*skip) +
                         "; expected 0, but for raw data in another file");
  block.skip_bytes = *skip;
  block.skip_field = "HeaderSize";
  if (*compressed) {
    const Result<std::int64_t> packed = meta_integer(header, "CompressedDataSize", -1);
    if (!packed) return packed.error();
    block.said_bytes = *packed;
  }
  return block;
}

/// The files that the header names beside it; nothing where the data follow it.
Result<std::optional<DataFiles>> data_files_of(const MetaImageHeader& header, const VoxelLayout& layout,
                                               std::span<const std::uint8_t> behind) {
  const std::string& name = *header.find("ElementDataFile");
  if (lower_case(name) == "local") return std::optional<DataFiles>();
  DataFiles files{"ElementDataFile", {name}};
  // "LIST 2": the dimensions of each file, which follow from their number too.
  if (name == "LIST" || name.starts_with("LIST ")) {
    files.names = names_of_lines(behind);
    return std::optional(files);
  }
  if (!behind.empty())
    return bad_metaimage(std::to_string(behind.size()) +
                         " bytes follow ElementDataFile although it names another file");
  if (name.find('%') != std::string::npos) {
    Result<std::vector<std::string>> names =
        names_of_pattern(kMetaImageReader, files.field, name, layout.size[2] * layout.frames);
    if (!names) return names.error();
    files.names = std::move(names).value();
  }
  return std::optional(files);
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

Result<LabelVolume> read_metaimage(const VolumeFile& file, Reading& reading) {
  const Result<MetaImageHeader> header = parse_metaimage_header(file.bytes);
  if (!header) return header.error();
  if (Status kind = check_kind(*header); !kind) return kind.error();
  std::size_t dims = 3;
  const Result<VoxelLayout> layout = layout_of(*header, dims);
  if (!layout) return layout.error();
  const Result<Eigen::Matrix4d> affine = affine_of(*header, dims, reading);
  if (!affine) return affine.error();
  const std::span<const std::uint8_t> behind = file.bytes.subspan(header->data_at);
  const Result<std::optional<DataFiles>> files = data_files_of(*header, *layout, behind);
  if (!files) return files.error();
  const Result<DataBlock> block = data_block_of(*header, !*files);
  if (!block) return block.error();
  Result<std::vector<Label>> labels = read_labels(*layout, reading, [&](ValueSink& sink) {
    return *files ? read_data_files(file, **files, *block, *layout, sink, reading)
                  : read_data_block(behind, *block, *layout, sink, reading);
  });
  if (!labels) return labels.error();
  return make_volume(*layout, *affine, std::move(*labels));
}

}  // namespace voxtet
