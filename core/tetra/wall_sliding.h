// Vertices on walls slide along the label surface.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/wall_layers.h"
#include "tetra/nearby_surface.h"
#include "tetra/tet_complex.h"
#include "tetra/vertex_smoothing.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet::tetra {

/// Slides vertices of walls that lie inside one patch: between the same two labels all around.
class WallSlider {
 public:
  /// `reference` is the label surface; its sides are those of the walls. `envelope`: how far from it vertices
  /// may go, as a part of the wished edge length. Around `layers`, but not on the sheets between them, so
  /// many slide that a label would lose volume: there each stays as far from the label surface as it was.
  WallSlider(TetComplex& complex, VertexSmoother& smoother, const SurfaceMesh& reference,
             const SizingField& sizing, double envelope, const WallLayers& layers);

  /// Slides the vertices one after the other where the lowest quality of their tets is not enough and rises,
  /// and returns how many moved. Each goes no farther from its first place than a fifth of its shortest edge
  /// on the walls, and no farther from the label surface than the envelope or than it was. Should walls meet
  /// then, all stay where they were.
  std::size_t slide(std::span<const std::uint32_t> vertices, double enough);

 private:
  /// The walls around a vertex inside a patch.
  struct Patch {
    std::uint32_t vertex;
    Sides sides;
    double shortest_edge, longest_edge;
  };
  std::optional<Patch> patch_at(std::uint32_t vertex);
  bool keeps_offset(const Sides& sides) const;
  std::size_t slide_patches(std::span<const Patch> patches, double enough, std::span<std::uint8_t> moved);
  bool walls_meet(std::span<const Patch> patches, std::span<const std::uint8_t> moved) const;

  TetComplex& complex_;
  VertexSmoother& smoother_;
  const SurfaceMesh& reference_;
  const SizingField& sizing_;
  double envelope_;
  const WallLayers& layers_;
  std::vector<Point> start_;               ///< of each vertex there was at first
  std::vector<std::uint32_t> wall_count_;  ///< walls at each of them now
  std::vector<std::uint32_t> star_;
};

}  // namespace voxtet::tetra
