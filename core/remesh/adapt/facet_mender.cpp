#include "remesh/adapt/facet_mender.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace voxtet::remesh {
namespace {

constexpr double kMendLatticeVoxels = 0.5;
constexpr double kLeastReachVoxels = 0.4;  ///< nearer than this is near enough
constexpr std::uint8_t kMostFailures = 2;  ///< to bring a facet nearer
constexpr std::uint32_t kLookedAhead = 16384;
constexpr double kAimShare = 0.95;     ///< of the envelope: between samples facets may be farther
constexpr double kNearShare = 0.4;     ///< of the envelope: samples that need no closer look
constexpr double kNearerShare = 0.97;  ///< of the largest distance, if that is to fall
constexpr double kLeastWeight = 0.2;   ///< of a corner that is moved to bring a point of its triangle nearer

}  // namespace

double FacetMender::aim_mm() const {
  return std::max(kAimShare * editor_.limits.reach_mm, kLeastReachVoxels * params_.voxel_mm);
}

bool FacetMender::come_nearer() {
  constexpr int kPasses = 6;
  const ComplexMesh& mesh = editor_.mesh();
  const double reach_mm = aim_mm();
  editor_.limits.lattice_mm = kMendLatticeVoxels * params_.voxel_mm;
  editor_.limits.sure_mm = reach_mm;
  bool any = true;
  for (int pass = 0; pass < kPasses && any; ++pass) {
    const std::uint32_t now = editor_.attempts();
    any = false;
    std::uint32_t ahead_at = now;  // after which attempt was looked ahead
    for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
      if (cancelled_at(t)) return false;
      if (t % kLookedAhead == 0) {
        ahead_at = editor_.attempts();
        look_ahead(t, reach_mm);
      }
      const bool known = t < is_far_.size() && !touched_since(t, ahead_at);
      if (is_worth_a_look(t) && (!known || is_far_[t] != 0)) any = approach(t, reach_mm) || any;
    }
    looked_at_ = now;
  }
  return true;
}

bool FacetMender::touched_since(std::uint32_t t, std::uint32_t attempt) const {
  const Triangle& corners = editor_.mesh().triangle(t);
  return std::any_of(corners.begin(), corners.end(),
                     [&](std::uint32_t v) { return editor_.touched_at(v) > attempt; });
}

bool FacetMender::is_worth_a_look(std::uint32_t t) const {
  if (!editor_.mesh().alive(t) || (t < failures_.size() && failures_[t] >= kMostFailures)) return false;
  const Triangle& corners = editor_.mesh().triangle(t);
  return looked_at_ == 0 || std::any_of(corners.begin(), corners.end(),
                                        [&](std::uint32_t v) { return editor_.changed_at(v) > looked_at_; });
}

/// Which of the next triangles are beyond the envelope; holds for those that nothing touches.
void FacetMender::look_ahead(std::uint32_t from, double reach_mm) {
  const std::size_t end = std::min<std::size_t>(editor_.mesh().slot_count(), from + kLookedAhead);
  is_far_.assign(end, 0);
  editor_.make_room_for_deviations();
  parallel_for(ctx_.threads, end - from, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto t = static_cast<std::uint32_t>(from + i);
      is_far_[t] = is_worth_a_look(t) && far_place(t, reach_mm).has_value();
    }
  });
}

/// Where a triangle is beyond the envelope.
std::optional<Deviation> FacetMender::far_place(std::uint32_t t, double reach_mm) const {
  const double most_mm = 4 * reach_mm;  // beyond, another sheet may have been taken for the triangle's
  if (editor_.well_sampled(t, kNearShare * reach_mm)) return std::nullopt;
  const Deviation deviation = editor_.farthest(t);
  if (deviation.distance2 <= reach_mm * reach_mm || deviation.distance2 > most_mm * most_mm)
    return std::nullopt;
  return deviation;
}

/// Step by step; whether there was any.
bool FacetMender::approach(std::uint32_t t, double reach_mm) {
  constexpr int kMostSteps = 6;
  bool any = false;
  for (int step = 0; step < kMostSteps && editor_.mesh().alive(t); ++step) {
    const std::optional<Deviation> deviation = far_place(t, reach_mm);
    if (!deviation) break;
    if (!bring_nearer(t, *deviation)) {
      ++failures_of(t);
      break;
    }
    any = true;
  }
  return any;
}

