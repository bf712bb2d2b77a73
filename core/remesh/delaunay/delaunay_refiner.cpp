#include "remesh/delaunay/delaunay_refiner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/level_stacks.h"
#include "geometry/intersect/delaunay_triangulation.h"
#include "types/stage_names.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

using CellInfo = DelaunayCellInfo;
using Triangulation = DelaunayTriangulation;
using Point = DelaunayKernel::Point_3;
using Cell = Triangulation::Cell_handle;

/// A facet whose normal is more than 75 degrees off the field's is refined, unless its ball is this small.
constexpr double kAstrayCosine = 0.25;
constexpr double kLeastAstrayVoxels = 0.35;
/// Levels of urgency, see badness(). With more levels triangles are a little larger and more even, with fewer
/// it is quicker: 52,000 triangles take 0.35 s with these, 0.5 s with the most urgent first.
constexpr std::array<double, 6> kLevels{0.5, 2, 2.1, 2.2, 2.35, 2.6};

Vector3d centroid(Cell cell) {
  return 0.25 * (to_vector(cell->vertex(0)->point()) + to_vector(cell->vertex(1)->point()) +
                 to_vector(cell->vertex(2)->point()) + to_vector(cell->vertex(3)->point()));
}

}  // namespace

struct DelaunayRefiner::Impl {
  /// A facet that fails the criteria, as it was when it was examined.
  struct BadFacet {
    std::uint32_t serial, other_serial;
    Cell cell;
    int facet;
    Vector3d centre;  ///< of the surface Delaunay ball: where to refine
  };

  const LabelField& field;
  const SizingField& sizing;
  RefineCriteria criteria;
  double ratio_limit = 1;  ///< (circumradius / shortest edge)^2 allowed
  double jitter = 0;
  double least_astray = 0;
  std::uint64_t random = 1;

  Triangulation triangulation;
  std::uint32_t next_vertex = 0, next_serial = 1;
  LevelStacks<BadFacet, kLevels.size()> bad{kLevels};
  std::vector<Cell> conflict, star;
  std::vector<Triangulation::Facet> rim;
  std::vector<Cell> exported;  ///< the cells of the last cells(), in its order

  Impl(const LabelField& f, const SizingField& s, const RefineCriteria& c)
      : field(f), sizing(s), criteria(c) {
    const double sine = std::sin(c.facet_angle_deg * (EIGEN_PI / 180));
    // Rounded, because libms differ in the last digit.
    ratio_limit = std::round(1e9 / (4 * sine * sine)) / 1e9;
    jitter = 1e-5 * field.grid().smallest_spacing_mm();
    least_astray = kLeastAstrayVoxels * field.grid().smallest_spacing_mm();
    enclose();
  }

  /// Eight far points, so that every cell near the labels is finite.
  void enclose() {
    const Eigen::AlignedBox3d box = field.box();
    const Vector3d middle = 0.5 * (box.min() + box.max());
    const double reach = 3 * (box.max() - box.min()).norm();
    for (int corner = 0; corner < 8; ++corner) {
      Vector3d offset;
      for (int d = 0; d < 3; ++d)
        offset[d] = ((corner >> d) & 1 ? reach : -reach) * (1 + 0.01 * ((corner * 5 + d * 3) % 7));
      const Vector3d p = middle + offset;
      triangulation.insert(Point(p.x(), p.y(), p.z()))->info() = next_vertex++;
    }
    for (Cell cell : triangulation.all_cell_handles()) classify(cell);
  }

  double noise() {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    return jitter * (static_cast<double>(random >> 40) / static_cast<double>(1 << 24) - 0.5);
  }

  void classify(Cell cell) {
    CellInfo& info = cell->info();
    info.serial = next_serial++;
    info.label = kBackground;
    if (triangulation.is_infinite(cell)) return;
    info.centre = circumcentre(cell);
    if (!info.centre.allFinite()) info.centre = centroid(cell);
    info.label = field.at(info.centre);
  }

  /// Centre of the surface Delaunay ball of the facet opposite corner i, and whether its dual segment passes
  /// through a layer that it does not bound; false where the facet is on no interface.
  bool surface_centre(Cell cell, int i, Vector3d& centre, Vector3d& normal, bool& skips) const {
    const Cell other = cell->neighbor(i);
    const CellInfo& mine = cell->info();
    const CellInfo& theirs = other->info();
    if (mine.label == theirs.label) return false;
    if (triangulation.is_infinite(cell) || triangulation.is_infinite(other)) return false;
    const bool forward = mine.label > theirs.label;
    const CellInfo& from = forward ? mine : theirs;
    const CellInfo& to = forward ? theirs : mine;
    Label behind = kBackground;
    centre = field.crossing(from.centre, from.label, to.centre, to.label, behind);
    normal = field.gradient(centre, from.label, behind);
    skips = behind != to.label && (field.layers().is_layer(behind) || field.layers().is_layer(from.label));
    return true;
  }

