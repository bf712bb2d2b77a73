// Passes over a whole complex, of which the schedules of adaptation are made.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "remesh/adapt_complex.h"
#include "remesh/complex_editor.h"
#include "remesh/correspondence.h"
#include "remesh/local_operations.h"
#include "types/run_context.h"
#include "types/sizing_field.h"

namespace voxtet::remesh {

/// Cosine by Taylor's series: the same on every platform, as std::cos is not.
double cosine_of_deg(double deg);

/// Each pass goes through vertices, edges or triangles in their order; those that return bool are false when
/// cancelled. Lengths are in wished lengths.
class AdaptPasses {
 public:
  /// Both complexes have the same table of sides.
  AdaptPasses(const ComplexMesh& mesh, const ComplexMesh& reference, const Correspondence& correspondence,
              const SizingField& sizing, const AdaptParams& params, RunContext& ctx);

  SurfaceMesh surface() const { return editor_.mesh().to_surface(); }
  AdaptRecord record() const;

 protected:
  struct Edge {
    std::uint32_t a, b;
    double length;
  };
  static constexpr double kShortest = 4.0 / 5, kLongest = 4.0 / 3;  ///< Botsch and Kobbelt 2004
  static constexpr double kLongestPolished = 1.7;                   ///< where shape is at stake

  /// Cells of the search as large as edges are long.
  void fit_cells();
  /// Each vertex goes to its nearest neighbour that takes it and is nearer than `shortest`:
  /// collapse(v, neighbour, longest), `longest` a bound on edges, tells whether it did.
  template <class Collapse>
  bool coarsen(double shortest, Collapse&& collapse);
  bool refine();
  bool flip_all();
  bool relocate_all();
  /// Triangles with smaller planar angles than the limit: see open_angle.
  bool open_angles(double limit_cosine);
  /// Flips away the longest edges, moves corners, or closes the triangle.
  void open_angle(std::uint32_t t);
  /// Edges folded more sharply than the limits: whatever opens them.
  bool open_folds();
  /// Relocation puts sheets where the labels have the reference's volumes, to first order.
  void lift_towards_volumes();

  bool alive(std::uint32_t v) const { return !editor_.mesh().star(v).empty(); }
  bool step(double share) {
    ctx_.progress("remesh", share);
    return !ctx_.cancelled();
  }

  const AdaptParams& params_;
  RunContext& ctx_;
  ComplexEditor editor_;
  LocalOperations operations_;

 private:
  std::vector<Edge> edges() const;
  void open_fold(const Edge& e, const std::vector<std::uint32_t>& around);

  const std::vector<double> volumes_;  ///< of the reference, by label
};

template <class Collapse>
bool AdaptPasses::coarsen(double shortest, Collapse&& collapse) {
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::pair<double, std::uint32_t>> near;
  const double longest = std::min(kLongest, 2.2 * shortest);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (v % 4096 == 0 && ctx_.cancelled()) return false;
    if (!alive(v) || mesh.stratum(v) == Stratum::kCorner) continue;
    near.clear();
    for (const std::uint32_t other : operations_.neighbours(v)) {
      const double length = editor_.metric_length(v, other);
      if (length < shortest && mesh.stratum(other) >= mesh.stratum(v)) near.emplace_back(length, other);
    }
    std::sort(near.begin(), near.end());
    for (const auto& [length, other] : near)
      if (collapse(v, other, longest)) break;
  }
  return true;
}

}  // namespace voxtet::remesh
