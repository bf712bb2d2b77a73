// Tets that lie flat on an interface change sides.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tetra/interfaces/nearby_surface.h"
#include "tetra/interfaces/volume_keeper.h"
#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/size_guard.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

/// A tet whose two or three interfaces are all to the same label gets that label (if it is background, the
/// tet is removed). On the interface this is a flip of an edge, or the removal of a vertex with three
/// triangles; nothing moves.
class InterfaceFlipper {
 public:
  /// `reference` is the label surface; its sides are those of the interfaces. `envelope`, as a part of the
  /// target edge length: how far from it the middle of a new edge or triangle may be, unless the middle of
  /// the old ones is as far.
  InterfaceFlipper(TetComplex& complex, const SurfaceMesh& reference, const SizingField& sizing,
                   const SizeGuard& guard, double envelope, const VolumeKeeper& volumes)
      : complex_(complex),
        reference_(reference),
        sizing_(sizing),
        guard_(guard),
        envelope_(envelope),
        volumes_(volumes) {}

  /// Relabels those of these tets, one after the other, for which that raises the lowest quality around;
  /// returns how many. Every label keeps its topology and, by `volumes`, its volume.
  std::size_t flip(std::span<const std::uint32_t> tets);

 private:
  struct Candidate {
    std::uint32_t t;
    Label other;
    std::array<bool, 4> interface;  ///< of the sides
    Point old_middle, new_middle;
  };
  std::optional<Candidate> candidate_at(std::uint32_t t) const;
  bool keeps_topology(const Candidate& candidate);
  bool keeps_angles(const Candidate& candidate) const;
  InterfaceExchange exchange_of(const Candidate& candidate) const;
  /// Whether all other tets at these corners of t have the other label; there may be background only if it is
  /// the other label.
  bool only_other_around(const Candidate& candidate, std::span<const std::uint32_t> corners);

  TetComplex& complex_;
  const SurfaceMesh& reference_;
  const SizingField& sizing_;
  const SizeGuard& guard_;
  double envelope_;
  const VolumeKeeper& volumes_;
  IdSet seen_;
  std::vector<std::uint32_t> star_;
};

}  // namespace voxtet::tetra
