#include "tetra/delaunay_cells.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>

#include "geometry/delaunay_triangulation.h"

namespace voxtet::tetra {
namespace {

using Eigen::Vector3d;
using Triangulation = DelaunayTriangulation;
using Cell = Triangulation::Cell_handle;
using Vertex = Triangulation::Vertex_handle;

/// Circumradius allowed per wished edge length.
double kRadiusPerEdge = getenv("RPE") ? atof(getenv("RPE")) : 0.79;
/// A point in the diametral ball of a triangle of the surface, shrunk by this, is too close.
double kProtected = getenv("PROT") ? atof(getenv("PROT")) : 1;
constexpr std::size_t kPointsPerQuestion = 512;

struct BadCell {
  double urgency;
  std::uint32_t serial;
  Cell cell;
};

struct LessUrgent {
  bool operator()(const BadCell& a, const BadCell& b) const {
    return a.urgency != b.urgency ? a.urgency < b.urgency : a.serial > b.serial;
  }
};

/// Circumcentre and squared radius of a triangle.
std::pair<Vector3d, double> circumcircle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d u = b - a, v = c - a, n = u.cross(v);
  const Vector3d offset =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2 * n.squaredNorm());
  return {a + offset, offset.squaredNorm()};
}

}  // namespace

struct DelaunayCells::Impl {
  Triangulation triangulation;
  std::vector<Vertex> vertices;
  Cell hint;
  std::uint32_t next_serial = 1;
  std::priority_queue<BadCell, std::vector<BadCell>, LessUrgent> bad;
  std::vector<Cell> conflict, star;
  std::vector<Triangulation::Facet> rim;

  Vector3d at(Cell cell, int corner) const { return to_vector(cell->vertex(corner)->point()); }

  /// The facet as seen from a finite cell.
  bool find(const Triangle& t, Triangulation::Facet& facet) const {
    Cell cell;
    int i = 0, j = 0, k = 0;
    if (!triangulation.is_facet(vertices[t[0]], vertices[t[1]], vertices[t[2]], cell, i, j, k)) return false;
    facet = {cell, 6 - i - j - k};
    if (triangulation.is_infinite(cell)) facet = triangulation.mirror_facet(facet);
    return true;
  }

