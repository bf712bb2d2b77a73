#include "remesh/improve_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <utility>

#include "geometry/triangle_measures.h"
#include "remesh/adapt_passes.h"

namespace voxtet::remesh {
namespace {

constexpr const char* kStage = "remesh";
constexpr double kContentVoxels = 0.1;  ///< a sample this near to a triangle may be its
constexpr double kShort = 0.72;         ///< in wished lengths; refined surfaces have few natural edges below
constexpr double kRefinedGapShare = 0.2;  ///< EditLimits::gap_share; where sheets are near, edges stay short
constexpr double kTrialAngleDeg = 14;     ///< below this an angle is not worth opening again
constexpr int kHealingSplits = 12;        ///< to bring a facet nearer
constexpr double kLatticeVoxels = 0.6, kFineLatticeVoxels = 0.33;
constexpr double kLeastReachVoxels = 0.4;  ///< nearer than this is near enough
constexpr double kAimShare = 0.88;         ///< of the envelope: between samples facets may be farther
constexpr double kNearShare = 0.4;         ///< of the envelope: samples that need no closer look
constexpr double kNearerShare = 0.97;      ///< of the largest distance, if that is to fall
constexpr double kLeastWeight = 0.2;  ///< of a corner that is moved to bring a point of its triangle nearer

class Improver : public AdaptPasses {
 public:
  using AdaptPasses::AdaptPasses;

  /// False when cancelled.
  bool run();

 private:
  bool coarsen_in_steps();
  bool coarsen_to(double shortest);
  bool collapse(std::uint32_t v, std::uint32_t other, double longest);
  bool relocate_touched();
  bool come_nearer();
  bool unfold();
  bool unfold(std::uint32_t a, std::uint32_t b);
  bool is_opener(double sharpest);
  bool approach(std::uint32_t t, double reach_mm);
  bool bring_nearer(std::uint32_t t, const ComplexEditor::Breach& breach);
  bool is_nearer();
  template <class Operation, class Demanded>
  bool tried(Operation&& operation, Demanded&& demanded);
  template <class Operation, class Demanded>
  bool with_healing(Operation&& operation, Demanded&& demanded, int most_splits);
  bool heal(double limit_cosine, int most_splits);
  bool split_ahead_of(std::uint32_t t);

  struct Tried {
    std::uint32_t at = 0;  ///< after which attempt of the editor
    double shortest = 0;
  };
  std::vector<Tried> tried_;        ///< by vertex: when it could last go to no neighbour nearer than that
  std::uint32_t relocated_at_ = 0;  ///< after which attempt
  const double trial_cosine_ = cosine_of_deg(kTrialAngleDeg);
};

bool Improver::run() {
  editor_.limits.adapted = editor_.limits.keeps_balls = true;
  editor_.limits.gap_share = kRefinedGapShare;
  editor_.limits.lattice_mm = kLatticeVoxels * params_.voxel_mm;
  fit_cells();
  for (const double share : {0.8, 0.9}) {
    if (!step(share)) return false;
    if (!coarsen_in_steps() || !relocate_touched()) return false;
    if (!open_angles(editor_.limits.angle_cosine) || !open_folds()) return false;
  }
  return come_nearer() && unfold();
}

/// The shortest edges first: among edges of about one length, angles stay good.
bool Improver::coarsen_in_steps() {
  for (const double share : {0.125, 0.25, 0.5, 1.0})
    if (!coarsen_to(share * kShort)) return false;
  return true;
}

bool Improver::coarsen_to(double shortest) {
  tried_.resize(editor_.mesh().vertex_count());
  return coarsen(shortest, [&](std::uint32_t v, const std::vector<Near>& near, double longest) {
    const std::uint64_t lengths = editor_.refusals(Reason::kLength);
    for (const Near& other : near) {
      // What could not be done cannot be now, if nothing around has changed.
      const std::uint32_t changed = std::max(editor_.changed_at(v), editor_.changed_at(other.v));
      if (changed <= tried_[v].at && other.length < tried_[v].shortest) continue;
      if (collapse(v, other.v, longest)) return;
    }
    // Longer edges may be allowed to the next pass.
    tried_[v] = {editor_.attempts(), editor_.refusals(Reason::kLength) > lengths ? 0 : shortest};
  });
}

bool Improver::collapse(std::uint32_t v, std::uint32_t other, double longest) {
  const auto operation = [&] { return operations_.collapse(v, other, longest); };
  const std::uint64_t angles = editor_.refusals(Reason::kAngle);
  if (operation()) return true;
  // Healing is for angles alone.
  return editor_.refusals(Reason::kAngle) > angles && with_healing(
                                                          operation, [] { return true; }, 0);
}

/// Vertices around what changed, and at first around junction curves, whose vertices refinement puts beside
/// the reference's; each round nearer to the labels' volumes.
bool Improver::relocate_touched() {
  constexpr int kRounds = 3;
  const ComplexMesh& mesh = editor_.mesh();
  const bool with_curves = relocated_at_ == 0;
  std::vector<bool> touched(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!alive(v)) continue;
    if (editor_.changed_at(v) > relocated_at_) touched[v] = true;
    if (!with_curves || mesh.stratum(v) != Stratum::kCurve) continue;
    touched[v] = true;
    for (const std::uint32_t other : operations_.neighbours(v)) touched[other] = true;
  }
  for (int round = 0; round < kRounds; ++round) {
    lift_towards_volumes();
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      if (v % 4096 == 0 && ctx_.cancelled()) return false;
      if (touched[v] && alive(v)) operations_.relocate(v);
    }
  }
  relocated_at_ = editor_.attempts();
  return true;
}