  /// Queues the facet opposite corner i of the cell if it lies on an interface and fails a criterion.
  void examine(Cell cell, int i) {
    Vector3d centre, normal;
    bool skips = false;
    if (!surface_centre(cell, i, centre, normal, skips)) return;
    const double urgency = badness(cell, i, centre, normal, skips);
    if (urgency > 0) queue(urgency, cell, i, centre);
  }

  void queue(double urgency, Cell cell, int i, const Vector3d& centre) {
    bad.push(urgency, {cell->info().serial, cell->neighbor(i)->info().serial, cell, i, centre});
  }

  bool is_of_layer(Cell cell, int i) const {
    return field.layers().is_layer(cell->info().label) ||
           field.layers().is_layer(cell->neighbor(i)->info().label);
  }

  /// 0 for a good facet; facets that are too large come before those that are too far off or too thin.
  double badness(Cell cell, int i, const Vector3d& centre, const Vector3d& normal, bool skips) const {
    const auto& corners = kFacetCorners[static_cast<std::size_t>(i)];
    const Vector3d p = to_vector(cell->vertex(corners[0])->point());
    const Vector3d q = to_vector(cell->vertex(corners[1])->point());
    const Vector3d r = to_vector(cell->vertex(corners[2])->point());
    const double ball = (centre - p).squaredNorm();
    const double target = criteria.radius_per_edge * sizing.at(centre);
    const double relative = std::sqrt(ball) / target;
    if (relative > 1) return 1 + relative;
    const double a = (q - p).squaredNorm(), b = (r - q).squaredNorm(), c = (p - r).squaredNorm();
    const Vector3d across = (q - p).cross(r - p);
    const double circle = a * b * c / (4 * across.squaredNorm());
    const double offset = ball - circle;
    const bool coarse = is_of_layer(cell, i) && relative < criteria.layer_radius_share;
    const double allowed = (coarse ? criteria.layer_distance : 1) * criteria.max_distance_mm;
    const bool far = offset > allowed * allowed;
    const bool thin = !(circle <= ratio_limit * std::min({a, b, c}));
    // A facet across the surface spans a wall or a hole that is narrower than itself.
    const double along = across.dot(normal);
    const bool astray = ball > least_astray * least_astray &&
                        (skips || along * along < kAstrayCosine * kAstrayCosine * across.squaredNorm() *
                                                      normal.squaredNorm());
    return far || thin || astray ? relative : 0;
  }

  /// Inserts a point; false if it coincides with a vertex or would leave the facet (cell, other) standing.
  bool insert_point(const Vector3d& p, Cell hint, Cell other) {
    // One after the other: compilers differ in the order in which they evaluate arguments.
    const double dx = noise(), dy = noise(), dz = noise();
    const Point point(p.x() + dx, p.y() + dy, p.z() + dz);
    Triangulation::Locate_type type;
    int li = 0, lj = 0;
    const Cell start = triangulation.locate(point, type, li, lj, hint);
    if (type == Triangulation::VERTEX) return false;
    conflict.clear();
    rim.clear();
    triangulation.find_conflicts(point, start, std::back_inserter(rim), std::back_inserter(conflict));
    if (other != Cell()) {
      bool hit = false;
      for (const Cell c : conflict) hit = hit || c == hint || c == other;
      if (!hit) return false;
    }
    for (const Cell c : conflict) c->info().serial = 0;
    const auto vertex = triangulation.insert_in_hole(point, conflict.begin(), conflict.end(),
                                                     rim.front().first, rim.front().second);
    vertex->info() = next_vertex++;
    star.clear();
    triangulation.incident_cells(vertex, std::back_inserter(star));
    for (const Cell c : star) classify(c);
    for (const Cell c : star) {
      const int own = c->index(vertex);
      examine(c, own);
      for (int i = 0; i < 4; ++i)
        if (i != own && c->info().serial < c->neighbor(i)->info().serial) examine(c, i);
    }
    return true;
  }
};

DelaunayRefiner::DelaunayRefiner(const LabelField& field, const SizingField& sizing,
                                 const RefineCriteria& criteria)
    : impl_(std::make_unique<Impl>(field, sizing, criteria)) {}

