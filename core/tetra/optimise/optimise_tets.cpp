#include "tetra/optimise/optimise_tets.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <new>
#include <queue>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "tetra/interfaces/interface_flipping.h"
#include "tetra/interfaces/interface_sliding.h"
#include "tetra/mesh/tet_complex.h"
#include "tetra/mesh/vertices_apart.h"
#include "tetra/operations/local_swaps.h"
#include "tetra/operations/size_smoothing.h"
#include "tetra/operations/vertex_insertion.h"
#include "tetra/operations/vertex_smoothing.h"
#include "tetra/optimise/compound_improvement.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

using namespace tetra;

constexpr int kSmoothingSteps = 5;
/// Points for every one inserted, at least: a hopeless surface would take ever more.
constexpr std::size_t kPointsForOne = 10;
/// As many may be inserted into the smallest mesh.
constexpr std::size_t kAlwaysAllowed = 200;
/// A vertex inside of a layer makes two of it: only where nothing else helps.
constexpr double kLayerInsertionDeg = 20;
/// To this all else is tried before.
constexpr double kLayerGoalDeg = 21;
constexpr std::size_t kTetsPerQuestion = 256;
/// Tets for every step of compound trials, at least, but so many steps always: on a hopeless surface most
/// trials fail.
constexpr std::size_t kTetsForStep = 20;
constexpr std::size_t kStepsAlways = 5000;
/// Around tets that nothing else helps vertices may slide so much farther.
constexpr double kLastFreedom = 2;
/// Each holds the vertices where interfaces met in the one before.
constexpr int kSlidingTrials = 4;

class Optimiser {
 public:
  Optimiser(TetMesh mesh, const SurfaceMesh& reference, const SizingField& sizing,
            const OptimiseParams& params, const WallLayers& layers, const CutPlanes& cuts,
            const RunContext& ctx)
      : complex_(std::move(mesh)),
        guard_(sizing),
        smoother_(complex_, guard_),
        inserter_(complex_, guard_),
        volumes_(complex_, layers, reference),
        slider_(complex_, smoother_, reference, sizing, params.slide, layers, cuts, volumes_),
        flipper_(complex_, reference, sizing, guard_, params.slide, volumes_),
        compound_(complex_, guard_, smoother_, inserter_, slider_, counts_),
        params_(params),
        layers_(layers),
        ctx_(ctx),
        most_inserted_(std::max(kAlwaysAllowed, complex_.point_count() / kPointsForOne)) {}

  /// False when cancelled.
  bool run() {
    const double goal = quality_of_angle(params_.min_dihedral_deg);
    const double last_goal = quality_of_angle(params_.insertion_deg);
    const std::size_t bad_before = bad_tets(goal).size();
    for (int round = 0; round < params_.rounds; ++round) {
      const OperationCounts before = counts_;
      if (ctx_.cancelled() || !swap(goal) || !smooth(goal)) return false;
      // Most of what is bad at first only needs another neighbour or place.
      if (round > 0) {
        if (!insert(last_goal, false)) return false;
        slide(last_goal);
      }
      ctx_.progress(kOptimiseStage, static_cast<double>(round + 1) / params_.rounds);
      if (round > 0 && counts_ == before) break;
    }
    if (!layers_.empty()) {
      slide(last_goal);
      if (!combine(quality_of_angle(kLayerGoalDeg), false)) return false;
      if (!insert(quality_of_angle(kLayerInsertionDeg), true)) return false;
      slide(last_goal);
    }
    if (!combine(last_goal, true) || !combine_loosely(last_goal) || !fit_sizes(goal)) return false;
    tell(bad_before, bad_tets(goal).size());
    return true;
  }
  TetMesh release() { return std::move(complex_).release(); }

 private:
  using Entry = std::pair<double, std::uint32_t>;  ///< quality and place of a tet
  /// The worst tet first.
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

  Queue bad_tets(double goal) const {
    std::vector<Entry> bad;
    for (std::uint32_t t = 0; t < complex_.places(); ++t)
      if (complex_.alive(t) && complex_.quality_of(t) < goal) bad.emplace_back(complex_.quality_of(t), t);
    return Queue(std::greater<>{}, std::move(bad));
  }

  static std::vector<std::uint32_t> tets_of(Queue queue) {
    std::vector<std::uint32_t> tets;
    for (; !queue.empty(); queue.pop()) tets.push_back(queue.top().second);
    return tets;
  }