/// Facets beyond the envelope; in a narrow one only those that are far. Again around what changed: what could
/// not be done may be possible then, and an operation may have taken another facet as far as its own was.
bool Improver::come_nearer() {
  constexpr int kPasses = 6;
  const ComplexMesh& mesh = editor_.mesh();
  const double reach_mm = std::max(kAimShare * editor_.limits.reach_mm, kLeastReachVoxels * params_.voxel_mm);
  editor_.limits.lattice_mm = kFineLatticeVoxels * params_.voxel_mm;
  std::uint32_t since = 0;
  bool any = true;
  for (int pass = 0; pass < kPasses && any; ++pass) {
    const std::uint32_t now = editor_.attempts();
    any = false;
    for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
      if (t % 4096 == 0 && ctx_.cancelled()) return false;
      if (!mesh.alive(t)) continue;
      const Triangle& corners = mesh.triangle(t);
      if (pass > 0 && std::none_of(corners.begin(), corners.end(),
                                   [&](std::uint32_t v) { return editor_.changed_at(v) > since; }))
        continue;
      any = approach(t, reach_mm) || any;
    }
    since = now;
  }
  return true;
}

/// Step by step; whether there was any.
bool Improver::approach(std::uint32_t t, double reach_mm) {
  constexpr int kMostSteps = 6;
  const double most_mm = 4 * reach_mm;  // beyond, another sheet may have been taken for the triangle's
  bool any = false;
  for (int step = 0; step < kMostSteps && editor_.mesh().alive(t); ++step) {
    if (editor_.well_sampled(t, kNearShare * reach_mm)) break;
    const ComplexEditor::Breach breach = editor_.farthest(t);
    if (breach.distance2 <= reach_mm * reach_mm || breach.distance2 > most_mm * most_mm) break;
    if (!bring_nearer(t, breach)) break;
    any = true;
  }
  return any;
}

