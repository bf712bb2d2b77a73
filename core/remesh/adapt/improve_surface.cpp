#include "remesh/adapt/improve_surface.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <vector>

#include "remesh/adapt/facet_mender.h"
#include "types/stage_names.h"

namespace voxtet::remesh {
namespace {

constexpr double kContentVoxels = 0.1;  ///< a sample this near to a triangle may be its
constexpr double kShort = 0.72;  ///< in target edge lengths; refined surfaces have few natural edges below
constexpr double kRefinedGapShare = 0.2;  ///< EditLimits::gap_share; where sheets are near, edges stay short
constexpr double kLatticeVoxels = 0.6;

class Improver : public FacetMender {
 public:
  using FacetMender::FacetMender;

  /// False when cancelled.
  bool run();

 private:
  bool coarsen_in_steps();
  bool coarsen_to(double shortest);
  bool coarsen_again();
  bool collapse(std::uint32_t v, std::uint32_t other, double longest);
  bool is_in_tube(std::uint32_t v, const std::vector<Near>& near);
  bool leave_tube(std::uint32_t v, const std::vector<Near>& near);
  bool mend_trial(double angle_cosine);
  bool relocate_touched();

  struct Tried {
    std::uint32_t at = 0;  ///< after which attempt of the editor
    double shortest = 0;
  };
  std::vector<Tried> tried_;        ///< by vertex: when it could last go to no neighbour nearer than that
  std::uint32_t relocated_at_ = 0;  ///< after which attempt
};

bool Improver::run() {
  editor_.limits.adapted = editor_.limits.keeps_delaunay = true;
  editor_.limits.gap_share = kRefinedGapShare;
  editor_.limits.lattice_mm = kLatticeVoxels * params_.voxel_mm;
  fit_cells();
  constexpr int kPasses = 3;
  for (int pass = 0; pass < kPasses; ++pass) {
    if (!step(static_cast<double>(pass) / (kPasses + 1))) return false;
    if (!coarsen_in_steps() || !relocate_touched()) return false;
    if (!open_angles(editor_.limits.angle_cosine) || !open_folds()) return false;
  }
  if (!come_nearer() || !coarsen_again()) return false;
  // What one pass opens the other may reach.
  constexpr int kRounds = 2;
  for (int round = 0; round < kRounds; ++round)
    if (!come_nearer() || !unfold()) return false;
  return true;
}

/// The shortest edges first: among edges of about one length, angles stay good.
bool Improver::coarsen_in_steps() {
  for (const double share : {0.125, 0.25, 0.5, 1.0}) {
    if (!coarsen_to(share * kShort)) return false;
    fit_cells();
  }
  return true;
}

/// What came nearer by more points may need fewer; it stays as near, and labels get their volumes back.
bool Improver::coarsen_again() {
  const double reach_mm = editor_.limits.reach_mm;
  editor_.limits.reach_mm = std::min(reach_mm, aim_mm());
  relocated_at_ = editor_.attempts();
  const bool done = coarsen_to(kShort) && relocate_touched();
  editor_.limits.reach_mm = reach_mm;
  return done;
}

bool Improver::coarsen_to(double shortest) {
  tried_.resize(editor_.mesh().vertex_count());
  return coarsen(shortest, [&](std::uint32_t v, const std::vector<Near>& near, double longest) {
    const std::uint64_t lengths = editor_.refusals(Refusal::kLength);
    bool any_new = false;
    for (const Near& other : near) {
      // What could not be done cannot be now, if nothing around has changed.
      const std::uint32_t changed = std::max(editor_.changed_at(v), editor_.changed_at(other.v));
      if (changed <= tried_[v].at && other.length < tried_[v].shortest) continue;
      any_new = true;
      if (collapse(v, other.v, longest)) return;
    }
    if (any_new && shortest == kShort && is_in_tube(v, near) && leave_tube(v, near)) return;
    // Longer edges may be allowed to the next pass.
    tried_[v] = {editor_.attempts(), editor_.refusals(Refusal::kLength) > lengths ? 0 : shortest};
  });
}

/// Where angles refuse it, it is healed; where normals do, as around necks hardly wider than an edge, they
/// count for no more than a sliver's, and a closer look replaces them.
bool Improver::collapse(std::uint32_t v, std::uint32_t other, double longest) {
  const auto operation = [&] { return operations_.collapse(v, other, longest); };
  const std::uint64_t angles = editor_.refusals(Refusal::kAngle),
                      normals = editor_.refusals(Refusal::kNormal);
  if (operation()) return true;
  const auto heal = [&](auto&& demanded) { return attempt(operation, demanded, Healing::kAngles); };
  if (editor_.refusals(Refusal::kAngle) > angles && heal([] { return true; })) return true;
  if (editor_.refusals(Refusal::kNormal) == normals) return false;
  const EditLimits strict = editor_.limits;
  const double reach_mm = strict.reach_mm;
  editor_.limits.turn_cosine = kTurnCosineOfSlivers;
  editor_.limits.sure_mm = reach_mm;
  const bool done = heal([&] { return is_within(reach_mm * reach_mm); });
  editor_.limits = strict;
  return done;
}

/// Whether a short edge at v is part of a ring of three around what lies inside or outside: its ends have
/// common neighbours beside its triangles' corners.
bool Improver::is_in_tube(std::uint32_t v, const std::vector<Near>& near) {
  const ComplexMesh& mesh = editor_.mesh();
  if (mesh.stratum(v) != Stratum::kSurface) return false;
  const std::vector<std::uint32_t>& around = operations_.neighbours(v);
  return std::any_of(near.begin(), near.end(), [&](const Near& other) {
    return std::count_if(around.begin(), around.end(), [&](std::uint32_t w) {
             return w != other.v && mesh.edge_degree(w, other.v) > 0;
           }) > 2;
  });
}

/// Rings of three cannot become wider, but fewer. A vertex that goes to the next ring leaves angles and folds
/// behind, as sharp as they may be at junctions, that only other operations open.
bool Improver::leave_tube(std::uint32_t v, const std::vector<Near>& near) {
  const EditLimits strict = editor_.limits;
  const double reach_mm = strict.reach_mm;
  bool left = false;
  for (std::size_t i = 0; i < near.size() && !left; ++i) {
    editor_.limits.angle_cosine = std::max(strict.angle_cosine, trial_cosine_);
    editor_.limits.crease_cosine = strict.junction_cosine;
    editor_.limits.nearer_mm = 0;
    left = attempt(
        [&] {
          const bool done = operations_.collapse(v, near[i].v, kLongest, Demand::kNearer);
          editor_.limits.crease_cosine = strict.crease_cosine;
          return done && mend_trial(strict.angle_cosine);
        },
        [&] {
          editor_.limits.sure_mm = reach_mm;
          return is_within(reach_mm * reach_mm);
        },
        Healing::kNone);
    editor_.limits = strict;
  }
  return left;
}

/// Opens angles and folds of what the trial made, one and the other in turn, down to the limits; where the
/// trial found smaller angles, down to those. Gives up at the first that cannot be opened: few trials go well
/// after that, and where all vertices are in tubes, as in a checkerboard of voxels, they cost most.
bool Improver::mend_trial(double angle_cosine) {
  constexpr int kRounds = 4;
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<std::uint32_t> around, made;
  for (int round = 0; round <= kRounds; ++round) {
    const double limit = std::max(angle_cosine, editor_.trial_cosine_before());
    made.clear();
    editor_.for_trial_triangles([&](std::uint32_t t) { made.push_back(t); });
    std::sort(made.begin(), made.end());
    made.erase(std::unique(made.begin(), made.end()), made.end());
    bool good = true;
    for (const std::uint32_t t : made) {
      if (mesh.alive(t) && sharpest_cosine(mesh.corners(mesh.triangle(t))) > limit) {
        if (round == kRounds || !open_angle(t)) return false;
        good = false;
      }
      if (!mesh.alive(t)) continue;
      const Triangle corners = mesh.triangle(t);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
        if (mesh.edge_degree(a, b) == 0 || sharpest_fold(a, b, around) <= editor_.fold_limit(a, b)) continue;
        if (round == kRounds || !open_fold(a, b, around)) return false;
        good = false;
      }
    }
    if (good) return true;
  }
  return false;
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
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (touched[v]) vertices.push_back(v);
  for (int round = 0; round < kRounds; ++round) {
    offset_towards_volumes();
    if (!relocate(vertices)) return false;
  }
  relocated_at_ = editor_.attempts();
  return true;
}

}  // namespace

Result<SurfaceMesh> improve_surface(const SurfaceMesh& surface, const SurfaceMesh& reference,
                                    const SizingField& sizing, const AdaptParams& params, RunContext& ctx,
                                    AdaptRecord* record) {
  try {
    if (surface.triangles.empty()) return surface;
    std::vector<Sides> sides;
    for (const SurfaceMesh* part : {&surface, &reference})
      std::unique_copy(part->sides.begin(), part->sides.end(), std::back_inserter(sides));
    const ComplexMesh mesh(surface, sides), other(reference, sides);
    if (ctx.cancelled()) return cancelled_error(kRemeshStage);
    const Correspondence correspondence = nearest_parts(mesh, other, kContentVoxels * params.voxel_mm);
    if (ctx.cancelled()) return cancelled_error(kRemeshStage);
    Improver improver(mesh, other, correspondence, sizing, params, ctx);
    if (!improver.run()) return cancelled_error(kRemeshStage);
    if (record) *record = improver.record();
    return improver.surface();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 kRemeshStage,
                 "not enough memory to improve " + std::to_string(surface.triangles.size()) + " triangles",
                 {}};
  }
}

}  // namespace voxtet::remesh