  /// Those on interfaces or those that are not, of the worst tets first.
  std::vector<std::uint32_t> vertices_of(Queue queue, bool on_interface) const {
    std::vector<std::uint8_t> seen(complex_.point_count(), 0);
    std::vector<std::uint32_t> vertices;
    for (; !queue.empty(); queue.pop())
      for (const std::uint32_t v : complex_.corners(queue.top().second))
        if (complex_.on_interface(v) == on_interface && !std::exchange(seen[v], std::uint8_t{1}))
          vertices.push_back(v);
    return vertices;
  }

  bool cancelled() { return ++questions_ % kTetsPerQuestion == 0 && ctx_.cancelled(); }

  /// Calls improve(t) for the tets below the goal, and again for those it makes; false when cancelled.
  template <class Improve>
  bool for_bad_tets(double goal, const Improve& improve) {
    Queue queue = bad_tets(goal);
    while (!queue.empty()) {
      if (cancelled()) return false;
      const auto [quality, t] = queue.top();
      queue.pop();
      if (!complex_.alive(t) || complex_.quality_of(t) != quality || !improve(t)) continue;
      for (const std::uint32_t made : complex_.made())
        if (complex_.quality_of(made) < goal) queue.emplace(complex_.quality_of(made), made);
    }
    return true;
  }

  bool swap(double goal) {
    return for_bad_tets(goal, [this](std::uint32_t t) {
      const Swap swapped = swap_at(complex_, t, guard_);
      counts_.add(swapped);
      return swapped != Swap::kNone;
    });
  }

  bool smooth(double goal) {
    return move_all<VertexSmoother>(
        vertices_of(bad_tets(goal), false),
        [goal](VertexSmoother& smoother, std::uint32_t v) {
          return smoother.smooth(v, goal, kSmoothingSteps);
        },
        counts_.moved);
  }

