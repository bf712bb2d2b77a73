// Conducting tissue on a mesh: its fibres, how fast it conducts, and how its cells react.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace voxtet {

/// The two-variable cell of Mitchell and Schaeffer, "A two-current model for the dynamics of cardiac
/// membrane", Bulletin of Mathematical Biology 65 (2003).
struct CellParams {
  double tau_in_ms = 0.3;
  double tau_out_ms = 6;
  double tau_open_ms = 120;
  double tau_close_ms = 150;
  double gate = 0.13;  ///< v at which the gate turns from opening to closing; v is 0 at rest, at most 1
  bool modified =
      false;  ///< Corrado and Niederer, Mathematical Biosciences 281 (2016): never paces by itself
};

/// One kind of tissue. The speeds are those of a plane wave in resting tissue, in mm/ms (= m/s).
struct TissueKind {
  double along_mm_per_ms = 0.5;   ///< along the fibre
  double across_mm_per_ms = 0.5;  ///< across it; the same: without a direction
  CellParams cell;
};

/// Directions of muscle fibres and of the sheets that they form. One entry for each tetrahedron, or for each
/// point: unit vectors, at right angles to each other, whose signs mean nothing. Zero where there is no
/// muscle.
struct Fibres {
  std::vector<Eigen::Vector3d> fibre;
  std::vector<Eigen::Vector3d> sheet;  ///< in the plane of the sheet, across the fibre
};

/// Tissue on the tetrahedra of a mesh, one entry of each list for each.
struct Tissue {
  static constexpr std::uint16_t kNone = 0xffff;  ///< conducts nothing: scar, blood

  std::vector<TissueKind> kinds;
  std::vector<std::uint16_t> kind;  ///< index into `kinds`, or kNone
  /// The part that conducts, more than 0 to 1; multiplies the diffusivity, and so the square of the speed.
  /// Empty: all of it.
  std::vector<float> share;
  /// Unit vectors, whose sign means nothing. Empty: tissue without fibres, of along = across.
  std::vector<Eigen::Vector3d> fibre;
};

}  // namespace voxtet
