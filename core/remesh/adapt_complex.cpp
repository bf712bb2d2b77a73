#include "remesh/adapt_complex.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>

#include "geometry/triangle_measures.h"
#include "remesh/complex_editor.h"
#include "remesh/local_operations.h"
#include "remesh/volume_lifts.h"

namespace voxtet::remesh {
namespace {

constexpr double kLongest = 4.0 / 3, kShortest = 4.0 / 5;  ///< wished lengths
constexpr double kLongestPolished = 1.7;                   ///< the same, where shape is at stake
/// Asked for instead of 1, since triangles between these two bounds come out finer (measured).
constexpr double kScale = 1.08;
constexpr double kCreaseCosine = 0.5;  ///< 60 degrees
constexpr double kGapShare = 0.25;
constexpr double kPoorCosine = 0.9;  ///< 26 degrees: planar angles below this are polished
constexpr const char* kStage = "remesh";

/// Taylor's series: the same on every platform, as std::cos is not.
double cosine_of_deg(double deg) {
  const double x = deg * (EIGEN_PI / 180);
  double sum = 0, term = 1;
  for (int k = 0; k < 20; ++k) {
    sum += term;
    term *= -x * x / ((2 * k + 1) * (2 * k + 2));
  }
  return sum;
}

struct Edge {
  std::uint32_t a, b;
  double length;
};

/// The passes over the complex, each in the order of vertices or triangles.
class Adapter {
 public:
  Adapter(const SurfaceMesh& reference, const SizingField& sizing, const AdaptParams& params, RunContext& ctx)
      : params_(params),
        ctx_(ctx),
        editor_(reference, sizing),
        operations_(editor_),
        volumes_(label_volumes(editor_.mesh())) {
    editor_.set_scale(kScale);
    operations_.shape_weight = params.shape_weight;
    EditLimits& limits = editor_.limits;
    limits.reach_mm = params.envelope_voxels * params.voxel_mm;
    limits.lattice_mm = 0.9 * params.voxel_mm;
    limits.angle_cosine = cosine_of_deg(params.min_angle_deg);
    limits.crease_cosine = std::min(kCreaseCosine, cosine_of_deg(params.min_dihedral_deg));
    limits.junction_cosine = cosine_of_deg(params.min_dihedral_deg);
    limits.verify = params.verify;
  }

  /// False when cancelled.
  bool run() { return params_.schedule == AdaptSchedule::kAdaptive ? run_adaptive() : run_paper(); }
  SurfaceMesh surface() const { return editor_.mesh().to_surface(); }
  void write(AdaptRecord& record) const {
    record.accepted = operations_.accepted;
    record.violations = editor_.violations();
    record.refused.clear();
    for (std::size_t i = 1; i < kReasonNames.size(); ++i)
      record.refused.push_back({kReasonNames[i], editor_.refusals()[i]});
  }

 private:
  bool run_adaptive();
  bool run_paper();
  bool coarsen(double shortest);
  bool refine();
  bool coarsen_in_steps();
  bool quarter();
  bool flip_all();
  bool relocate_all();
  bool polish();
  bool balance();
  bool open_angles();
  void open_angle(std::uint32_t t);
  bool open_folds();
  void open_fold(const Edge& e, const std::vector<std::uint32_t>& around);
  void fit_cells();
  std::vector<Edge> edges() const;
  bool alive(std::uint32_t v) const { return !editor_.mesh().star(v).empty(); }
  bool step(double share) {
    ctx_.progress(kStage, share);
    return !ctx_.cancelled();
  }

  const AdaptParams& params_;
  RunContext& ctx_;
  ComplexEditor editor_;
  LocalOperations operations_;
  const std::vector<double> volumes_;  ///< of the reference, by label
};

/// Each edge once, ascending by its ends.
std::vector<Edge> Adapter::edges() const {
  const ComplexMesh& mesh = editor_.mesh();
  std::vector<Edge> out;
  std::vector<std::uint32_t> others;
  for (std::uint32_t a = 0; a < mesh.vertex_count(); ++a) {
    others.clear();
    for (const std::uint32_t t : mesh.star(a))
      for (const std::uint32_t b : mesh.triangle(t))
        if (b > a) others.push_back(b);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const std::uint32_t b : others) out.push_back({a, b, editor_.metric_length(a, b)});
  }
  return out;
}

/// Cells of the search as large as edges are long.
void Adapter::fit_cells() {
  const ComplexMesh& mesh = editor_.mesh();
  double sum = 0;
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t)) {
      const Corners p = mesh.corners(mesh.triangle(t));
      sum += (p[0] - p[1]).norm() + (p[1] - p[2]).norm() + (p[2] - p[0]).norm();
      count += 3;
    }
  editor_.set_cell(
      std::max(sum / static_cast<double>(std::max<std::size_t>(count, 1)), 1e-6 * params_.voxel_mm));
}