  /// Calls move(smoother, v) for vertices inside of labels, with the result of one after the other, and
  /// counts those that moved. False when cancelled.
  template <class Smoother, class Move>
  bool move_all(const std::vector<std::uint32_t>& vertices, const Move& move, std::size_t& moved) {
    if (ctx_.threads < 2) {
      Smoother smoother(complex_, guard_);
      for (const std::uint32_t v : vertices) {
        if (cancelled()) return false;
        moved += move(smoother, v);
      }
      return true;
    }
    const Buckets<std::uint32_t> groups = vertices_apart(complex_, vertices, ctx_.threads);
    std::vector<Smoother> smoothers(static_cast<std::size_t>(ctx_.threads), Smoother(complex_, guard_));
    std::atomic<std::size_t> count = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (ctx_.cancelled()) return false;
      const std::span<const std::uint32_t> group = groups.at(g);
      run_tasks_with(smoothers, group.size(),
                     [&](std::size_t i, Smoother& smoother) { count += move(smoother, vertices[group[i]]); });
    }
    moved += count;
    return true;
  }

  /// Inserts vertices into layers, or everywhere else.
  bool insert(double goal, bool layers) {
    return for_bad_tets(goal, [this, layers](std::uint32_t t) {
      return layers_.is_layer(complex_.label(t)) == layers && counts_.inserted < most_inserted_ &&
             inserter_.insert(t) && ++counts_.inserted > 0;
    });
  }

  void slide(double goal) {
    if (!(params_.slide > 0)) return;
    const std::vector<std::uint32_t> vertices = vertices_of(bad_tets(goal), true);
    slider_.approach(vertices);
    unless_interfaces_meet([&] {
      for (const std::uint32_t v : vertices) {
        if (cancelled()) return;
        counts_.slid += slider_.slide(v, goal);
      }
    });
    counts_.flipped += flipper_.flip(tets_of(bad_tets(goal)));
  }

  /// Does what slides vertices. Should interfaces meet then, it is taken back and tried again without the
  /// vertices there; in the end it is not done at all.
  template <class Slide>
  void unless_interfaces_meet(const Slide& slide) {
    for (int trial = 0; trial < kSlidingTrials; ++trial) {
      const OperationCounts before = counts_;
      const TetComplex::Mark start = complex_.mark();
      slide();
      const bool meet = slider_.hold_where_interfaces_meet(start);
      if (meet) {
        complex_.undo_to(start);
        counts_ = before;
      }
      complex_.forget_changes();
      if (!meet) return;
    }
  }

  /// Those on interfaces around the corners of the bad tets and around their neighbours.
  std::vector<std::uint32_t> interfaces_around(double goal) {
    std::vector<std::uint32_t> vertices = vertices_of(bad_tets(goal), false), star;
    IdSet around;
    std::vector<std::uint8_t> seen(complex_.point_count(), 0);
    const std::vector<std::uint32_t> on_interfaces = vertices_of(bad_tets(goal), true);
    vertices.insert(vertices.end(), on_interfaces.begin(), on_interfaces.end());
    for (const std::uint32_t v : vertices) seen[v] = 1;
    for (std::size_t ring = 0, first = 0; ring < 2; ++ring) {
      const std::size_t last = vertices.size();
      for (; first < last; ++first) {
        complex_.find_star(vertices[first], around, star);
        for (const std::uint32_t t : star)
          for (const std::uint32_t v : complex_.corners(t))
            if (!std::exchange(seen[v], std::uint8_t{1})) vertices.push_back(v);
      }
    }
    std::erase_if(vertices, [this](std::uint32_t v) { return !complex_.on_interface(v); });
    return vertices;
  }

  /// New vertices only if `insert`. False when cancelled.
  bool combine(double goal, bool insert) {
    if (params_.slide > 0) slider_.approach(interfaces_around(goal));
    const std::size_t most_steps = std::max(kStepsAlways, complex_.places() / kTetsForStep);
    bool going = true;
    unless_interfaces_meet([&] {
      const std::size_t first_step = compound_.steps();
      for (bool any = true; going && std::exchange(any, false);)
        for (const std::uint32_t t : tets_of(bad_tets(goal))) {
          if (compound_.steps() - first_step >= most_steps || !complex_.alive(t) ||
              !(complex_.quality_of(t) < goal))
            continue;
          if (!(going = !ctx_.cancelled())) break;
          any = compound_.improve(t, goal, insert && may_insert(t)) || any;
        }
    });
    return going;
  }

  /// For the handful of tets that are left. False when cancelled.
  bool combine_loosely(double goal) {
    if (!(params_.slide > 0) || bad_tets(goal).empty()) return true;
    slider_.loosen(kLastFreedom);
    return combine(goal, true);
  }

  /// False when cancelled.
  bool fit_sizes(double enough) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < complex_.point_count(); ++v)
      if (complex_.in_use(v) && !complex_.on_interface(v)) vertices.push_back(v);
    return move_all<SizeSmoother>(
        vertices, [enough](SizeSmoother& smoother, std::uint32_t v) { return smoother.smooth(v, enough); },
        counts_.fitted);
  }

  bool may_insert(std::uint32_t t) const {
    return counts_.inserted < most_inserted_ &&
           (!layers_.is_layer(complex_.label(t)) ||
            complex_.quality_of(t) < quality_of_angle(kLayerInsertionDeg));
  }

  void tell(std::size_t bad_before, std::size_t bad_after) const {
    const std::string goal = std::to_string(static_cast<int>(params_.min_dihedral_deg));
    ctx_.note(kOptimiseStage,
              "tets below " + goal + " degrees: " + std::to_string(bad_before) + ", then " +
                  std::to_string(bad_after) + "; edges removed: " + std::to_string(counts_.edges) +
                  ", faces removed: " + std::to_string(counts_.faces) + ", vertices moved: " +
                  std::to_string(counts_.moved) + ", for sizes: " + std::to_string(counts_.fitted) +
                  ", inserted: " + std::to_string(counts_.inserted) + ", slid on the surface: " +
                  std::to_string(counts_.slid) + ", flipped there: " + std::to_string(counts_.flipped));
    if (counts_.inserted == most_inserted_)
      ctx_.warn(kOptimiseStage, "vertices were inserted up to the limit of " +
                                    std::to_string(most_inserted_) + ": the surface leaves too little room");
  }

  TetComplex complex_;
  SizeGuard guard_;
  VertexSmoother smoother_;
  VertexInserter inserter_;
  VolumeKeeper volumes_;
  InterfaceSlider slider_;
  InterfaceFlipper flipper_;
  OperationCounts counts_;
  CompoundImprover compound_;
  OptimiseParams params_;
  const WallLayers& layers_;
  const RunContext& ctx_;
  std::size_t most_inserted_, questions_ = 0;
};

}  // namespace

Result<TetMesh> optimise_tets(TetMesh mesh, const SurfaceMesh& reference, const SizingField& sizing,
                              const OptimiseParams& params, RunContext& ctx, const WallLayers& layers,
                              const CutPlanes& cuts) {
  if (params.rounds < 1 || mesh.tets.empty()) return mesh;
  try {
    Optimiser optimiser(std::move(mesh), reference, sizing, params, layers, cuts, ctx);
    if (!optimiser.run()) return cancelled_error(kOptimiseStage);
    return optimiser.release();
  } catch (const std::bad_alloc&) {
    return Error{
        ErrorCode::kOutOfMemory, kOptimiseStage, "memory ran out while tetrahedra were optimised", {}};
  }
}

}  // namespace voxtet
