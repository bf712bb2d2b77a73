// Connected regions of equally labelled voxels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "types/label_volume.h"

namespace voxtet {

/// Voxels of one label that touch at a face, an edge or a corner belong to one region, background included.
/// So all equally labelled corners of a lattice cell, and with them everything a triangle of an extracted
/// surface can lie against, are of one region. Region 0 is the background around the volume, with all
/// background connected to it. Linear time.
class VoxelRegions {
 public:
  static constexpr std::uint32_t kOutside = 0;

  /// If `merged` is not background, all labels count as that one.
  VoxelRegions(const LabelVolume& volume, Label merged);

  std::size_t count() const { return labels_.size(); }
  Label label(std::uint32_t region) const { return labels_[region]; }
  /// Volume of each region in voxels; 0 for the outside.
  const std::vector<double>& volumes() const { return volumes_; }
  std::uint32_t at(int i, int j, int k) const {
    if (i < 0 || j < 0 || k < 0 || i >= size_[0] || j >= size_[1] || k >= size_[2]) return kOutside;
    return of_voxel_[static_cast<std::size_t>(i) +
                     static_cast<std::size_t>(size_[0]) *
                         (static_cast<std::size_t>(j) +
                          static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(k))];
  }

  /// The six neighbours of a voxel.
  struct Surroundings {
    int others = 0;     ///< neighbours of another region
    int thin_axes = 0;  ///< axes along which both neighbours are of another region
  };
  Surroundings around(int i, int j, int k) const;

 private:
  std::array<int, 3> size_;
  std::vector<std::uint32_t> of_voxel_;
  std::vector<Label> labels_;
  std::vector<double> volumes_;
};

}  // namespace voxtet