/// Each vertex goes to its nearest neighbour that takes it and is nearer than `shortest` wished lengths.
bool Adapter::coarsen(double shortest) {
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
      if (operations_.collapse(v, other, longest)) break;
  }
  return true;
}

bool Adapter::refine() {
  std::vector<Edge> all = edges();
  std::erase_if(all, [](const Edge& e) { return e.length <= kLongest; });
  std::stable_sort(all.begin(), all.end(), [](const Edge& p, const Edge& q) { return p.length > q.length; });
  for (const Edge& e : all)
    if (editor_.mesh().edge_degree(e.a, e.b) > 0) operations_.split(e.a, e.b);
  return !ctx_.cancelled();
}

bool Adapter::flip_all() {
  for (const Edge& e : edges())
    if (editor_.mesh().edge_degree(e.a, e.b) > 0 && operations_.valence_gain(e.a, e.b) > 0)
      operations_.flip(e.a, e.b, Demand::kAllowed);
  return !ctx_.cancelled();
}

bool Adapter::relocate_all() {
  for (std::uint32_t v = 0; v < editor_.mesh().vertex_count(); ++v) {
    if (v % 4096 == 0 && ctx_.cancelled()) return false;
    if (alive(v)) operations_.relocate(v);
  }
  return true;
}

bool Adapter::open_angles() {
  const ComplexMesh& mesh = editor_.mesh();
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t) && sharpest_cosine(mesh.corners(mesh.triangle(t))) > kPoorCosine) open_angle(t);
  return !ctx_.cancelled();
}

/// Flips away the longest edges, moves corners, or closes the triangle.
void Adapter::open_angle(std::uint32_t t) {
  const ComplexMesh& mesh = editor_.mesh();
  const Triangle corners = mesh.triangle(t);
  std::array<std::pair<double, std::size_t>, 3> sides;  // by length; the second is the opposite corner
  for (std::size_t i = 0; i < 3; ++i)
    sides[i] = {(mesh.point(corners[(i + 1) % 3]) - mesh.point(corners[(i + 2) % 3])).squaredNorm(), i};
  std::sort(sides.begin(), sides.end());
  const auto end = [&](std::size_t side, std::size_t which) {
    return corners[(sides[side].second + which) % 3];
  };
  for (const std::size_t side : {2, 1})
    if (operations_.flip(end(side, 1), end(side, 2), Demand::kBetterAngle)) return;
  for (const std::uint32_t v : corners)
    if (operations_.open(v, Demand::kBetterAngle)) return;
  for (const std::size_t side : {0, 1, 2})
    if (operations_.collapse(end(side, 1), end(side, 2), kLongestPolished, Demand::kBetterAngle) ||
        operations_.collapse(end(side, 2), end(side, 1), kLongestPolished, Demand::kBetterAngle))
      return;
}

/// Edges folded more sharply than the limits: whatever opens them.
bool Adapter::open_folds() {
  const ComplexMesh& mesh = editor_.mesh();
  for (const Edge& e : edges()) {
    std::vector<std::uint32_t> around;
    for (const std::uint32_t t : mesh.star(e.a))
      if (has_corner(mesh.triangle(t), e.b)) around.push_back(third_corner(mesh.triangle(t), e.a, e.b));
    double sharpest = -1;
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        sharpest = std::max(sharpest, fold_cosine(mesh.point(e.a), mesh.point(e.b), mesh.point(around[i]),
                                                  mesh.point(around[j])));
    if (sharpest > editor_.fold_limit(e.a, e.b)) open_fold(e, around);
  }
  return !ctx_.cancelled();
}

void Adapter::open_fold(const Edge& e, const std::vector<std::uint32_t>& around) {
  if (operations_.flip(e.a, e.b, Demand::kBetterFold)) return;
  for (const std::uint32_t v : {e.a, e.b})
    if (operations_.open(v, Demand::kBetterFold)) return;
  for (const std::uint32_t v : around)
    if (operations_.open(v, Demand::kBetterFold)) return;
  for (const std::uint32_t v : around)
    for (const std::uint32_t end : {e.a, e.b})
      if (operations_.collapse(v, end, kLongestPolished, Demand::kBetterFold) ||
          operations_.collapse(end, v, kLongestPolished, Demand::kBetterFold))
        return;
}

