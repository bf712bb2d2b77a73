#include "remesh/delaunay/delaunay_refiner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/level_stacks.h"
#include "geometry/delaunay/delaunay_triangulation.h"
#include "types/stage_names.h"

namespace voxtet::remesh {
namespace {

using Eigen::Vector3d;

/// A facet whose normal is more than 75 degrees off the field's is refined, unless its ball is this small.
constexpr double kAstrayCosine = 0.25;
constexpr double kLeastAstrayVoxels = 0.35;
/// Levels of urgency, see badness(). With more levels triangles are a little larger and more even, with fewer
/// it is quicker: 52,000 triangles take 0.35 s with these, 0.5 s with the most urgent first.
constexpr std::array<double, 6> kLevels{0.5, 2, 2.1, 2.2, 2.35, 2.6};

}  // namespace

struct DelaunayRefiner::Impl {
  using Facet = DelaunayTriangulation::Facet;

  /// A facet that fails the criteria, as it was when it was examined.
  struct BadFacet {
    Facet facet;
    DelaunayTriangulation::CellId cell, other;
    Vector3d centre;  ///< of the surface Delaunay ball: where to refine
  };

  const LabelField& field;
  const SizingField& sizing;
  RefineCriteria criteria;
  double ratio_limit = 1;  ///< (circumradius / shortest edge)^2 allowed
  double jitter = 0;
  double least_astray = 0;
  std::uint64_t random = 1;

  DelaunayTriangulation triangulation;
  DelaunayTriangulation::Stock stock;
  DelaunayTriangulation::Cavity cavity;
  LevelStacks<BadFacet, kLevels.size()> bad{kLevels};
  std::vector<std::uint32_t> exported;  ///< the cells of the last cells(), in its order

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
    std::vector<std::uint32_t> corners;
    for (int corner = 0; corner < 8; ++corner) {
      Vector3d offset;
      for (int d = 0; d < 3; ++d)
        offset[d] = ((corner >> d) & 1 ? reach : -reach) * (1 + 0.01 * ((corner * 5 + d * 3) % 7));
      corners.push_back(triangulation.add_point(middle + offset));
    }
    triangulation.begin(corners);
    for (const std::uint32_t corner : corners) {
      if (triangulation.in_use(corner)) continue;
      const Vector3d p = triangulation.point(corner);
      triangulation.find_cavity(p, triangulation.locate(p, any_cell()), cavity);
      put_into_cavity(corner);
    }
    for (std::uint32_t cell = 0; cell < triangulation.slots(); ++cell)
      if (triangulation.is_cell(cell)) classify(cell);
  }

  std::uint32_t any_cell() const {
    std::uint32_t cell = 0;
    while (!triangulation.is_cell(cell)) ++cell;
    return cell;
  }

  void put_into_cavity(std::uint32_t vertex) {
    triangulation.stock_up(stock, cavity.rim.size());
    triangulation.insert(vertex, cavity, stock);
  }

  double noise() {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    return jitter * (static_cast<double>(random >> 40) / static_cast<double>(1 << 24) - 0.5);
  }

  Vector3d centroid(std::uint32_t cell) const {
    const auto& [a, b, c, d] = triangulation.corners(cell);
    return 0.25 * (triangulation.point(a) + triangulation.point(b) + triangulation.point(c) +
                   triangulation.point(d));
  }

  /// The circumcentre of a finite cell, or its centroid where it is flat.
  Vector3d centre_of(std::uint32_t cell) const {
    const Vector3d& centre = triangulation.ball(cell).centre;
    return centre.allFinite() ? centre : centroid(cell);
  }

  void classify(std::uint32_t cell) {
    if (!triangulation.is_infinite(cell)) triangulation.set_label(cell, field.at(centre_of(cell)));
  }

  /// Centre of the surface Delaunay ball of a facet, and whether its dual segment passes through a layer that
  /// it does not bound; false where the facet is on no interface.
  bool surface_centre(Facet facet, Vector3d& centre, Vector3d& normal, bool& skips) const {
    const std::uint32_t cell = DelaunayTriangulation::cell_of(facet),
                        other = DelaunayTriangulation::cell_of(triangulation.across(facet));
    const Label mine = triangulation.label(cell), its = triangulation.label(other);
    if (mine == its) return false;
    if (triangulation.is_infinite(cell) || triangulation.is_infinite(other)) return false;
    const auto [from, to] = mine > its ? std::pair{cell, other} : std::pair{other, cell};
    const Label before = std::max(mine, its), after = std::min(mine, its);
    Label behind = kBackground;
    centre = field.crossing(centre_of(from), before, centre_of(to), after, behind);
    normal = field.gradient(centre, before, behind);
    skips = behind != after && (field.layers().is_layer(behind) || field.layers().is_layer(before));
    return true;
  }

