// Connected components of equally labelled voxels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// Which voxels are neighbours.
enum class Connectivity {
  kFaces,  ///< the six across a face, as marching cubes separates the foreground
  kKuhn,   ///< those and eight along diagonals of the Kuhn tetrahedra, as marching tetrahedra joins
};

/// Ids of the connected components of equal label (background like any other), from 0 in the order of their
/// first voxel; x runs fastest. `sizes` becomes the number of voxels of each. Linear time.
std::vector<std::uint32_t> label_components(const std::array<int, 3>& size, const std::vector<Label>& labels,
                                            std::vector<std::uint32_t>& sizes,
                                            Connectivity connectivity = Connectivity::kFaces);

/// Number of 6-connected components of each label (index, 65536 entries), background left out.
std::vector<std::uint32_t> count_components(const std::array<int, 3>& size, const std::vector<Label>& labels);

/// Calls visit(offset, axis) for each of the up to six face neighbours of a voxel inside the grid.
template <class Visit>
void for_face_neighbours(const std::array<int, 3>& size, std::size_t offset, Visit&& visit) {
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t length = static_cast<std::size_t>(size[axis]), place = offset / stride % length;
    if (place > 0) visit(offset - stride, axis);
    if (place + 1 < length) visit(offset + stride, axis);
    stride *= length;
  }
}

/// The other label that shares the largest face area with a set of voxels of one label; of equals the lower
/// one; the voxels' own label if there is no other. `face_area` is the area of a voxel's face across each
/// axis.
Label neighbour_by_area(const std::array<int, 3>& size, const std::vector<Label>& labels,
                        const std::vector<std::size_t>& voxels, const std::array<double, 3>& face_area);

}  // namespace voxtet