/// Shifts of corners, flips, splits and collapses, whichever brings what is farthest nearer; first those that
/// keep the angles, then those after which they can be opened, last by more points.
bool Improver::bring_nearer(std::uint32_t t, const ComplexEditor::Breach& breach) {
  const ComplexMesh& mesh = editor_.mesh();
  const Triangle corners = mesh.triangle(t);
  std::array<std::pair<double, std::size_t>, 3> by_weight, by_length;  // the second is a corner
  for (std::size_t i = 0; i < 3; ++i) {
    by_weight[i] = {-breach.weights[static_cast<Eigen::Index>(i)], i};
    by_length[i] = {-(mesh.point(corners[(i + 1) % 3]) - mesh.point(corners[(i + 2) % 3])).squaredNorm(), i};
  }
  std::sort(by_weight.begin(), by_weight.end());
  std::sort(by_length.begin(), by_length.end());
  editor_.limits.nearer_mm = kNearerShare * std::sqrt(breach.distance2);
  constexpr int kNoHealing = -1;
  for (const int most_splits : {kNoHealing, 0, kHealingSplits}) {
    const auto nearer = [&] { return is_nearer(); };
    const auto attempt = [&](auto&& operation) {
      return most_splits == kNoHealing ? tried(operation, nearer)
                                       : with_healing(operation, nearer, most_splits);
    };
    const auto shift = [&](std::uint32_t v, const Eigen::Vector3d& by) {
      return attempt([&] { return operations_.shift(v, by, Demand::kNearer); });
    };
    for (const double step : {1.0, 0.5, 0.25})
      for (const auto& [weight, i] : by_weight) {
        const std::uint32_t v = corners[i];
        if (-weight > kLeastWeight && shift(v, step * breach.toward)) return true;
        std::uint32_t hint = editor_.hint(v);
        if (mesh.stratum(v) != Stratum::kCurve || hint == kNone) continue;
        if (shift(v, step * (editor_.reference().walk_curve(mesh.point(v), hint) - mesh.point(v))))
          return true;
      }
    for (const auto& [length, i] : by_length) {
      const std::uint32_t a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
      if (attempt([&] { return operations_.flip(a, b, Demand::kNearer); }) ||
          attempt([&] { return operations_.split(a, b, Demand::kNearer); }) ||
          attempt([&] { return operations_.collapse(a, b, kLongestPolished, Demand::kNearer); }) ||
          attempt([&] { return operations_.collapse(b, a, kLongestPolished, Demand::kNearer); }))
        return true;
    }
  }
  return false;
}

/// Edges that are still folded more sharply than the limits, again as long as that helps.
bool Improver::unfold() {
  constexpr int kPasses = 3;
  std::vector<std::uint32_t> around;
  bool any = true;
  for (int pass = 0; pass < kPasses && any; ++pass) {
    any = false;
    for (const Edge& e : edges()) {
      constexpr int kMostSteps = 6;
      for (int step = 0; step < kMostSteps; ++step) {
        if (sharpest_fold(e.a, e.b, around) <= editor_.fold_limit(e.a, e.b) || !unfold(e.a, e.b)) break;
        any = true;
      }
    }
    if (ctx_.cancelled()) return false;
  }
  return true;
}

/// Whatever opens the fold at an edge: first what keeps the angles, then that after which they can be opened,
/// last by more points.
bool Improver::unfold(std::uint32_t a, std::uint32_t b) {
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> around;
  const double sharpest = sharpest_fold(a, b, around);
  constexpr int kNoHealing = -1;
  for (const int most_splits : {kNoHealing, 0, kHealingSplits}) {
    const auto opener = [&] { return is_opener(sharpest); };
    const auto attempt = [&](auto&& operation) {
      return most_splits == kNoHealing ? tried(operation, opener)
                                       : with_healing(operation, opener, most_splits);
    };
    if (attempt([&] { return open_fold(a, b, around); })) return true;
    if (around.size() != 2) continue;
    const Eigen::Vector3d c = mesh.point(around[0]), d = mesh.point(around[1]);
    const Eigen::Vector3d inwards = 0.5 * (c + d - mesh.point(a) - mesh.point(b));
    for (const double step : {0.4, 0.2, 0.1}) {
      for (const std::uint32_t v : {a, b})
        if (attempt([&] { return operations_.shift(v, step * inwards, Demand::kBetterFold); })) return true;
      for (std::size_t i = 0; i < 2; ++i)
        if (attempt([&] {
              return operations_.shift(around[i], (i == 0 ? step : -step) * (c - d), Demand::kBetterFold);
            }))
          return true;
    }
  }
  return false;
}

/// Whether no fold of what the trial made is as sharp, or beyond the limits.
bool Improver::is_opener(double sharpest) {
  constexpr double kLeastGain = 1e-3;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> around;
  bool opener = true;
  editor_.for_trial_triangles([&](std::uint32_t t) {
    const Triangle corners = mesh.triangle(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t u = corners[i], w = corners[(i + 1) % 3];
      const double limit = std::max(editor_.fold_limit(u, w), sharpest - kLeastGain);
      opener = opener && sharpest_fold(u, w, around) <= limit;
    }
  });
  return opener;
}

/// Whether all that the trial made is: the operations themselves look at samples that have changed hosts, and
/// not at those that have kept them.
bool Improver::is_nearer() {
  const double limit = editor_.limits.nearer_mm;
  bool nearer = true;
  editor_.for_trial_triangles(
      [&](std::uint32_t t) { nearer = nearer && editor_.farthest(t).distance2 <= limit * limit; });
  return nearer;
}