  /// Queues a facet if it lies on an interface and fails a criterion.
  void examine(Facet facet) {
    Vector3d centre, normal;
    bool skips = false;
    if (!surface_centre(facet, centre, normal, skips)) return;
    const double urgency = badness(facet, centre, normal, skips);
    if (urgency > 0) queue(urgency, facet, centre);
  }

  void queue(double urgency, Facet facet, const Vector3d& centre) {
    const std::uint32_t cell = DelaunayTriangulation::cell_of(facet),
                        other = DelaunayTriangulation::cell_of(triangulation.across(facet));
    bad.push(urgency, {facet, triangulation.id(cell), triangulation.id(other), centre});
  }

  Label label_of(Facet facet) const { return triangulation.label(DelaunayTriangulation::cell_of(facet)); }

  bool is_of_layer(Facet facet) const {
    return field.layers().is_layer(label_of(facet)) ||
           field.layers().is_layer(label_of(triangulation.across(facet)));
  }

  /// 0 for a good facet; facets that are too large come before those that are too far off or too thin.
  double badness(Facet facet, const Vector3d& centre, const Vector3d& normal, bool skips) const {
    const auto& corners = triangulation.corners(DelaunayTriangulation::cell_of(facet));
    const auto& [i, j, k] = kFacetCorners[DelaunayTriangulation::corner_of(facet)];
    const Vector3d &p = triangulation.point(corners[i]), &q = triangulation.point(corners[j]),
                   &r = triangulation.point(corners[k]);
    const double ball = (centre - p).squaredNorm();
    const double target = criteria.radius_per_edge * sizing.at(centre);
    const double relative = std::sqrt(ball) / target;
    if (relative > 1) return 1 + relative;
    const double a = (q - p).squaredNorm(), b = (r - q).squaredNorm(), c = (p - r).squaredNorm();
    const Vector3d across = (q - p).cross(r - p);
    const double circle = a * b * c / (4 * across.squaredNorm());
    const double offset = ball - circle;
    const bool coarse = is_of_layer(facet) && relative < criteria.layer_radius_share;
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

  /// Finds the cavity of a point that is to be added, a little beside `p`: which is returned, or nothing if
  /// it coincides with a vertex.
  std::optional<Vector3d> find_cavity(const Vector3d& p, std::uint32_t from) {
    // One after the other: compilers differ in the order in which they evaluate arguments.
    const double dx = noise(), dy = noise(), dz = noise();
    const Vector3d at = p + Vector3d(dx, dy, dz);
    const std::uint32_t first = triangulation.locate(at, from);
    if (triangulation.has_corner_at(first, at)) return std::nullopt;
    triangulation.find_cavity(at, first, cavity);
    return at;
  }

  /// Squared distance of a point from the nearest vertex: one of those around its cavity.
  double nearest2(const Vector3d& at) const {
    double least = std::numeric_limits<double>::max();
    for (const std::uint32_t cell : cavity.cells)
      for (const std::uint32_t v : triangulation.corners(cell))
        if (v != DelaunayTriangulation::kInfinite)
          least = std::min(least, (triangulation.point(v) - at).squaredNorm());
    return least;
  }

  /// Adds the point whose cavity was found.
  void insert(const Vector3d& at) {
    put_into_cavity(triangulation.add_point(at));
    for (const std::uint32_t cell : stock.made) classify(cell);
    for (std::size_t n = 0; n < stock.made.size(); ++n) {
      const std::uint32_t cell = stock.made[n], own = DelaunayTriangulation::corner_of(cavity.rim[n]);
      examine(4 * cell + own);
      for (std::uint32_t i = 0; i < 4; ++i)
        if (i != own && cell < triangulation.neighbour(cell, i)) examine(4 * cell + i);
    }
  }
};

DelaunayRefiner::DelaunayRefiner(const LabelField& field, const SizingField& sizing,
                                 const RefineCriteria& criteria)
    : impl_(std::make_unique<Impl>(field, sizing, criteria)) {}

DelaunayRefiner::~DelaunayRefiner() = default;

std::size_t DelaunayRefiner::insert(const std::vector<Vector3d>& points, double separation_mm,
                                    double edge_share) {
  Impl& m = *impl_;
  std::size_t added = 0;
  std::uint32_t from = m.any_cell();
  for (const Vector3d& p : points) {
    const std::optional<Vector3d> at = m.find_cavity(p, from);
    if (!at) continue;
    from = m.cavity.cells.front();
    const double least = std::max(separation_mm, edge_share * m.sizing.at(p));
    if (m.nearest2(*at) < least * least) continue;
    m.insert(*at);
    ++added;
    from = m.stock.made.front();
  }
  return added;
}

bool DelaunayRefiner::refine(RunContext& ctx, double predicted_vertices) {
  Impl& m = *impl_;
  const DelaunayTriangulation& t = m.triangulation;
  constexpr std::size_t kPollEvery = 512;
  for (std::size_t round = 0;; ++round) {
    const std::optional<Impl::BadFacet> bad = m.bad.pop();
    if (!bad) return true;
    if (round % kPollEvery == 0) {
      if (ctx.cancelled()) return false;
      ctx.progress(kRemeshStage, std::min(1.0, t.point_count() / (1 + predicted_vertices)));
    }
    if (!t.is_there(bad->cell) || !t.is_there(bad->other)) continue;
    const std::optional<Vector3d> at = m.find_cavity(bad->centre, bad->cell.slot);
    if (!at) continue;
    // It must not leave the facet standing.
    const std::vector<std::uint32_t>& cells = m.cavity.cells;
    if (std::find(cells.begin(), cells.end(), bad->cell.slot) != cells.end() ||
        std::find(cells.begin(), cells.end(), bad->other.slot) != cells.end())
      m.insert(*at);
  }
}

std::vector<Vector3d> DelaunayRefiner::passed_over(double depth_mm) const {
  const Impl& m = *impl_;
  std::vector<Vector3d> points;
  for (std::uint32_t cell = 0; cell < m.triangulation.slots(); ++cell) {
    if (!m.triangulation.is_finite(cell)) continue;
    const Vector3d middle = m.centroid(cell);
    const Label label = m.field.at(middle);
    if (label == m.triangulation.label(cell) || m.field.depth(middle, label) < depth_mm) continue;
    Label other = kBackground;
    points.push_back(m.field.crossing(middle, label, m.centre_of(cell), m.triangulation.label(cell), other));
  }
  return points;
}

std::size_t DelaunayRefiner::vertex_count() const {
  return impl_->triangulation.point_count();
}

bool DelaunayRefiner::request(std::uint32_t cell, std::uint32_t corner, double least_radius_mm) {
  Impl& m = *impl_;
  const DelaunayTriangulation::Facet facet = 4 * m.exported[cell] + corner;
  Vector3d centre, normal;
  bool skips = false;
  if (!m.surface_centre(facet, centre, normal, skips)) return false;
  const std::uint32_t end = m.triangulation.corners(m.exported[cell])[(corner + 1) % 4];
  if ((centre - m.triangulation.point(end)).norm() < least_radius_mm) return false;
  m.queue(1, facet, centre);
  return true;
}

LabelledCells DelaunayRefiner::cells() {
  Impl& m = *impl_;
  const DelaunayTriangulation& t = m.triangulation;
  LabelledCells out;
  out.points.reserve(t.point_count());
  for (std::uint32_t v = 0; v < t.point_count(); ++v) out.points.push_back(t.point(v));
  std::vector<std::uint32_t> number(t.slots(), LabelledCells::kNone);
  m.exported.clear();
  for (std::uint32_t cell = 0; cell < t.slots(); ++cell) {
    if (!t.is_finite(cell)) continue;
    number[cell] = static_cast<std::uint32_t>(m.exported.size());
    m.exported.push_back(cell);
  }
  const std::size_t count = m.exported.size();
  out.vertices.reserve(count);
  out.neighbours.reserve(count);
  out.labels.reserve(count);
  for (const std::uint32_t cell : m.exported) {
    out.vertices.push_back(t.corners(cell));
    std::array<std::uint32_t, 4>& neighbours = out.neighbours.emplace_back();
    for (std::uint32_t i = 0; i < 4; ++i) neighbours[i] = number[t.neighbour(cell, i)];
    out.labels.push_back(t.label(cell));
  }
  return out;
}

}  // namespace voxtet::remesh
