// A body that the image cuts off goes on beyond the image's border.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/cut/cut_plane.h"
#include "types/label_volume.h"

namespace voxtet {

/// By axis and end (low, high), the voxels of the border's plane at which the body is cut off; empty where it
/// is nowhere.
struct CutFaces {
  std::array<std::array<std::vector<std::uint8_t>, 2>, 3> cut;
  bool none() const;
};

/// A body is cut off where it reaches the border without getting smaller before it: where a connected part of
/// the labels, within three planes of voxels, has on the border at least half of the voxels that it has on
/// the third plane. The pole of a sphere that just touches the border has a fifth.
CutFaces find_cut_faces(const LabelVolume& labels);

/// Planes of voxels that are added beyond a cut.
inline constexpr int kBeyondCut = 5;

/// `labels` with planes added on the sides that have a cut: copies of the border's voxels at the cuts, or
/// with `cuts` the labels `beyond` of these, and background elsewhere. `everywhere`: copies of all of the
/// border's voxels. With names and colours as before.
LabelVolume extended(const LabelVolume& labels, const CutFaces& faces, const CutPlanes* cuts = nullptr,
                     bool everywhere = false);

/// The planes of the cuts, in the grid of extended(). Their labels are the highest that there are; `highest`
/// is that of the volume. Empty where too few are left.
CutPlanes planes_of(const LabelVolume& labels, const CutFaces& faces, Label highest);

}  // namespace voxtet
