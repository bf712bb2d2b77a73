#include "tetra/backends/delaunay_cells.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "base/level_stacks.h"
#include "geometry/intersect/delaunay_triangulation.h"
#include "tetra/mesh/tet_complex.h"
#include "tetra/mesh/triangle_index.h"
#include "types/stage_names.h"

namespace voxtet::tetra {
namespace {

using Eigen::Vector3d;
using Triangulation = DelaunayTriangulation;
using Cell = Triangulation::Cell_handle;
using Vertex = Triangulation::Vertex_handle;

/// Circumradius allowed per target edge length. Measured on hearts and aorta (tests/sweep/sweep_sizes): the
/// median of inner edges is within 2 % of the target. The optimised angles are the same for 3 % more or less.
constexpr double kRadiusPerEdge = 0.75;
/// Levels of the squared circumradius over what is allowed. With more levels sizes are more even, with fewer
/// it is quicker: 0.45 s for 210,000 tets with these, 0.85 s with the worst first; the 95 % quantile of
/// |log2 l/h| is 0.005 larger.
constexpr std::array<double, 3> kLevels{1, 1.25, 2};
/// A point is too close to a triangle of the surface in a ball around its circumcentre with this part of its
/// radius. Measured on hearts and aorta: between 0.65 and 0.9 the optimised angles are the same; farther out
/// they fall, farther in there are more tets, and flatter ones, for the optimiser.
constexpr double kProtected = 0.8;
constexpr std::size_t kTriesPerQuestion = 512;

/// Circumcentre and squared circumradius of a triangle.
std::pair<Vector3d, double> circumcircle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d u = b - a, v = c - a, n = u.cross(v);
  const Vector3d offset =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2 * n.squaredNorm());
  return {a + offset, offset.squaredNorm()};
}

}  // namespace

struct DelaunayCells::Impl {
  struct BadCell {
    std::uint32_t serial;
    Cell cell;
  };

  Triangulation triangulation;
  std::vector<Vertex> vertices;
  Cell hint;
  std::uint32_t next_serial = 1;
  LevelStacks<BadCell, kLevels.size()> bad{kLevels};
  std::vector<Cell> cavity, star;
  std::vector<Triangulation::Facet> rim;

  static std::uint32_t number(Cell cell, std::uint32_t corner) {
    return cell->vertex(static_cast<int>(corner))->info();
  }
  Vector3d at(Cell cell, int corner) const { return to_vector(cell->vertex(corner)->point()); }

  /// Calls visit(facet, triangle, behind) for every triangle of the surface that is a facet, as seen from its
  /// finite cells; behind: the cell lies where sides[0] stands.
  template <class Visit>
  void for_each_facet(const SurfaceMesh& surface, const Visit& visit) const {
    const TriangleIndex index(surface);
    for (const Cell c : triangulation.finite_cell_handles())
      for (int i = 0; i < 4; ++i) {
        const auto& [j, k, l] = kSideCorners[i];
        const auto [triangle, same] = index.find({number(c, j), number(c, k), number(c, l)});
        if (triangle != TriangleIndex::kNone) visit(Triangulation::Facet(c, i), triangle, same);
      }
  }

  /// Examines a new cell with a label.
  void examine(Cell cell, const SizingField& sizing, double radius_edge) {
    DelaunayCellInfo& info = cell->info();
    if (info.label == kBackground) return;
    info.centre = circumcentre(cell);
    if (!info.centre.allFinite()) return;
    const double radius2 = (info.centre - at(cell, 0)).squaredNorm();
    const double target = kRadiusPerEdge * sizing.at(info.centre);
    double shortest2 = std::numeric_limits<double>::max();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) shortest2 = std::min(shortest2, (at(cell, i) - at(cell, j)).squaredNorm());
    const double size = radius2 / (target * target);
    if (size > kLevels[0] || radius2 > radius_edge * radius_edge * shortest2)
      bad.push(size, {info.serial, cell});
  }

  /// The cells whose circumballs hold p and that are connected with `first` inside its label, and the facets
  /// around them.
  void find_cavity(Cell first, const DelaunayKernel::Point_3& p) {
    cavity.assign(1, first);
    rim.clear();
    first->tds_data().mark_in_conflict();
    for (std::size_t k = 0; k < cavity.size(); ++k)
      for (int i = 0; i < 4; ++i) {
        const Cell cell = cavity[k], next = cell->neighbor(i);
        if (next->tds_data().is_in_conflict()) continue;
        if (next->tds_data().is_clear() && next->info().label == first->info().label &&
            triangulation.side_of_sphere(next, p, true) == CGAL::ON_BOUNDED_SIDE) {
          next->tds_data().mark_in_conflict();
          cavity.push_back(next);
        } else {
          next->tds_data().mark_on_boundary();
          rim.emplace_back(cell, i);
        }
      }
    for (const auto& [cell, i] : rim) cell->neighbor(i)->tds_data().clear();
    for (const Cell cell : cavity) cell->tds_data().clear();
  }

  /// Whether p sees the whole rim of the cavity and is not too close to triangles of the surface there.
  bool may_fill_cavity(const Vector3d& p, const DelaunayKernel::Point_3& point) const {
    for (const auto& [cell, i] : rim) {
      const auto& [j, k, l] = kSideCorners[i];
      const auto corner = [c = cell](std::uint32_t n) { return c->vertex(static_cast<int>(n))->point(); };
      if (CGAL::orientation(corner(j), corner(l), corner(k), point) != CGAL::POSITIVE) return false;
      if (cell->neighbor(i)->info().label == cell->info().label) continue;
      const auto [centre, radius2] =
          circumcircle(to_vector(corner(j)), to_vector(corner(k)), to_vector(corner(l)));
      if ((p - centre).squaredNorm() < kProtected * kProtected * radius2) return false;
    }
    return true;
  }

  /// Inserts a point at the circumcentre of a cell with a label; false where it is hidden behind the surface
  /// or too close to that.
  bool insert_centre(Cell first) {
    const Label label = first->info().label;
    const Vector3d p = first->info().centre;
    const DelaunayKernel::Point_3 point = to_point(p);
    find_cavity(first, point);
    if (!may_fill_cavity(p, point)) return false;
    for (const Cell c : cavity) c->info().serial = 0;
    const Vertex vertex = triangulation.insert_in_hole(point, cavity.begin(), cavity.end(), rim.front().first,
                                                       rim.front().second);
    vertex->info() = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
    star.clear();
    triangulation.incident_cells(vertex, std::back_inserter(star));
    for (const Cell c : star) {
      c->info().label = label;
      c->info().serial = next_serial++;
    }
    return true;
  }
};

