#include "remesh/adapt/local_operations.h"

#include <algorithm>
#include <cmath>

namespace voxtet::remesh {
namespace {

/// Triangles around a collapsed vertex; more would be slow to check.
constexpr std::size_t kLargestStar = 48;
constexpr double kLeastMove = 0.01;        ///< in target edge lengths; a shorter way is not worth its checks
constexpr double kRelocation = 0.8;        ///< share of the way to the target
constexpr double kFlipTurnCosine = 0.866;  ///< the two triangles of a flip are within 30 degrees

}  // namespace

const std::vector<std::uint32_t>& LocalOperations::neighbours(std::uint32_t v) {
  const ComplexMesh& mesh = editor_.mesh();
  marks_.resize(mesh.vertex_count(), 0);
  round_ += 2;  // the odd ones tell counted neighbours in link_allows
  around_.clear();
  for (const std::uint32_t t : mesh.star(v))
    for (const std::uint32_t other : mesh.triangle(t))
      if (other != v && mark(other)) around_.push_back(other);
  return around_;
}

/// Dey et al. 1999: the links of a and b meet in the link of ab and nowhere else, in the complex and in its
/// curves, where the curves' cone counts as one more vertex of the complex.
bool LocalOperations::link_allows(std::uint32_t a, std::uint32_t b) {
  const ComplexMesh& mesh = editor_.mesh();
  if (mesh.stratum(a) > mesh.stratum(b) || mesh.stratum(a) == Stratum::kCorner) return false;
  const bool curve = mesh.stratum(a) == Stratum::kCurve;
  const std::uint32_t degree = mesh.edge_degree(a, b);
  if (curve && degree == 2) return false;
  if (!curve && degree != 2) return false;
  neighbours(a);
  std::uint32_t common = 0;
  for (const std::uint32_t t : mesh.star(b))
    for (const std::uint32_t v : mesh.triangle(t)) {
      if (v == b || v == a || marks_[v] != round_) continue;
      marks_[v] = round_ - 1;  // counted
      ++common;
      if (curve && mesh.is_curve(a, v) && mesh.is_curve(b, v)) return false;
    }
  return common == degree && link_edges_apart(a, b);
}

/// No triangle of a and triangle of b lie over the same edge.
bool LocalOperations::link_edges_apart(std::uint32_t a, std::uint32_t b) const {
  const ComplexMesh& mesh = editor_.mesh();
  for (const std::uint32_t t : mesh.star(b)) {
    if (has_corner(mesh.triangle(t), a)) continue;
    std::array<std::uint32_t, 2> rim{kNone, kNone};
    int met = 0;
    for (const std::uint32_t v : mesh.triangle(t))
      if (v != b && marks_[v] == round_ - 1) rim[static_cast<std::size_t>(met++)] = v;
    if (met < 2) continue;
    for (const std::uint32_t s : mesh.star(a))
      if (has_corner(mesh.triangle(s), rim[0]) && has_corner(mesh.triangle(s), rim[1])) return false;
  }
  return true;
}

std::uint32_t LocalOperations::other_curve_end(std::uint32_t v, std::uint32_t not_this) const {
  const ComplexMesh& mesh = editor_.mesh();
  for (const std::uint32_t t : mesh.star(v))
    for (const std::uint32_t other : mesh.triangle(t))
      if (other != v && other != not_this && mesh.is_curve(v, other)) return other;
  return kNone;
}

bool LocalOperations::collapse(std::uint32_t a, std::uint32_t b, double longest, Demand demand) {
  const ComplexMesh& mesh = editor_.mesh();
  if (!link_allows(a, b) || mesh.star(a).size() > kLargestStar) return editor_.refuse(Refusal::kLink);
  return merge(a, b, longest, demand) || collapse_onto(a, b, longest, demand);
}

bool LocalOperations::collapse_onto(std::uint32_t a, std::uint32_t b, double longest, Demand demand) {
  for (const std::uint32_t v : neighbours(a)) {
    if (v == b) continue;
    const double length = editor_.metric_length(b, v);
    if (length > longest && length > editor_.metric_length(a, v)) return editor_.refuse(Refusal::kLength);
  }
  describe_collapse(a, b);
  if (!editor_.attempt(edit_, demand)) return false;
  ++accepted[1];
  return true;
}

/// Both ends to the middle, where nothing holds b more than a.
bool LocalOperations::merge(std::uint32_t a, std::uint32_t b, double longest, Demand demand) {
  const ComplexMesh& mesh = editor_.mesh();
  const Stratum stratum = mesh.stratum(a);
  if (stratum != mesh.stratum(b) || stratum == Stratum::kCorner) return false;
  std::uint32_t hint = editor_.hint(b);
  if (hint == kNone) return false;
  const Eigen::Vector3d middle = 0.5 * (mesh.point(a) + mesh.point(b));
  const Eigen::Vector3d on = stratum == Stratum::kCurve
                                 ? editor_.reference().walk_curve(middle, hint)
                                 : editor_.reference().walk(middle, mesh.pair(mesh.star(b).front()), hint);
  for (const std::uint32_t end : {a, b})
    for (const std::uint32_t v : neighbours(end)) {
      if (v == a || v == b) continue;
      const double length = (on - mesh.point(v)).norm() * 0.5 * (1 / editor_.size(b) + 1 / editor_.size(v));
      if (length > longest && length > editor_.metric_length(end, v)) return false;
    }
  describe_collapse(a, b);
  const std::size_t both = edit_.removed.size() - edit_.added.size();
  std::vector<std::uint32_t> shared(edit_.removed.end() - static_cast<std::ptrdiff_t>(both),
                                    edit_.removed.end());
  edit_.removed.resize(edit_.added.size());
  for (const std::uint32_t t : mesh.star(b))
    if (!has_corner(mesh.triangle(t), a)) {
      edit_.removed.push_back(t);
      edit_.added.push_back({mesh.triangle(t), mesh.pair(t)});
    }
  edit_.removed.insert(edit_.removed.end(), shared.begin(), shared.end());
  if (stratum == Stratum::kCurve) {
    const std::uint32_t q = other_curve_end(b, a);
    edit_.curves_removed.push_back({b, q});
    edit_.curves_added.push_back({b, q});
  }
  // Many triangles change at once: none of them shall excuse another's angles.
  if (demand == Demand::kAllowed)
    for (const std::uint32_t t : edit_.removed)
      if (sharpest_cosine(mesh.corners(mesh.triangle(t))) > editor_.limits.angle_cosine)
        return editor_.refuse(Refusal::kAngle);
  edit_.moved = b;
  edit_.position = on;
  if (!editor_.attempt(edit_, demand, hint)) return false;
  ++accepted[1];
  return true;
}

void LocalOperations::describe_collapse(std::uint32_t a, std::uint32_t b) {
  const ComplexMesh& mesh = editor_.mesh();
  edit_.clear();
  for (const std::uint32_t t : mesh.star(a)) {
    Facet facet{mesh.triangle(t), mesh.pair(t)};
    if (has_corner(facet.corners, b)) continue;
    std::replace(facet.corners.begin(), facet.corners.end(), a, b);
    edit_.removed.push_back(t);
    edit_.added.push_back(facet);
  }
  for (const std::uint32_t t : mesh.star(a))
    if (has_corner(mesh.triangle(t), b)) edit_.removed.push_back(t);
  if (mesh.stratum(a) == Stratum::kCurve) {
    const std::uint32_t p = other_curve_end(a, b);
    edit_.curves_removed = {{p, a}, {a, b}};
    edit_.curves_added = {{p, b}};
  }
}

bool LocalOperations::split(std::uint32_t a, std::uint32_t b, Demand demand) {
  const ComplexMesh& mesh = editor_.mesh();
  const bool curve = mesh.is_curve(a, b);
  const Eigen::Vector3d middle = 0.5 * (mesh.point(a) + mesh.point(b));
  const std::uint32_t from = mesh.stratum(a) <= mesh.stratum(b) ? a : b;
  std::uint32_t hint = editor_.hint(from);
  if (curve && mesh.stratum(from) == Stratum::kCorner)
    editor_.samples().for_curve_samples(a, b, [&](std::uint32_t s) { hint = s; });
  Eigen::Vector3d on = middle;
  if (hint != kNone && curve) {
    on = editor_.reference().walk_curve(middle, hint);
  } else if (hint != kNone) {
    for (const std::uint32_t t : mesh.star(a)) {
      if (!has_corner(mesh.triangle(t), b)) continue;
      on = editor_.reference().walk(middle, mesh.pair(t), hint);
      break;
    }
  }
  return split_at(a, b, on, hint, curve, demand) || split_at(a, b, middle, hint, curve, demand);
}

bool LocalOperations::split_at(std::uint32_t a, std::uint32_t b, const Eigen::Vector3d& p, std::uint32_t hint,
                               bool curve, Demand demand) {
  const ComplexMesh& mesh = editor_.mesh();
  const std::uint32_t middle = editor_.add_vertex(p, curve ? Stratum::kCurve : Stratum::kSurface, hint);
  edit_.clear();
  edit_.moved = middle;
  edit_.position = p;
  for (const std::uint32_t end : {b, a})
    for (const std::uint32_t t : mesh.star(a)) {
      Facet facet{mesh.triangle(t), mesh.pair(t)};
      if (!has_corner(facet.corners, b)) continue;
      std::replace(facet.corners.begin(), facet.corners.end(), end, middle);
      if (end == b) edit_.removed.push_back(t);
      edit_.added.push_back(facet);
    }
  if (curve) {
    edit_.curves_removed = {{a, b}};
    edit_.curves_added = {{a, middle}, {middle, b}};
  }
  if (!editor_.attempt(edit_, demand, hint)) {
    editor_.drop_last_vertex();
    return false;
  }
  ++accepted[0];
  return true;
}

int LocalOperations::valence_gain(std::uint32_t a, std::uint32_t b) const {
  const ComplexMesh& mesh = editor_.mesh();
  const auto edit = [&](std::uint32_t v, int step) {
    if (mesh.stratum(v) != Stratum::kSurface) return 0;
    const int defect = static_cast<int>(mesh.star(v).size()) - 6;
    return defect * defect - (defect + step) * (defect + step);
  };
  int gain = edit(a, -1) + edit(b, -1);
  for (const std::uint32_t t : mesh.star(a))
    if (has_corner(mesh.triangle(t), b)) gain += edit(third_corner(mesh.triangle(t), a, b), 1);
  return gain;
}

bool LocalOperations::flip(std::uint32_t a, std::uint32_t b, Demand demand) {
  const ComplexMesh& mesh = editor_.mesh();
  std::uint32_t first = kNone, second = kNone;
  int degree = 0;
  for (const std::uint32_t t : mesh.star(a))
    if (has_corner(mesh.triangle(t), b)) {
      (degree == 0 ? first : second) = t;
      ++degree;
    }
  if (degree != 2) return false;
  const double turn = editor_.normal(first).dot(editor_.normal(second));
  if (demand == Demand::kAllowed && turn < kFlipTurnCosine) return false;
  // In the first triangle a comes before b.
  const Triangle& corners = mesh.triangle(first);
  for (std::size_t i = 0; i < 3; ++i)
    if (corners[i] == b && corners[(i + 1) % 3] == a) std::swap(first, second);
  const std::uint32_t c = third_corner(mesh.triangle(first), a, b);
  const std::uint32_t d = third_corner(mesh.triangle(second), a, b);
  if (mesh.star(a).size() <= 3 || mesh.star(b).size() <= 3 || mesh.edge_degree(c, d) != 0)
    return editor_.refuse(Refusal::kLink);
  edit_.clear();
  edit_.removed = {first, second};
  edit_.added = {{{c, a, d}, mesh.pair(first)}, {{d, b, c}, mesh.pair(first)}};
  if (!editor_.attempt(edit_, demand)) return false;
  ++accepted[2];
  return true;
}

void LocalOperations::plan_relocation(std::uint32_t v, EditCheck& check, PlannedEdit& plan) const {
  plan.any = plan_move(v, Demand::kAllowed, kRelocation, plan.edit, plan.hint);
  if (plan.any) {
    check.check(plan.edit, Demand::kAllowed, plan.found);
  } else {
    const ComplexMesh& mesh = editor_.mesh();
    plan.found.zone = box_of(mesh.corners(mesh.triangle(mesh.star(v).front())));
    for (const std::uint32_t t : mesh.star(v)) plan.found.zone.extend(box_of(mesh.corners(mesh.triangle(t))));
  }
}

bool LocalOperations::relocate(std::uint32_t v, const PlannedEdit* plan) {
  if (plan == nullptr) return move(v, Demand::kAllowed, kRelocation);
  if (!plan->any || !editor_.attempt(plan->edit, plan->found, plan->hint)) return false;
  ++accepted[3];
  return true;
}

bool LocalOperations::open(std::uint32_t v, Demand demand) {
  for (const double step : {0.8, 0.35, 0.15})
    if (move(v, demand, step)) return true;
  return false;
}

bool LocalOperations::move(std::uint32_t v, Demand demand, double step) {
  std::uint32_t hint = kNone;
  return plan_move(v, demand, step, edit_, hint) && attempt_move(demand, hint);
}

/// Describes a move of v by a share of the way to its target. False if it stays where it is.
bool LocalOperations::plan_move(std::uint32_t v, Demand demand, double step, Edit& edit,
                                std::uint32_t& hint) const {
  const ComplexMesh& mesh = editor_.mesh();
  hint = editor_.hint(v);
  if (mesh.stratum(v) == Stratum::kCorner || hint == kNone) return false;
  Eigen::Vector3d to;
  if (mesh.stratum(v) == Stratum::kCurve) {
    const std::uint32_t p = other_curve_end(v, kNone), q = other_curve_end(v, p);
    to = curve_target(v, p, q, step, hint);
  } else {
    to = surface_target(v, demand, step, hint);
  }
  const double least = kLeastMove * editor_.size(v);
  if ((to - mesh.point(v)).squaredNorm() < least * least) return false;
  describe_move(v, to, edit);
  return true;
}

bool LocalOperations::shift(std::uint32_t v, const Eigen::Vector3d& by, Demand demand) {
  if (editor_.mesh().stratum(v) == Stratum::kCorner) return false;
  describe_move(v, editor_.mesh().point(v) + by, edit_);
  return attempt_move(demand, editor_.hint(v));
}

void LocalOperations::describe_move(std::uint32_t v, const Eigen::Vector3d& to, Edit& edit) const {
  const ComplexMesh& mesh = editor_.mesh();
  edit.clear();
  edit.moved = v;
  edit.position = to;
  if (mesh.stratum(v) == Stratum::kCurve) {
    const std::uint32_t p = other_curve_end(v, kNone), q = other_curve_end(v, p);
    edit.curves_removed = edit.curves_added = {{p, v}, {v, q}};
  }
  for (const std::uint32_t t : mesh.star(v)) {
    edit.removed.push_back(t);
    edit.added.push_back({mesh.triangle(t), mesh.pair(t)});
  }
}

bool LocalOperations::attempt_move(Demand demand, std::uint32_t hint) {
  if (!editor_.attempt(edit_, demand, hint)) return false;
  ++accepted[3];
  return true;
}

}  // namespace voxtet::remesh