DelaunayRefiner::~DelaunayRefiner() = default;

std::size_t DelaunayRefiner::insert(const std::vector<Vector3d>& points, double separation_mm,
                                    double edge_share) {
  Triangulation& t = impl_->triangulation;
  std::size_t added = 0;
  Cell hint = t.finite_cells_begin();
  for (const Vector3d& p : points) {
    const auto nearest = t.nearest_vertex(Point(p.x(), p.y(), p.z()), hint);
    hint = nearest->cell();
    const double least = std::max(separation_mm, edge_share * impl_->sizing.at(p));
    if ((to_vector(nearest->point()) - p).squaredNorm() < least * least) continue;
    if (!impl_->insert_point(p, hint, Cell())) continue;
    ++added;
    hint = impl_->star.front();
  }
  return added;
}

bool DelaunayRefiner::refine(RunContext& ctx, double predicted_vertices) {
  Impl& m = *impl_;
  constexpr std::size_t kPollEvery = 512;
  for (std::size_t round = 0;; ++round) {
    const std::optional<Impl::BadFacet> facet = m.bad.pop();
    if (!facet) return true;
    if (round % kPollEvery == 0) {
      if (ctx.cancelled()) return false;
      ctx.progress(kRemeshStage, std::min(1.0, m.next_vertex / (1 + predicted_vertices)));
    }
    if (facet->cell->info().serial != facet->serial) continue;
    const Cell other = facet->cell->neighbor(facet->facet);
    if (other->info().serial != facet->other_serial) continue;
    m.insert_point(facet->centre, facet->cell, other);
  }
}

std::vector<Vector3d> DelaunayRefiner::passed_over(double depth_mm) const {
  const LabelField& field = impl_->field;
  std::vector<Vector3d> points;
  for (Cell c : impl_->triangulation.finite_cell_handles()) {
    const Vector3d middle = centroid(c);
    const Label label = field.at(middle);
    if (label == c->info().label || field.depth(middle, label) < depth_mm) continue;
    Label other = kBackground;
    points.push_back(field.crossing(middle, label, c->info().centre, c->info().label, other));
  }
  return points;
}

std::size_t DelaunayRefiner::vertex_count() const {
  return impl_->next_vertex;
}

bool DelaunayRefiner::request(std::uint32_t cell, std::uint32_t corner, double least_radius_mm) {
  const Cell handle = impl_->exported[cell];
  const int i = static_cast<int>(corner);
  Vector3d centre, normal;
  bool skips = false;
  if (!impl_->surface_centre(handle, i, centre, normal, skips)) return false;
  const double radius = (centre - to_vector(handle->vertex((i + 1) % 4)->point())).norm();
  if (radius < least_radius_mm) return false;
  impl_->queue(1, handle, i, centre);
  return true;
}

LabelledCells DelaunayRefiner::cells() {
  Impl& m = *impl_;
  const Triangulation& t = m.triangulation;
  LabelledCells out;
  out.points.resize(m.next_vertex);
  for (auto v : t.finite_vertex_handles()) out.points[v->info()] = to_vector(v->point());
  // Cells are numbered in the triangulation's own order, which does not depend on addresses. Nothing waits
  // that would know them by their old serials, which have gaps: they get new ones, the finite cells first.
  m.next_serial = 1;
  m.exported.clear();
  for (Cell c : t.finite_cell_handles()) {
    c->info().serial = m.next_serial++;
    m.exported.push_back(c);
  }
  for (Cell c : t.all_cell_handles())
    if (t.is_infinite(c)) c->info().serial = m.next_serial++;
  const std::size_t count = m.exported.size();
  const auto number = [&](Cell c) {
    const std::uint32_t serial = c->info().serial;
    return serial <= count ? serial - 1 : LabelledCells::kNone;
  };
  out.vertices.reserve(count);
  out.neighbours.reserve(count);
  out.labels.reserve(count);
  for (Cell c : m.exported) {
    std::array<std::uint32_t, 4> vertices{}, neighbours{};
    for (int i = 0; i < 4; ++i) {
      vertices[static_cast<std::size_t>(i)] = c->vertex(i)->info();
      neighbours[static_cast<std::size_t>(i)] = number(c->neighbor(i));
    }
    out.vertices.push_back(vertices);
    out.neighbours.push_back(neighbours);
    out.labels.push_back(c->info().label);
  }
  return out;
}

}  // namespace voxtet::remesh
