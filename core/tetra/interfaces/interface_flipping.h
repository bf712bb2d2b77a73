// Tets that lie flat on an interface go to the other side.
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

/// Gives a tet with two or three interfaces, all to the same label, to that label (or to background: it is
/// gone). On the interface this is a flip of an edge, or of a vertex with three triangles; nothing moves.
class InterfaceFlipper {
 public:
  /// `reference` is the label surface; its sides are those of the interfaces. `envelope`: how far from it the
  /// middle of a new edge or triangle may be, as a part of the target edge length, where that of the old ones
  /// is not as far.
  InterfaceFlipper(TetComplex& complex, const SurfaceMesh& reference, const SizingField& sizing,
                   const SizeGuard& guard, double envelope, const VolumeKeeper& volumes)
      : complex_(complex),
        reference_(reference),
        sizing_(sizing),
        guard_(guard),
        envelope_(envelope),
        volumes_(volumes) {}

  /// Of these tets those whose going over lets the lowest quality rise there, one after the other; how many.
  /// The topology of every label stays, and by `volumes` its volume.
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
  /// Whether all other tets at these corners of t have the other label, and there is no background unless it
  /// is the other label.
  bool only_other_around(const Candidate& candidate, std::span<const std::uint32_t> corners);

  TetComplex& complex_;
  const SurfaceMesh& reference_;
  const SizingField& sizing_;
  const SizeGuard& guard_;
  double envelope_;
  const VolumeKeeper& volumes_;
  std::vector<std::uint32_t> star_;
};

}  // namespace voxtet::tetra
