// What giving some voxels another label does to the topology of labels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/topology/label_components.h"
#include "volume/clean/padded_labels.h"

namespace voxtet {

struct HandlesTaken {
  int opened = 0;  ///< of the label that loses the voxels
  int closed = 0;  ///< of the label that gets them: tunnels through it, and leaks of what it encloses
  bool any() const { return opened + closed > 0; }
};

/// Tries changes of a volume. Refers to its labels, and changes them while it tries. With kFaces the voxels
/// of a label (the only one) are joined across faces and the background along diagonals of faces too; with
/// kKuhn all are joined along the edges of the Kuhn tetrahedra.
class RelabelTrial {
 public:
  RelabelTrial(PaddedLabels& labels, Connectivity connectivity);

  /// Which handles go if these voxels, all of one label, get the label `to`; none where pieces or cavities of
  /// one of the two labels would come or go, or a handle would come. Only one cavity may come: where all of
  /// another label is shut off from the background by closing the last leak through `to`. The background's
  /// own handles are not counted.
  /// The labels are as before afterwards. Source: Euler characteristics from the neighbours of single voxels
  /// (Bertrand 1994, "Simple points, topological numbers and geodesic neighborhoods in cubic grids"); pieces
  /// and cavities are found by growth from all neighbours at once, until they have met.
  HandlesTaken handles_taken(const std::vector<std::size_t>& voxels, Label to);

  /// Whether a voxel can get the label `to` without a change of topology of its label, or of that one.
  bool is_simple(std::size_t voxel, Label to) const;

  /// Steps from a voxel to those that it is joined to.
  const std::vector<std::ptrdiff_t>& steps_of(Label label) const {
    return connectivity_ == Connectivity::kFaces && label != kBackground ? face_steps_ : other_steps_;
  }

 private:
  /// How the Euler characteristic of a label's voxels changes as these voxels get the label `to` one after
  /// the other, which they have afterwards.
  int euler_change(const std::vector<std::size_t>& voxels, Label label, Label to);
  /// How many pieces a label's voxels and the others have among the neighbours of a voxel, and next to it.
  std::array<int, 2> pieces_around(std::size_t voxel, Label label) const;
  /// How many pieces of the label's voxels, or of all others, there are at the voxels and their neighbours.
  std::size_t count_pieces(const std::vector<std::size_t>& voxels, Label label, bool others);
  void give(const std::vector<std::size_t>& voxels, Label label);

  PaddedLabels& labels_;
  Connectivity connectivity_;
  std::vector<std::ptrdiff_t> face_steps_, other_steps_, cube_steps_;
  std::vector<std::uint32_t> fronts_;  ///< by voxel, that of count_pieces that has come there
};

}  // namespace voxtet