DelaunayCells::DelaunayCells() : impl_(std::make_unique<Impl>()) {}
DelaunayCells::~DelaunayCells() = default;

bool DelaunayCells::add(const Vector3d& point, std::uint32_t number) {
  Impl& m = *impl_;
  const std::size_t before = m.triangulation.number_of_vertices();
  const Vertex vertex = m.triangulation.insert(to_point(point), m.hint);
  m.hint = vertex->cell();
  if (m.triangulation.number_of_vertices() == before) return false;
  vertex->info() = number;
  if (number >= m.vertices.size()) m.vertices.resize(number + 1);
  m.vertices[number] = vertex;
  return true;
}

bool DelaunayCells::has_edge(std::uint32_t a, std::uint32_t b) const {
  Cell cell;
  int i = 0, j = 0;
  return impl_->triangulation.is_edge(impl_->vertices[a], impl_->vertices[b], cell, i, j);
}

std::vector<bool> DelaunayCells::find_facets(const SurfaceMesh& surface) const {
  std::vector<bool> found(surface.triangles.size(), false);
  impl_->for_each_facet(
      surface, [&](const Triangulation::Facet&, std::uint32_t triangle, bool) { found[triangle] = true; });
  return found;
}

bool DelaunayCells::label(const SurfaceMesh& surface) {
  Impl& m = *impl_;
  for (const Cell c : m.triangulation.all_cell_handles()) c->info().serial = m.next_serial++;
  std::vector<std::array<bool, 4>> interface(m.next_serial);
  std::vector<bool> known(m.next_serial, false);
  std::vector<Cell> reached;
  bool sound = true;
  const auto give = [&](Cell cell, Label label) {
    auto&& is_known = known[cell->info().serial];
    if (!is_known) reached.push_back(cell);
    sound = sound && (!is_known || cell->info().label == label);
    is_known = true;
    cell->info().label = label;
  };
  m.for_each_facet(surface, [&](const Triangulation::Facet& facet, std::uint32_t triangle, bool behind) {
    const Sides& sides = surface.sides[triangle];
    const Triangulation::Facet other = m.triangulation.mirror_facet(facet);
    for (const auto& [cell, i] : {facet, other})
      interface[cell->info().serial][static_cast<std::size_t>(i)] = true;
    give(facet.first, sides[behind ? 0 : 1]);
    give(other.first, sides[behind ? 1 : 0]);
  });
  while (sound && !reached.empty()) {
    const Cell cell = reached.back();
    reached.pop_back();
    for (int i = 0; i < 4; ++i)
      if (!interface[cell->info().serial][static_cast<std::size_t>(i)])
        give(cell->neighbor(i), cell->info().label);
  }
  return sound;
}

DelaunayCells::Refined DelaunayCells::refine(const SizingField& sizing, double radius_edge,
                                             std::size_t max_points, const WallLayers& layers,
                                             const RunContext& ctx) {
  Impl& m = *impl_;
  for (const Cell c : m.triangulation.finite_cell_handles())
    if (!layers.is_layer(c->info().label)) m.examine(c, sizing, radius_edge);
  const auto first_points = static_cast<double>(m.vertices.size());
  for (std::size_t k = 1;; ++k) {
    if (k % kTriesPerQuestion == 0) {
      if (ctx.cancelled()) return Refined::kCancelled;
      const auto points = static_cast<double>(m.vertices.size());
      ctx.progress(kTetraStage, (points - first_points) / (points + first_points));
    }
    if (m.vertices.size() >= max_points) return Refined::kTooMany;
    const std::optional<Impl::BadCell> bad = m.bad.pop();
    if (!bad) return Refined::kDone;
    const auto [serial, cell] = *bad;
    if (cell->info().serial != serial) continue;
    if (!m.insert_centre(cell)) continue;
    for (const Cell c : m.star) m.examine(c, sizing, radius_edge);
  }
}

FilledParts DelaunayCells::take() const {
  FilledParts parts;
  for (const Vertex v : impl_->vertices) parts.points.push_back(to_vector(v->point()));
  for (const Cell c : impl_->triangulation.finite_cell_handles()) {
    if (c->info().label == kBackground) continue;
    parts.tets.push_back(
        {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
    parts.regions.push_back(c->info().label);
  }
  return parts;
}

}  // namespace voxtet::tetra
