// Labels keep their volumes while their interfaces move.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/elements/surface_measures.h"
#include "tetra/mesh/tet_complex.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet::tetra {

/// Limits what labels may gain or lose in total by moves of their interfaces. Without a limit a thin wall,
/// all of whose tets are better when it is thicker, would swell on all sides, each vertex within its
/// envelope: the right ventricle of a heart by a quarter if edges are twice as long as the wall is thick.
class VolumeKeeper {
 public:
  /// The volumes to keep are the current ones; `limit`: by which part each may be off. Layers have no volume
  /// of their own to keep. Complex and layers must outlive this.
  VolumeKeeper(const TetComplex& complex, const WallLayers& layers, double limit = 0.002)
      : complex_(complex), limit_(limit) {
    for (std::size_t l = 0; l < complex.label_end(); ++l) {
      const auto label = static_cast<Label>(l);
      target_mm3_.push_back(label == kBackground || layers.is_layer(label) ? kNone
                                                                           : complex.volume_mm3(label));
    }
  }

  /// The same with the volumes that the label surface encloses, for the labels that are on it.
  VolumeKeeper(const TetComplex& complex, const WallLayers& layers, const SurfaceMesh& reference)
      : VolumeKeeper(complex, layers) {
    const std::vector<double> enclosed = enclosed_volumes_mm3(reference);
    for (std::size_t l = 0; l < std::min(target_mm3_.size(), enclosed.size()); ++l)
      if (target_mm3_[l] != kNone && enclosed[l] > 0) target_mm3_[l] = enclosed[l];
  }

  /// By how much a label's volume would be off after `gain_mm3`, mm³; 0 if it has none to keep.
  double off_mm3(Label label, double gain_mm3 = 0) const {
    return has_none(label) ? 0 : std::abs(complex_.volume_mm3(label) + gain_mm3 - target_mm3_[label]);
  }
  /// Whether a label is within the limit, or not off by more than before.
  bool allows(Label label, double off_mm3, double was_off_mm3 = 0) const {
    return has_none(label) || off_mm3 <= std::max(limit_ * target_mm3_[label], was_off_mm3);
  }

 private:
  static constexpr double kNone = -1;
  bool has_none(Label label) const { return label >= target_mm3_.size() || target_mm3_[label] == kNone; }

  const TetComplex& complex_;
  double limit_;
  std::vector<double> target_mm3_;  ///< by label; kNone: any
};

}  // namespace voxtet::tetra
