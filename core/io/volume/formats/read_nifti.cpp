#include "io/volume/formats/read_nifti.h"

#include "io/volume/formats/nifti_affine.h"
#include "io/volume/formats/nifti_header.h"
#include "io/volume/voxels/merge_frames.h"

namespace voxtet {
namespace {

/// What a header says of voxels and space.
struct PlacedVoxels {
  VoxelLayout layout;
  Eigen::Matrix4d index_to_mm;
};

/// Reads up to the first voxel.
Result<PlacedVoxels> read_header(ByteSource& source, Reading& reading) {
  const Result<NiftiHeader> header = read_nifti_header(source);
  if (!header) return header.error();
  const Result<VoxelLayout> layout = nifti_layout(*header);
  if (!layout) return layout.error();
  const Result<Eigen::Matrix4d> affine = nifti_affine(*header, reading);
  if (!affine) return affine.error();
  if (Status skipped = skip_to_voxels(*header, source); !skipped) return skipped.error();
  return PlacedVoxels{*layout, *affine};
}

}  // namespace

bool looks_like_nifti(std::span<const std::uint8_t> start) {
  if (start.size() < 4) return false;
  for (const bool big : {false, true}) {
    const auto size = load_value<std::int32_t>(start.data(), big);
    if (size == 348 || size == 540) return true;
  }
  const auto magic_at = [&](std::size_t offset, std::uint8_t version) {
    return start.size() >= offset + 4 && start[offset] == 'n' &&
           (start[offset + 1] == '+' || start[offset + 1] == 'i') && start[offset + 2] == version &&
           start[offset + 3] == 0;
  };
  return magic_at(344, '1') || magic_at(4, '2');
}

Result<LabelVolume> read_nifti(ByteSource& source, Reading& reading) {
  const Result<PlacedVoxels> header = read_header(source, reading);
  if (!header) return header.error();
  const VoxelLayout& layout = header->layout;
  Result<std::vector<Label>> labels = read_labels(
      layout, reading, [&](ValueSink& sink) { return read_values(source, layout, sink, reading); });
  if (!labels) return labels.error();
  return make_volume(layout, header->index_to_mm, std::move(*labels));
}

Result<ScalarVolume> read_nifti_scalars(ByteSource& source, Reading& reading) {
  const Result<PlacedVoxels> header = read_header(source, reading);
  if (!header) return header.error();
  if (header->layout.frames > 1)
    return bad_nifti(header->layout.frames_said + "; expected 1, a single three-dimensional image");
  ScalarSink sink;
  if (Status read = read_values(source, header->layout, sink, reading); !read) return read.error();
  ScalarVolume volume;
  for (std::size_t d = 0; d < 3; ++d) volume.size[d] = static_cast<int>(header->layout.size[d]);
  volume.index_to_mm = header->index_to_mm;
  volume.values = std::move(sink.values);
  return volume;
}

}  // namespace voxtet
