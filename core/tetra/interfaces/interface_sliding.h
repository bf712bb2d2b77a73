// Vertices on interfaces slide along the label surface.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/cut/cut_plane.h"
#include "tetra/interfaces/nearby_surface.h"
#include "tetra/interfaces/volume_keeper.h"
#include "tetra/mesh/tet_complex.h"
#include "tetra/operations/vertex_smoothing.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"
#include "walls/wall_layers.h"

namespace voxtet::tetra {

/// Slides vertices of interfaces that lie inside one patch (the same two labels all around) or inside one
/// junction curve (the same patches meet at both neighbouring edges).
class InterfaceSlider {
 public:
  /// `reference` is the label surface; its sides are those of the interfaces. `envelope`: how far from it
  /// vertices may go, as a part of the target edge length. Vertices must stay as far from the label surface
  /// as they were where a label would not keep its volume by `volumes`, on `cuts`, and on the boundary of
  /// `layers`, but not on the sheets between them.
  InterfaceSlider(TetComplex& complex, VertexSmoother& smoother, const SurfaceMesh& reference,
                  const SizingField& sizing, double envelope, const WallLayers& layers, const CutPlanes& cuts,
                  const VolumeKeeper& volumes);

  /// From now on vertices may go this much farther than the envelope, and their own reach, would let them.
  void loosen(double factor) { freedom_ *= factor; }

  /// Finds the label surface near these vertices. Needed before they, or others among them, slide.
  void approach(std::span<const std::uint32_t> vertices);

  /// Slides a vertex if the lowest quality of its tets is below `enough` and rises. The vertex stays within a
  /// fifth of its shortest interface edge from its first place. It gets no farther from the label surface, or
  /// the curve on it, than the envelope or than it was. Sizes: see VertexSmoother.
  bool slide(std::uint32_t vertex, double enough, double most_misfit = 1);

  /// Whether interfaces meet beyond their common corners and edges, at least one of them at a vertex that
  /// moved since the mark. The vertices of such interfaces slide no more.
  bool hold_where_interfaces_meet(const TetComplex::Mark& since);

 private:
  /// What a vertex slides on.
  struct Seat {
    BoundaryKind kind;
    double shortest_edge, longest_edge;  ///< on the interfaces
  };
  std::optional<Seat> seat_of(std::uint32_t vertex);
  bool is_of_layers(const BoundaryKind& kind) const;
  bool keeps_offset(const BoundaryKind& kind) const;

  TetComplex& complex_;
  VertexSmoother& smoother_;
  const SurfaceMesh& reference_;
  const SizingField& sizing_;
  double envelope_;
  double freedom_ = 1;
  const WallLayers& layers_;
  const CutPlanes& cuts_;
  const VolumeKeeper& volumes_;
  std::vector<Point> start_;                    ///< first place of each vertex of the original mesh
  std::vector<std::uint32_t> interface_count_;  ///< interfaces at each of them when it was approached
  std::vector<std::uint8_t> held_;              ///< 1: slides no more
  std::optional<NearbySurface> nearby_;
  IdSet seen_;
  std::vector<std::uint32_t> star_;
};

}  // namespace voxtet::tetra
