#include "remesh/adapt/adapt_complex.h"

#include <algorithm>
#include <new>

#include "geometry/elements/triangle_measures.h"
#include "remesh/adapt/healing_passes.h"
#include "types/stage_names.h"

namespace voxtet::remesh {
namespace {

constexpr double kGapShare = 0.25;     ///< EditLimits::gap_share
constexpr double kPoorCosine = 0.9;    ///< 26 degrees: planar angles below this are polished
constexpr int kPasses = 3;             ///< to the sizing field
constexpr double kWorstCosine = 0.93;  ///< 21.6 degrees: below this with changes around

class Adapter : public HealingPasses {
 public:
  using HealingPasses::HealingPasses;

  /// False when cancelled.
  bool run() { return params_.schedule == AdaptSchedule::kAdaptive ? run_adaptive() : run_paper(); }

 private:
  bool run_adaptive();
  bool run_paper();
  bool coarsen_to(double shortest) {
    return coarsen(shortest, [&](std::uint32_t v, const std::vector<Near>& near, double longest) {
      for (const Near& other : near)
        if (operations_.collapse(v, other.v, longest)) return;
    });
  }
  bool coarsen_in_steps();
  bool quarter();
  bool polish();
  bool balance();
  bool open_worst_angles();
  bool open_worst_angle(std::uint32_t t);
};

/// Offsets interfaces along their normals until the labels have the reference's volumes.
bool Adapter::balance() {
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round) {
    offset_towards_volumes();
    if (!relocate_all()) return false;
  }
  return true;
}

bool Adapter::polish() {
  constexpr int kRounds = 4;
  if (!balance()) return false;
  for (int round = 0; round < kRounds; ++round) {
    if (!open_angles(kPoorCosine) || !open_folds()) return false;
    if (round == 0 && !balance()) return false;
  }
  return open_worst_angles();
}

/// Triangles that no single operation has opened.
bool Adapter::open_worst_angles() {
  const ComplexMesh& mesh = editor_.mesh();
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    if (cancelled_at(t)) return false;
    if (mesh.alive(t) && sharpest_cosine(mesh.corners(mesh.triangle(t))) > kWorstCosine) open_worst_angle(t);
  }
  return true;
}

/// Whatever leaves no angle as small, once what it spoils around is healed.
bool Adapter::open_worst_angle(std::uint32_t t) {
  constexpr double kLeastGain = 1e-3;
  const ComplexMesh& mesh = editor_.mesh();
  const Triangle corners = mesh.triangle(t);
  const double limit = sharpest_cosine(mesh.corners(corners)) - kLeastGain;
  for (const Healing healing : {Healing::kAngles, Healing::kPoints}) {
    const auto done = [&](auto&& operation) {
      return attempt(
          operation,
          [&] {
            bool open = true;
            editor_.for_trial_triangles([&](std::uint32_t made) {
              open = open && sharpest_cosine(mesh.corners(mesh.triangle(made))) <= limit;
            });
            return open;
          },
          healing);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
      if (done([&] { return operations_.collapse(a, b, kLongestPolished, Demand::kNearer); }) ||
          done([&] { return operations_.collapse(b, a, kLongestPolished, Demand::kNearer); }) ||
          done([&] { return operations_.flip(a, b, Demand::kNearer); }) ||
          done([&] { return operations_.split(a, b, Demand::kNearer); }))
        return true;
    }
  }
  return false;
}

/// First at the scale of the input's own triangles, where the search needs small cells.
bool Adapter::coarsen_in_steps() {
  for (const double shortest : {0.3, 0.45, 0.6}) {
    fit_cells();
    if (!coarsen_to(shortest)) return false;
  }
  fit_cells();
  editor_.limits.gap_share = kGapShare;
  return true;
}

bool Adapter::run_adaptive() {
  if (!coarsen_in_steps()) return false;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!step(0.3 + 0.6 * pass / kPasses)) return false;
    if (!coarsen_to(kShortest) || !refine() || !flip_all() || !relocate_all() || !open_angles(kPoorCosine) ||
        !relocate_all())
      return false;
  }
  return polish();
}

/// Zilske, Lamecker and Zachow 2008: sizes first, the shapes after.
bool Adapter::run_paper() {
  set_coarsest(true);
  if (!coarsen_in_steps() || !coarsen_to(kShortest)) return false;
  set_coarsest(false);
  if (!step(0.4)) return false;
  constexpr int kMostLevels = 12;
  for (int level = 0; level < kMostLevels; ++level) {
    fit_cells();
    const std::uint64_t before = operations_.accepted[0];
    if (!quarter()) return false;
    if (operations_.accepted[0] == before) break;
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!step(0.6 + 0.3 * pass / kPasses)) return false;
    // Triangles that close the neighbours of those cut in four are small: the worst go.
    if (!coarsen_to(0.75 * kShortest) || !refine() || !flip_all() || !relocate_all() || !relocate_all())
      return false;
  }
  return polish();
}

/// Cuts triangles with too long edges in four: their edges are split in any order, then each new edge from
/// a new vertex to an old one is flipped if it lies between two new ones. Neighbours are closed by two or
/// three triangles.
bool Adapter::quarter() {
  const ComplexMesh& mesh = editor_.mesh();
  constexpr double kSqrt2 =
      1.4142135623730951;  // edges of this length are too long by as much as halves too short
  std::vector<Edge> marked;
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t)) continue;
    const auto& [a, b, c] = mesh.triangle(t);
    if (editor_.metric_length(a, b) + editor_.metric_length(b, c) + editor_.metric_length(c, a) <= 3 * kSqrt2)
      continue;
    for (const auto& [u, w] : {Edge{a, b}, Edge{b, c}, Edge{c, a}})
      marked.push_back({std::min(u, w), std::max(u, w)});
  }
  std::sort(marked.begin(), marked.end());
  marked.erase(std::unique(marked.begin(), marked.end()), marked.end());
  const auto old_count = static_cast<std::uint32_t>(mesh.vertex_count());
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (cancelled_at(i)) return false;
    operations_.split(marked[i][0], marked[i][1]);
  }
  for (std::uint32_t v = old_count; v < mesh.vertex_count(); ++v) {
    if (cancelled_at(v)) return false;
    for (const std::uint32_t other : std::vector<std::uint32_t>(operations_.neighbours(v))) {
      if (other >= old_count || mesh.is_curve(v, other)) continue;
      std::uint32_t opposite_new = 0;
      for (const std::uint32_t t : mesh.star(v))
        if (has_corner(mesh.triangle(t), other))
          opposite_new += third_corner(mesh.triangle(t), v, other) >= old_count ? 1 : 0;
      if (opposite_new == 2) operations_.flip(v, other, Demand::kAllowed);
    }
  }
  return true;
}

}  // namespace

Result<SurfaceMesh> adapt_complex(const SurfaceMesh& reference, const SizingField& sizing,
                                  const AdaptParams& params, RunContext& ctx, AdaptRecord* record) {
  try {
    if (reference.triangles.empty()) return reference;
    const ComplexMesh mesh(reference);
    Adapter adapter(mesh, mesh, same_complex(mesh), sizing, params, ctx);
    if (!adapter.run()) return cancelled_error(kRemeshStage);
    if (record) *record = adapter.record();
    return adapter.surface();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 kRemeshStage,
                 "not enough memory to adapt " + std::to_string(reference.triangles.size()) + " triangles",
                 {}};
  }
}

}  // namespace voxtet::remesh
