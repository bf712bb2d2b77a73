#include "tetra/optimise/compound_improvement.h"

#include <algorithm>
#include <utility>

namespace voxtet::tetra {
namespace {

constexpr int kTurns = 6;
constexpr int kRelaxSteps = 5;
/// Vertices around which a trial looks for bad tets, at most.
constexpr std::size_t kMostVertices = 40;
/// Between two interfaces that are near each other edges may be out of the range of sizes by this factor.
constexpr double kMostMisfit = 1.5;

}  // namespace

void CompoundImprover::add_corners(std::uint32_t t) {
  for (const std::uint32_t v : complex_.corners(t))
    if (vertices_.size() < kMostVertices &&
        std::find(vertices_.begin(), vertices_.end(), v) == vertices_.end())
      vertices_.push_back(v);
}

bool CompoundImprover::open(std::uint32_t t, const VertexInserter::Start* opening) {
  vertices_.clear();
  if (opening == nullptr) {
    add_corners(t);
    return true;
  }
  if (!inserter_.insert_from(*opening, true, 0)) return false;
  ++counts_.inserted;
  for (const std::uint32_t made : complex_.made()) add_corners(made);
  return true;
}

void CompoundImprover::improve_one(std::uint32_t t, double goal) {
  ++steps_;
  const Swap swapped = swap_at(complex_, t, guard_);
  counts_.add(swapped);
  if (swapped != Swap::kNone) return;
  for (const std::uint32_t v : Tet(complex_.corners(t))) {
    const bool on_interface = complex_.on_interface(v);
    const bool moved = on_interface ? slider_.slide(v, goal, kMostMisfit)
                                    : smoother_.smooth(v, goal, kRelaxSteps, nullptr, kMostMisfit);
    (on_interface ? counts_.slid : counts_.moved) += moved;
  }
}

double CompoundImprover::settle(std::uint32_t t, double goal, const TetComplex::Mark& start) {
  double reached = -1;
  for (int turn = 0; turn < kTurns; ++turn) {
    tets_.clear();
    for (const std::uint32_t v : vertices_) {
      if (!complex_.in_use(v)) continue;
      complex_.find_star(v, seen_, star_);
      tets_.insert(tets_.end(), star_.begin(), star_.end());
    }
    std::sort(tets_.begin(), tets_.end());
    tets_.erase(std::unique(tets_.begin(), tets_.end()), tets_.end());
    std::stable_sort(tets_.begin(), tets_.end(), [this](std::uint32_t a, std::uint32_t b) {
      return complex_.quality_of(a) < complex_.quality_of(b);
    });
    for (const std::uint32_t bad : tets_) {
      if (!complex_.alive(bad) || complex_.quality_of(bad) >= goal) continue;
      add_corners(bad);
      improve_one(bad, goal);
    }
    const double lowest = lowest_touched(t, start);
    if (!(lowest > reached)) break;
    reached = lowest;
  }
  return reached;
}

double CompoundImprover::lowest_touched(std::uint32_t t, const TetComplex::Mark& since) const {
  double lowest = 1;
  const auto consider = [&](std::uint32_t place) {
    if (complex_.alive(place)) lowest = std::min(lowest, complex_.quality_of(place));
  };
  consider(t);
  for (const TetComplex::Change& change : complex_.changes_since(since))
    for (const std::uint32_t made : change.made) consider(made);
  return lowest;
}

bool CompoundImprover::attempt(std::uint32_t t, double goal, const VertexInserter::Start* opening) {
  const double before = complex_.quality_of(t);
  const OperationCounts counts_before = counts_;
  const TetComplex::Mark start = complex_.mark();
  if (open(t, opening)) {
    if (settle(t, goal, start) > before) return true;
  }
  complex_.undo_to(start);
  counts_ = counts_before;
  return false;
}

bool CompoundImprover::improve(std::uint32_t t, double goal, bool insert) {
  if (attempt(t, goal, nullptr)) return true;
  if (!insert) return false;
  const std::vector<VertexInserter::Start> starts = inserter_.starts_at(t);
  return std::any_of(starts.begin(), starts.end(),
                     [&](const VertexInserter::Start& start) { return attempt(t, goal, &start); });
}

}  // namespace voxtet::tetra