/// An operation that is taken back unless what is demanded holds after it.
template <class Operation, class Demanded>
bool Improver::tried(Operation&& operation, Demanded&& demanded) {
  editor_.begin_trial();
  const bool good = operation() && demanded();
  if (good)
    editor_.keep_trial();
  else
    editor_.undo_trial();
  return good;
}

/// An operation that may leave poorer angles than allowed, if they can be opened again; else it is taken
/// back. Where points may be added facets need not stay Delaunay.
template <class Operation, class Demanded>
bool Improver::with_healing(Operation&& operation, Demanded&& demanded, int most_splits) {
  const EditLimits strict = editor_.limits;
  editor_.limits.angle_cosine = std::max(strict.angle_cosine, trial_cosine_);
  if (most_splits > 0) editor_.limits.keeps_balls = false;
  const bool good = tried(operation, [&] { return heal(strict.angle_cosine, most_splits) && demanded(); });
  editor_.limits = strict;
  return good;
}

/// Opens the angles of what the trial made, down to the limit or to what it found; gives up at the first that
/// can be opened neither by what adds no points nor by so many splits.
bool Improver::heal(double limit_cosine, int most_splits) {
  constexpr int kRounds = 4;
  const int rounds = kRounds + most_splits;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> poor;
  for (int round = 0; round <= rounds; ++round) {
    const double limit = std::max(limit_cosine, editor_.trial_cosine_before());
    const auto is_poor = [&](std::uint32_t t) {
      return sharpest_cosine(mesh.corners(mesh.triangle(t))) > limit;
    };
    poor.clear();
    editor_.for_trial_triangles([&](std::uint32_t t) {
      if (is_poor(t)) poor.push_back(t);
    });
    if (poor.empty()) return true;
    if (round == rounds) break;
    std::sort(poor.begin(), poor.end());
    poor.erase(std::unique(poor.begin(), poor.end()), poor.end());
    for (const std::uint32_t t : poor)
      if (mesh.alive(t) && is_poor(t) && !open_angle(t) && (most_splits-- <= 0 || !split_ahead_of(t)))
        return false;
  }
  return false;
}

/// Splits the first edge on the way from longest edge to longest edge that is the longest of all triangles
/// at it (Rivara 1997).
bool Improver::split_ahead_of(std::uint32_t t) {
  constexpr int kMostSteps = 8;
  const ComplexMesh& mesh = editor_.mesh();
  for (int step = 0; step < kMostSteps; ++step) {
    const Triangle corners = mesh.triangle(t);
    const auto length_of = [&](std::size_t i) {
      return (mesh.point(corners[i]) - mesh.point(corners[(i + 1) % 3])).norm();
    };
    std::size_t side = 2;
    for (const std::size_t i : {1, 0})
      if (length_of(i) > length_of(side)) side = i;
    const std::uint32_t a = corners[side], b = corners[(side + 1) % 3];
    double longest = length_of(side);
    const std::uint32_t from = t;
    for (const std::uint32_t other : mesh.star(a)) {
      if (other == from || !has_corner(mesh.triangle(other), b)) continue;
      const double length = longest_edge_mm(mesh.corners(mesh.triangle(other)));
      if (length > longest) {
        longest = length;
        t = other;
      }
    }
    if (t == from) return operations_.split(a, b, Demand::kNearer);
  }
  return false;
}

}  // namespace

Result<SurfaceMesh> improve_surface(const SurfaceMesh& surface, const SurfaceMesh& reference,
                                    const SizingField& sizing, const AdaptParams& params, RunContext& ctx,
                                    AdaptRecord* record) {
  try {
    if (surface.triangles.empty()) return surface;
    std::vector<Sides> sides = surface.sides;
    sides.insert(sides.end(), reference.sides.begin(), reference.sides.end());
    const ComplexMesh mesh(surface, sides), other(reference, sides);
    Improver improver(mesh, other, nearest_parts(mesh, other, kContentVoxels * params.voxel_mm), sizing,
                      params, ctx);
    if (!improver.run()) return cancelled_error(kStage);
    if (record) *record = improver.record();
    return improver.surface();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 kStage,
                 "not enough memory to improve " + std::to_string(surface.triangles.size()) + " triangles",
                 {}};
  }
}

}  // namespace voxtet::remesh