  /// Examines a new cell with a label.
  void examine(Cell cell, const SizingField& sizing, double radius_edge) {
    DelaunayCellInfo& info = cell->info();
    if (info.label == kBackground) return;
    info.centre = circumcentre(cell);
    if (!info.centre.allFinite()) return;
    const double radius2 = (info.centre - at(cell, 0)).squaredNorm();
    const double wished = kRadiusPerEdge * sizing.at(info.centre);
    double shortest2 = std::numeric_limits<double>::max();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) shortest2 = std::min(shortest2, (at(cell, i) - at(cell, j)).squaredNorm());
    const double size = radius2 / (wished * wished);
    const double ratio = radius2 / (radius_edge * radius_edge * shortest2);
    if (size > 1)
      bad.push({1 + size, info.serial, cell});
    else if (ratio > 1)
      bad.push({1 - 1 / ratio, info.serial, cell});
  }

  /// Whether the conflict zone, of one label, is bounded by a triangle of the surface that p is too close to.
  bool encroaches(const Vector3d& p) const {
    for (const auto& [cell, i] : rim) {
      if (cell->neighbor(i)->info().label == cell->info().label) continue;
      const auto [centre, radius2] =
          circumcircle(at(cell, (i + 1) % 4), at(cell, (i + 2) % 4), at(cell, (i + 3) % 4));
      if ((p - centre).squaredNorm() < kProtected * kProtected * radius2) return true;
    }
    return false;
  }

  /// Inserts a point near a cell with a label; false where that would not leave the surface as it is.
  bool insert_inside(const Vector3d& p, Cell near) {
    const Label label = near->info().label;
    const auto point = to_point(p);
    Triangulation::Locate_type type;
    int li = 0, lj = 0;
    const Cell start = triangulation.locate(point, type, li, lj, near);
    if (type == Triangulation::VERTEX || start->info().label != label) return false;
    conflict.clear();
    rim.clear();
    triangulation.find_conflicts(point, start, std::back_inserter(rim), std::back_inserter(conflict));
    for (const Cell c : conflict)
      if (c->info().label != label) return false;
    if (encroaches(p)) return false;
    for (const Cell c : conflict) c->info().serial = 0;
    const Vertex vertex = triangulation.insert_in_hole(point, conflict.begin(), conflict.end(),
                                                       rim.front().first, rim.front().second);
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

bool DelaunayCells::add(const Vector3d& point) {
  Impl& m = *impl_;
  const std::size_t before = m.triangulation.number_of_vertices();
  const Vertex vertex = m.triangulation.insert(to_point(point), m.hint);
  m.hint = vertex->cell();
  if (m.triangulation.number_of_vertices() == before) return false;
  vertex->info() = static_cast<std::uint32_t>(m.vertices.size());
  m.vertices.push_back(vertex);
  return true;
}

std::uint32_t DelaunayCells::size() const {
  return static_cast<std::uint32_t>(impl_->vertices.size());
}

bool DelaunayCells::has_edge(std::uint32_t a, std::uint32_t b) const {
  Cell cell;
  int i = 0, j = 0;
  return impl_->triangulation.is_edge(impl_->vertices[a], impl_->vertices[b], cell, i, j);
}

bool DelaunayCells::has_triangle(const Triangle& triangle) const {
  Triangulation::Facet facet;
  return impl_->find(triangle, facet);
}

bool DelaunayCells::label(const SurfaceMesh& surface) {
  Impl& m = *impl_;
  for (const Cell c : m.triangulation.all_cell_handles()) c->info().serial = m.next_serial++;
  std::vector<std::array<bool, 4>> wall(m.next_serial);
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
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    Triangulation::Facet facet;
    if (!m.find(triangle, facet)) return false;
    const Triangulation::Facet other = m.triangulation.mirror_facet(facet);
    const bool in_front =
        CGAL::orientation(m.vertices[triangle[0]]->point(), m.vertices[triangle[1]]->point(),
                          m.vertices[triangle[2]]->point(),
                          facet.first->vertex(facet.second)->point()) == CGAL::POSITIVE;
    for (const auto& [cell, i] : {facet, other})
      wall[cell->info().serial][static_cast<std::size_t>(i)] = true;
    give(facet.first, surface.sides[t][in_front ? 1 : 0]);
    give(other.first, surface.sides[t][in_front ? 0 : 1]);
  }
  while (sound && !reached.empty()) {
    const Cell cell = reached.back();
    reached.pop_back();
    for (int i = 0; i < 4; ++i)
      if (!wall[cell->info().serial][static_cast<std::size_t>(i)])
        give(cell->neighbor(i), cell->info().label);
  }
  return sound;
}

DelaunayCells::Refined DelaunayCells::refine(const SizingField& sizing, double radius_edge,
                                             std::size_t max_points, const RunContext& ctx) {
  Impl& m = *impl_;
  for (const Cell c : m.triangulation.finite_cell_handles()) m.examine(c, sizing, radius_edge);
  for (std::size_t k = 1; !m.bad.empty(); ++k) {
    if (k % kPointsPerQuestion == 0 && ctx.cancelled()) return Refined::kCancelled;
    if (m.vertices.size() >= max_points) return Refined::kTooMany;
    const BadCell worst = m.bad.top();
    m.bad.pop();
    if (worst.cell->info().serial != worst.serial) continue;
    if (!m.insert_inside(worst.cell->info().centre, worst.cell)) continue;
    for (const Cell c : m.star) m.examine(c, sizing, radius_edge);
  }
  return Refined::kDone;
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
