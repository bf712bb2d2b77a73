#include "io/volume/formats/read_nrrd.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "io/bytes/header_text.h"
#include "io/volume/formats/nrrd_geometry.h"
#include "io/volume/formats/nrrd_header.h"
#include "io/volume/formats/nrrd_segments.h"
#include "io/volume/voxels/collect_labels.h"
#include "io/volume/voxels/data_block.h"
#include "io/volume/voxels/merge_frames.h"

namespace voxtet {
namespace {

struct TypeNames {
  VoxelType type;
  std::array<std::string_view, 6> names;
};
constexpr std::array<TypeNames, 10> kTypes{{
    {VoxelType::kInt8, {"signed char", "int8", "int8_t"}},
    {VoxelType::kUint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
    {VoxelType::kInt16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
    {VoxelType::kUint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
    {VoxelType::kInt32, {"int", "signed int", "int32", "int32_t"}},
    {VoxelType::kUint32, {"uint", "unsigned int", "uint32", "uint32_t"}},
    {VoxelType::kInt64,
     {"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64"}},
    {VoxelType::kUint64, {"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}},
    {VoxelType::kFloat32, {"float"}},
    {VoxelType::kFloat64, {"double"}},
}};

Result<VoxelType> type_of(const NrrdHeader& header) {
  const std::string* text = header.find("type");
  if (text == nullptr) return bad_nrrd("the header has no type");
  std::string name;
  for (const std::string& word : words_of(lower_case(*text))) name += (name.empty() ? "" : " ") + word;
  if (name == "int64_t") return VoxelType::kInt64;
  for (const TypeNames& entry : kTypes)
    if (!name.empty() && std::find(entry.names.begin(), entry.names.end(), name) != entry.names.end())
      return entry.type;
  return bad_nrrd("type is " + in_quotes(*text) + "; expected an integer type, float or double");
}

Result<Packing> packing_of(const NrrdHeader& header) {
  const std::string* text = header.find("encoding");
  if (text == nullptr) return bad_nrrd("the header has no encoding");
  const std::string name = lower_case(*text);
  if (name == "raw") return Packing::kRaw;
  if (name == "gzip" || name == "gz") return Packing::kDeflated;
  if (name == "ascii" || name == "text" || name == "txt") return Packing::kText;
  return bad_nrrd("encoding is " + in_quotes(*text) + "; expected raw, gzip or ascii");
}

Result<bool> big_endian_of(const NrrdHeader& header, VoxelType type, Packing packing) {
  const std::string* text = header.find("endian");
  if (text == nullptr) {
    if (bytes_of(type) > 1 && packing != Packing::kText)
      return bad_nrrd("the header has no endian; expected little or big for values of " +
                      std::to_string(bytes_of(type)) + " bytes");
    return false;
  }
  const std::string name = lower_case(*text);
  if (name != "little" && name != "big")
    return bad_nrrd("endian is " + in_quotes(*text) + "; expected little or big");
  return name == "big";
}

Result<std::int64_t> skip_of(const NrrdHeader& header, const std::string& field, std::int64_t least) {
  const std::string* text = header.find(field);
  if (text == nullptr) return std::int64_t{0};
  const auto value = parse_integer(*text);
  if (!value || *value < least)
    return bad_nrrd(field + " is " + in_quotes(*text) + "; expected a whole number from " +
                    std::to_string(least));
  return *value;
}

Result<VoxelLayout> layout_of(const NrrdHeader& header, const NrrdGeometry& geometry, Packing packing) {
  VoxelLayout layout;
  layout.stage = kNrrdReader;
  const Result<VoxelType> type = type_of(header);
  if (!type) return type.error();
  const Result<bool> big = big_endian_of(header, *type, packing);
  if (!big) return big.error();
  layout.type = *type;
  layout.big_endian = *big;
  for (std::size_t d = 0; d < 3; ++d) layout.size[d] = geometry.sizes[geometry.axes[d]];
  if (geometry.list_axis) {
    const std::int64_t count = geometry.sizes[*geometry.list_axis];
    (*geometry.list_axis == 0 ? layout.layers : layout.frames) = count;
    layout.frames_said =
        "sizes has " + std::to_string(count) +
        (*geometry.list_axis == 0 ? " values a voxel, but no Segment keys say what they are"
                                  : " frames along axis " + std::to_string(*geometry.list_axis));
  }
  if (Status good = check_extents(layout, "sizes"); !good) return good.error();
  return layout;
}

/// The files that the header names beside it; nothing where the data follow it.
Result<std::optional<DataFiles>> data_files_of(const NrrdHeader& header, const VoxelLayout& layout,
                                               std::span<const std::uint8_t> behind) {
  const std::string* name = header.find("datafile");
  if (name == nullptr) return std::optional<DataFiles>();
  DataFiles files{"data file", {*name}};
  if (header.has_list()) {
    files.names = names_of_lines(behind);
    return std::optional(files);
  }
  if (!behind.empty())
    return bad_nrrd(std::to_string(behind.size()) +
                    " bytes follow the header although data file names another file");
  if (name->find('%') != std::string::npos) {
    Result<std::vector<std::string>> names =
        names_of_pattern(kNrrdReader, files.field, *name, layout.size[2] * layout.frames);
    if (!names) return names.error();
    files.names = std::move(names).value();
  }
  return std::optional(files);
}

}  // namespace

Result<LabelVolume> read_nrrd(const VolumeFile& file, Reading& reading) {
  const Result<NrrdHeader> header = parse_nrrd_header(file.bytes);
  if (!header) return header.error();
  const Result<NrrdGeometry> geometry = nrrd_geometry(*header, reading);
  if (!geometry) return geometry.error();
  const Result<Packing> packing = packing_of(*header);
  if (!packing) return packing.error();
  const Result<VoxelLayout> layout = layout_of(*header, *geometry, *packing);
  if (!layout) return layout.error();
  const Result<std::vector<NrrdSegment>> segments =
      parse_segments(header->key_values, layout->layers, reading);
  if (!segments) return segments.error();
  const Result<std::int64_t> lines = skip_of(*header, "lineskip", 0);
  if (!lines) return lines.error();
  const Result<std::int64_t> skip = skip_of(*header, "byteskip", -1);
  if (!skip) return skip.error();
  const std::span<const std::uint8_t> behind = file.bytes.subspan(header->data_at);
  const Result<std::optional<DataFiles>> files = data_files_of(*header, *layout, behind);
  if (!files) return files.error();

  const DataBlock block{*packing, *lines, *skip, "byte skip"};
  const auto feed = [&](ValueSink& sink) {
    return *files ? read_data_files(file, **files, block, *layout, sink, reading)
                  : read_data_block(behind, block, *layout, sink, reading);
  };
  const bool layered = layout->layers > 1 && !segments->empty();
  Result<std::vector<Label>> labels =
      layered ? read_segments(*layout, *segments, feed, reading) : read_labels(*layout, reading, feed);
  if (!labels) return labels.error();
  if (!layered) warn_of_empty_segments(*labels, *segments, reading);
  LabelVolume volume = make_volume(*layout, geometry->index_to_mm, std::move(*labels));
  for (const NrrdSegment& segment : *segments) volume.infos.push_back(segment.info);
  std::sort(volume.infos.begin(), volume.infos.end(),
            [](const LabelInfo& a, const LabelInfo& b) { return a.label < b.label; });
  return volume;
}

}  // namespace voxtet