/// Lifts sheets until the labels have the reference's volumes.
bool Adapter::balance() {
  constexpr int kRounds = 2;
  constexpr double kMostVoxels = 0.1;
  for (int round = 0; round < kRounds; ++round) {
    const ComplexMesh& mesh = editor_.mesh();
    std::vector<double> lacking = volumes_;
    const std::vector<double> now = label_volumes(mesh);
    for (std::size_t l = 0; l < lacking.size(); ++l) lacking[l] -= now[l];
    const std::vector<double> more =
        volume_lifts(mesh.sides(), pair_areas(mesh), lacking, kMostVoxels * params_.voxel_mm);
    for (std::size_t pair = 0; pair < more.size(); ++pair) operations_.lifts[pair] += more[pair];
    if (!relocate_all()) return false;
  }
  return true;
}

bool Adapter::polish() {
  constexpr int kRounds = 4;
  if (!balance()) return false;
  for (int round = 0; round < kRounds; ++round) {
    if (!open_angles() || !open_folds()) return false;
    if (round == 0 && !balance()) return false;
  }
  return true;
}

/// First at the scale of the input's own triangles, where the search needs small cells.
bool Adapter::coarsen_in_steps() {
  for (const double shortest : {0.3, 0.45, 0.6}) {
    fit_cells();
    if (!coarsen(shortest)) return false;
  }
  fit_cells();
  editor_.limits.gap_share = kGapShare;
  return true;
}

bool Adapter::run_adaptive() {
  if (!coarsen_in_steps()) return false;
  for (int pass = 0; pass < params_.passes; ++pass) {
    if (!step(0.3 + 0.6 * pass / params_.passes)) return false;
    if (!coarsen(kShortest) || !refine() || !flip_all() || !relocate_all() || !open_angles() ||
        !relocate_all())
      return false;
  }
  return polish();
}

/// Zilske, Lamecker and Zachow 2008: sizes first, the shapes after.
bool Adapter::run_paper() {
  editor_.set_coarsest(true);
  if (!coarsen_in_steps() || !coarsen(kShortest)) return false;
  editor_.set_coarsest(false);
  if (!step(0.4)) return false;
  constexpr int kMostLevels = 12;
  for (int level = 0; level < kMostLevels; ++level) {
    fit_cells();
    const std::uint64_t before = operations_.accepted[0];
    if (!quarter()) return false;
    if (operations_.accepted[0] == before) break;
  }
  for (int pass = 0; pass < params_.passes; ++pass) {
    if (!step(0.6 + 0.3 * pass / params_.passes)) return false;
    // Triangles that close the neighbours of those cut in four are small: the worst go.
    if (!coarsen(0.75 * kShortest) || !refine() || !flip_all() || !relocate_all() || !relocate_all())
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
  std::vector<CurveEdge> marked;
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) {
    if (!mesh.alive(t)) continue;
    const auto& [a, b, c] = mesh.triangle(t);
    if (editor_.metric_length(a, b) + editor_.metric_length(b, c) + editor_.metric_length(c, a) <= 3 * kSqrt2)
      continue;
    for (const auto& [u, w] : {CurveEdge{a, b}, CurveEdge{b, c}, CurveEdge{c, a}})
      marked.push_back({std::min(u, w), std::max(u, w)});
  }
  std::sort(marked.begin(), marked.end());
  marked.erase(std::unique(marked.begin(), marked.end()), marked.end());
  const auto old_count = static_cast<std::uint32_t>(mesh.vertex_count());
  for (const auto& [a, b] : marked) operations_.split(a, b);
  for (std::uint32_t v = old_count; v < mesh.vertex_count(); ++v)
    for (const std::uint32_t other : std::vector<std::uint32_t>(operations_.neighbours(v))) {
      if (other >= old_count || mesh.is_curve(v, other)) continue;
      std::uint32_t opposite_new = 0;
      for (const std::uint32_t t : mesh.star(v))
        if (has_corner(mesh.triangle(t), other))
          opposite_new += third_corner(mesh.triangle(t), v, other) >= old_count ? 1 : 0;
      if (opposite_new == 2) operations_.flip(v, other, Demand::kAllowed);
    }
  return !ctx_.cancelled();
}

}  // namespace

Result<SurfaceMesh> adapt_complex(const SurfaceMesh& reference, const SizingField& sizing,
                                  const AdaptParams& params, RunContext& ctx, AdaptRecord* record) {
  try {
    if (reference.triangles.empty()) return reference;
    Adapter adapter(reference, sizing, params, ctx);
    if (!adapter.run()) return cancelled_error(kStage);
    if (record) adapter.write(*record);
    return adapter.surface();
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory,
                 kStage,
                 "not enough memory to adapt " + std::to_string(reference.triangles.size()) + " triangles",
                 {}};
  }
}

}  // namespace voxtet::remesh
