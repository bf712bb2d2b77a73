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
constexpr double kRefinedGapShare = 0.4;  ///< EditLimits::gap_share; where sheets are near, edges stay short
constexpr double kTrialAngleDeg = 18;     ///< below this an angle is not worth opening again
constexpr double kLatticeVoxels = 0.6, kFineLatticeVoxels = 0.5;
constexpr double kLeastReachVoxels = 0.45;  ///< nearer than this is near enough
constexpr double kNearShare = 0.4;          ///< of the envelope: samples that need no closer look
constexpr double kNearerShare = 0.97;       ///< of the largest distance, if that is to fall
constexpr double kLeastWeight = 0.2;  ///< of a corner that is moved to bring a point of its triangle nearer

class Improver : public AdaptPasses {
 public:
  using AdaptPasses::AdaptPasses;

  /// False when cancelled.
  bool run();

 private:
  bool coarsen_to(double shortest, bool healing);
  bool relocate_touched();
  bool come_nearer();
  bool bring_nearer(std::uint32_t t, const ComplexEditor::Breach& breach);
  template <class Operation>
  bool with_healing(Operation&& operation);
  bool heal(double limit_cosine);

  const double trial_cosine_ = cosine_of_deg(kTrialAngleDeg);
};

bool Improver::run() {
  editor_.limits.adapted = true;
  editor_.limits.gap_share = kRefinedGapShare;
  editor_.limits.lattice_mm = kLatticeVoxels * params_.voxel_mm;
  fit_cells();
  for (const bool healing : {true, false}) {
    if (!step(healing ? 0.8 : 0.9)) return false;
    if (!coarsen_to(0.5 * kShort, healing) || !coarsen_to(kShort, healing) || !relocate_touched())
      return false;
    if (!open_angles(editor_.limits.angle_cosine) || !open_folds()) return false;
  }
  return come_nearer();
}

bool Improver::coarsen_to(double shortest, bool healing) {
  return coarsen(shortest, [&](std::uint32_t v, std::uint32_t other, double longest) {
    const auto collapse = [&] { return operations_.collapse(v, other, longest); };
    return collapse() || (healing && with_healing(collapse));
  });
}

/// Vertices around what changed, and around junction curves, whose vertices refinement puts beside the
/// reference's; each round nearer to the labels' volumes.
bool Improver::relocate_touched() {
  constexpr int kRounds = 2;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<bool> touched = operations_.take_touched();
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (alive(v) && mesh.stratum(v) == Stratum::kCurve) {
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
  return true;
}

/// Facets beyond the envelope; in a narrow one only those that are far.
bool Improver::come_nearer() {
  constexpr int kMostSteps = 6;
  const ComplexMesh& mesh = editor_.mesh();
  const double reach_mm = std::max(editor_.limits.reach_mm, kLeastReachVoxels * params_.voxel_mm);
  const double most_mm = 2 * reach_mm;  // beyond, another sheet may have been taken for the triangle's
  editor_.limits.lattice_mm = kFineLatticeVoxels * params_.voxel_mm;
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    if (t % 4096 == 0 && ctx_.cancelled()) return false;
    for (int step = 0; step < kMostSteps && mesh.alive(t); ++step) {
      if (editor_.well_sampled(t, kNearShare * reach_mm)) break;
      const ComplexEditor::Breach breach = editor_.farthest(t);
      if (breach.distance2 <= reach_mm * reach_mm || breach.distance2 > most_mm * most_mm) break;
      if (!bring_nearer(t, breach)) break;
    }
  }
  return true;
}

/// Shifts of corners, flips, splits and collapses, whichever brings what is farthest nearer; first those that
/// keep the angles.
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
  for (const bool healing : {false, true}) {
    const auto attempt = [&](auto&& operation) { return healing ? with_healing(operation) : operation(); };
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

/// An operation that may leave poorer angles than allowed, if they can be opened again; else it is taken
/// back.
template <class Operation>
bool Improver::with_healing(Operation&& operation) {
  const double strict = editor_.limits.angle_cosine;
  editor_.limits.angle_cosine = std::max(strict, trial_cosine_);
  editor_.begin_trial();
  const bool healed = operation() && heal(strict);
  editor_.limits.angle_cosine = strict;
  if (healed)
    editor_.keep_trial();
  else
    editor_.undo_trial();
  return healed;
}

/// Opens the angles of what the trial made, down to the limit or to what it found.
bool Improver::heal(double limit_cosine) {
  constexpr int kRounds = 4;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> poor;
  for (int round = 0; round <= kRounds; ++round) {
    const double limit = std::max(limit_cosine, editor_.trial_cosine_before());
    poor.clear();
    editor_.for_trial_triangles([&](std::uint32_t t) {
      if (sharpest_cosine(mesh.corners(mesh.triangle(t))) > limit) poor.push_back(t);
    });
    if (poor.empty()) return true;
    if (round == kRounds) break;
    std::sort(poor.begin(), poor.end());
    poor.erase(std::unique(poor.begin(), poor.end()), poor.end());
    for (const std::uint32_t t : poor)
      if (mesh.alive(t)) open_angle(t);
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