/// Shifts of corners, flips, splits and collapses, whichever brings what is farthest nearer; first those that
/// keep the angles, then those after which they can be opened, then by more points. Beyond the envelope,
/// last, what splits first.
bool FacetMender::bring_nearer(std::uint32_t t, const Deviation& deviation) {
  const ComplexMesh& mesh = editor_.mesh();
  const Triangle corners = mesh.triangle(t);
  std::array<std::pair<double, std::size_t>, 3> by_weight, by_length;  // the second is a corner
  for (std::size_t i = 0; i < 3; ++i) {
    by_weight[i] = {-deviation.weights[static_cast<Eigen::Index>(i)], i};
    by_length[i] = {-(mesh.point(corners[(i + 1) % 3]) - mesh.point(corners[(i + 2) % 3])).squaredNorm(), i};
  }
  std::sort(by_weight.begin(), by_weight.end());
  std::sort(by_length.begin(), by_length.end());
  const double nearer_mm = kNearerShare * std::sqrt(deviation.distance2);
  editor_.limits.nearer_mm = nearer_mm;
  for (const Healing healing : kHealings) {
    const auto done = [&](auto&& operation) {
      return attempt(
          operation, [&] { return is_within(nearer_mm * nearer_mm); }, healing);
    };
    const auto shift = [&](std::uint32_t v, const Eigen::Vector3d& by) {
      return done([&] { return operations_.shift(v, by, Demand::kNearer); });
    };
    for (const double step : {1.0, 0.5, 0.25})
      for (const auto& [weight, i] : by_weight) {
        const std::uint32_t v = corners[i];
        if (-weight > kLeastWeight && shift(v, step * deviation.toward)) return true;
        std::uint32_t hint = editor_.hint(v);
        if (mesh.stratum(v) != Stratum::kCurve || hint == kNone) continue;
        if (shift(v, step * (editor_.reference().walk_curve(mesh.point(v), hint) - mesh.point(v))))
          return true;
      }
    for (const auto& [length, i] : by_length) {
      const std::uint32_t a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
      if (done([&] { return operations_.flip(a, b, Demand::kNearer); }) ||
          done([&] { return operations_.split(a, b, Demand::kNearer); }) ||
          done([&] { return operations_.collapse(a, b, kLongestPolished, Demand::kNearer); }) ||
          done([&] { return operations_.collapse(b, a, kLongestPolished, Demand::kNearer); }))
        return true;
    }
  }
  if (deviation.distance2 <= editor_.limits.reach_mm * editor_.limits.reach_mm) return false;
  for (const double step : {1.0, 0.5, 0.25})
    for (const auto& [weight, i] : by_weight)
      if (-weight > kLeastWeight && split_and_shift(corners[i], step * deviation.toward)) return true;
  return false;
}

/// A vertex that is to go about as far as its edges are long takes its neighbours' share of the reference
/// with it, or turns facets over: one of the edges is split first.
bool FacetMender::split_and_shift(std::uint32_t v, const Eigen::Vector3d& by) {
  const double reach_mm = editor_.limits.reach_mm;
  const std::vector<std::uint32_t> neighbours = operations_.neighbours(v);
  return std::any_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t other) {
    return attempt(
        [&] {
          return operations_.split(v, other, Demand::kNearer) && operations_.shift(v, by, Demand::kNearer);
        },
        [&] { return is_within(reach_mm * reach_mm); }, Healing::kPoints);
  });
}

/// The operations themselves look at samples that have changed hosts, and not at those that have kept them.
bool FacetMender::is_within(double distance2) {
  bool within = true;
  editor_.for_trial_triangles(
      [&](std::uint32_t t) { within = within && editor_.farthest(t).distance2 <= distance2; });
  return within;
}

bool FacetMender::unfold() {
  constexpr int kPasses = 3;
  editor_.limits.nearer_mm = 0;
  std::vector<std::uint32_t> around;
  bool any = true;
  for (int pass = 0; pass < kPasses && any; ++pass) {
    any = false;
    const std::vector<Edge> all = edges();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (cancelled_at(i)) return false;
      const auto& [a, b] = all[i];
      constexpr int kMostSteps = 6;
      for (int step = 0; step < kMostSteps; ++step) {
        if (sharpest_fold(a, b, around) <= editor_.fold_limit(a, b) || !unfold(a, b)) break;
        any = true;
      }
    }
  }
  return true;
}

/// Whatever opens the fold at an edge and takes nothing beyond the envelope: first what keeps the angles,
/// then that after which they can be opened, last by more points.
bool FacetMender::unfold(std::uint32_t a, std::uint32_t b) {
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> around;
  const double sharpest = sharpest_fold(a, b, around);
  double distance2 = aim_mm() * aim_mm();
  for (const std::uint32_t end : {a, b})
    for (const std::uint32_t t : mesh.star(end))
      distance2 = std::max(distance2, editor_.farthest(t).distance2);
  for (const Healing healing : kHealings) {
    const auto done = [&](auto&& operation) {
      return attempt(
          operation, [&] { return is_flatter(sharpest) && is_within(distance2); }, healing);
    };
    if (done([&] { return open_fold(a, b, around); })) return true;
    if (around.size() != 2) continue;
    const Eigen::Vector3d c = mesh.point(around[0]), d = mesh.point(around[1]);
    const Eigen::Vector3d inwards = 0.5 * (c + d - mesh.point(a) - mesh.point(b));
    for (const double step : {0.4, 0.2, 0.1}) {
      for (const std::uint32_t v : {a, b})
        if (done([&] { return operations_.shift(v, step * inwards, Demand::kBetterFold); })) return true;
      for (std::size_t i = 0; i < 2; ++i)
        if (done([&] {
              return operations_.shift(around[i], (i == 0 ? step : -step) * (c - d), Demand::kBetterFold);
            }))
          return true;
    }
  }
  return false;
}

/// Whether no fold of what the trial made is as sharp, or beyond the limits.
bool FacetMender::is_flatter(double sharpest) {
  constexpr double kLeastGain = 1e-3;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> around;
  bool flatter = true;
  editor_.for_trial_triangles([&](std::uint32_t t) {
    const Triangle corners = mesh.triangle(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t u = corners[i], w = corners[(i + 1) % 3];
      const double limit = std::max(editor_.fold_limit(u, w), sharpest - kLeastGain);
      flatter = flatter && sharpest_fold(u, w, around) <= limit;
    }
  });
  return flatter;
}

}  // namespace voxtet::remesh
