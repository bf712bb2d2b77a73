// Passes over a whole complex; the schedules of adaptation are made of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/buckets.h"
#include "geometry/topology/adjacency.h"
#include "remesh/adapt/adapt_complex.h"
#include "remesh/adapt/local_operations.h"
#include "remesh/editor/complex_editor.h"
#include "remesh/envelope/correspondence.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/stage_names.h"

namespace voxtet::remesh {

/// Cosine by Taylor's series: the same on every platform, as std::cos is not.
double cosine_of_deg(double deg);

/// Each pass visits vertices, edges or triangles in their order. Passes that return bool return false when
/// cancelled. Lengths are in target edge lengths.
class AdaptPasses {
 public:
  /// Both complexes have the same table of sides.
  AdaptPasses(const ComplexMesh& mesh, const ComplexMesh& reference, const Correspondence& correspondence,
              const SizingField& sizing, const AdaptParams& params, RunContext& ctx);

  SurfaceMesh surface() const { return editor_.mesh().to_surface(); }
  AdaptRecord record() const { return {operations_.accepted, editor_.violations()}; }

 protected:
  static constexpr double kShortest = 4.0 / 5, kLongest = 4.0 / 3;  ///< Botsch and Kobbelt 2004
  static constexpr double kLongestPolished = 1.7;                   ///< where shape is at stake

  /// Sets the cells of the triangle search to twice the edge length (fastest, as measured), unless edges are
  /// about as long as at the last call.
  void fit_cells();
  struct Near {
    double length;
    std::uint32_t v;
  };
  /// For each vertex v, calls collapse_to_one(v, neighbours, longest), which may collapse it onto one of
  /// these: its neighbours nearer than `shortest`, the nearest first; there may be none. `longest` is a bound
  /// on edges.
  template <class CollapseToOne>
  bool coarsen(double shortest, CollapseToOne&& collapse_to_one);
  /// ComplexEditor::set_coarsest.
  void set_coarsest(bool on) {
    editor_.set_coarsest(on);
    nearest_.clear();
  }
  bool refine();
  bool flip_all();
  bool relocate_all();
  /// Vertices that are alive; those near each other in this order.
  bool relocate(const std::vector<std::uint32_t>& vertices);
  /// Triangles with smaller planar angles than the limit: see open_angle.
  bool open_angles(double limit_cosine);
  /// Flips the longest edge away, moves corners, or closes the triangle; returns whether anything was done.
  bool open_angle(std::uint32_t t);
  /// Each edge once, ascending by its ends.
  std::vector<Edge> edges() const;
  /// Cosine of the sharpest dihedral angle at an edge; `around` receives the corners opposite to it.
  double sharpest_fold(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& around) const;
  /// Tries to open edges whose dihedral angle is sharper than the limits.
  bool open_folds();
  /// Flips the edge away, moves corners, or closes triangles; returns whether anything was done.
  bool open_fold(std::uint32_t a, std::uint32_t b, const std::vector<std::uint32_t>& around);
  /// Lets relocation offset sheets so that the labels have the reference's volumes, to first order.
  void offset_towards_volumes();

  bool alive(std::uint32_t v) const { return !editor_.mesh().star(v).empty(); }
  bool step(double share) {
    ctx_.progress(kRemeshStage, share);
    return !ctx_.cancelled();
  }
  /// Whether the run is cancelled, asked every few thousand items of a pass or hundred attempts.
  bool cancelled_at(std::size_t item) {
    constexpr std::uint32_t kItems = 4096, kAttempts = 128;
    if (item % kItems != 0 && editor_.attempts() - asked_at_ < kAttempts) return false;
    asked_at_ = editor_.attempts();
    return ctx_.cancelled();
  }

  const AdaptParams& params_;
  RunContext& ctx_;
  ComplexEditor editor_;
  LocalOperations operations_;

 private:
  Buckets<std::uint32_t> spread(const std::vector<std::uint32_t>& vertices) const;
  /// Result of the last search for the nearest vertex that a vertex may collapse onto.
  struct Nearest {
    double length = 0;
    std::uint32_t at = 0;  ///< the number of the editor's attempts at that time
  };
  /// Whether it is known from before that v has no such neighbour nearer than `shortest`.
  bool known_apart(std::uint32_t v, double shortest) const {
    return nearest_[v].length >= shortest && editor_.changed_at(v) <= nearest_[v].at;
  }

  const std::vector<double> volumes_;  ///< of the reference, by label
  std::vector<Nearest> nearest_;       ///< by vertex; length 0 where it was not looked at
  double cell_mm_ = 0;
  std::uint32_t fitted_at_ = 0;  ///< the number of the editor's attempts at that time
  std::uint32_t asked_at_ = 0;   ///< the same, when it was last asked whether the run is cancelled
};

template <class CollapseToOne>
bool AdaptPasses::coarsen(double shortest, CollapseToOne&& collapse_to_one) {
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<Near> near;
  const double longest = std::min(kLongest, 2.2 * shortest);
  nearest_.resize(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (cancelled_at(v)) return false;
    if (!alive(v) || mesh.stratum(v) == Stratum::kCorner) continue;
    near.clear();
    if (!known_apart(v, shortest)) {
      nearest_[v] = {std::numeric_limits<double>::infinity(), editor_.attempts()};
      for (const std::uint32_t other : operations_.neighbours(v)) {
        if (mesh.stratum(other) < mesh.stratum(v)) continue;
        const double length = editor_.metric_length(v, other);
        nearest_[v].length = std::min(nearest_[v].length, length);
        if (length < shortest) near.push_back({length, other});
      }
    }
    std::sort(near.begin(), near.end(), [](const Near& p, const Near& q) {
      return p.length != q.length ? p.length < q.length : p.v < q.v;
    });
    collapse_to_one(v, near, longest);
  }
  return true;
}

}  // namespace voxtet::remesh
