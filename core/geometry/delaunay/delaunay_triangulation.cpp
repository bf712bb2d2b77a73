#include "geometry/delaunay/delaunay_triangulation.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/elements/orientation.h"

namespace voxtet {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// In cells that give way, marks a facet of the rim: the rest is the facet of the new cell that has it.
constexpr std::uint32_t kReplaced = 0x80000000U;
/// Of a circumcentre, relative to what its error grows with: rounding of some 20 operations, with some room.
constexpr double kCentreRounding = 2e-14;

/// Whether e lies inside of the sphere through the corners of a positive tetrahedron.
bool is_in_sphere(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
                  const Vector3d& e) {
  const auto to_point = [](const Vector3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  return CGAL::side_of_oriented_sphere(to_point(a), to_point(b), to_point(c), to_point(d), to_point(e)) ==
         CGAL::ON_POSITIVE_SIDE;
}

/// With corners u = b - a and so on the centre is a + n / (2 d). The error of d grows with the product of the
/// lengths, that of n with the same times their sum.
DelaunayTriangulation::Ball ball_of(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                    const Vector3d& d) {
  const Vector3d u = b - a, v = c - a, w = d - a, vw = v.cross(w);
  const double u2 = u.squaredNorm(), v2 = v.squaredNorm(), w2 = w.squaredNorm(), det = u.dot(vw);
  const Vector3d sum = u2 * vw + v2 * w.cross(u) + w2 * u.cross(v);
  DelaunayTriangulation::Ball ball{a + sum / (2 * det), 0, std::numeric_limits<double>::infinity()};
  ball.radius2 = (a - ball.centre).squaredNorm();
  const double lu = std::sqrt(u2), lv = std::sqrt(v2), lw = std::sqrt(w2), size = lu * lv * lw,
               depth = std::abs(det);
  if (!(depth > 4 * kCentreRounding * size)) return ball;
  const double radius = std::sqrt(ball.radius2);
  const double error = kCentreRounding * (size / depth * (lu + lv + lw + radius) +
                                          ball.centre.cwiseAbs().maxCoeff() + a.cwiseAbs().maxCoeff());
  ball.slack2 = 8 * error * error;
  return ball;
}

}  // namespace

bool DelaunayTriangulation::begin(std::span<const std::uint32_t> vertices) {
  if (vertices.empty()) return false;
  std::array<std::uint32_t, 4> first{vertices[0], kNone, kNone, kNone};
  const auto at = [&](std::size_t i) -> const Vector3d& { return points_[first[i]]; };
  for (const std::uint32_t v : vertices) {
    const Vector3d& p = points_[v];
    if (first[1] == kNone) {
      if (p != at(0)) first[1] = v;
    } else if (first[2] == kNone) {
      const bool in_line = orientation_along(0, at(0), at(1), p) == 0 &&
                           orientation_along(1, at(0), at(1), p) == 0 &&
                           orientation_along(2, at(0), at(1), p) == 0;
      if (!in_line) first[2] = v;
    } else if (const int side = orientation(at(0), at(1), at(2), p); side != 0) {
      first[3] = v;
      if (side < 0) std::swap(first[0], first[1]);
      break;
    }
  }
  if (first[3] == kNone) return false;
  Stock stock;
  stock_up(stock, 5);
  const std::uint32_t cell = stock.slots[4];
  fill(cell, first);
  const std::span<const std::uint32_t> behind = std::span(stock.slots).first(4);
  for (std::uint32_t i = 0; i < 4; ++i) {
    std::array<std::uint32_t, 4> corners = first;
    corners[i] = kInfinite;
    std::swap(corners[(i + 1) % 4], corners[(i + 2) % 4]);
    fill(behind[i], corners);
    link(4 * cell + i, 4 * behind[i] + i);
  }
  // Two infinite cells share the edge that neither facet's corner is on.
  for (std::uint32_t i = 0; i < 4; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      link(4 * behind[i] + corner_at(behind[i], first[j]), 4 * behind[j] + corner_at(behind[j], first[i]));
  return true;
}

void DelaunayTriangulation::stock_up(Stock& stock, std::size_t count) {
  while (stock.slots.size() < count) {
    if (empty_.empty()) {
      empty_.push_back(slots());
      cells_.emplace_back();
      balls_.emplace_back();
      labels_.push_back(kBackground);
      versions_.emplace_back();
    }
    stock.slots.push_back(empty_.back());
    empty_.pop_back();
  }
  stock.untouched = stock.slots.size();
}

void DelaunayTriangulation::take_back(std::span<const std::uint32_t> slots) {
  empty_.insert(empty_.end(), slots.rbegin(), slots.rend());
}

void DelaunayTriangulation::fill(std::uint32_t slot, const std::array<std::uint32_t, 4>& corners) {
  cells_[slot] = {corners, {kNone, kNone, kNone, kNone}};
  labels_[slot] = kBackground;
  ++versions_[slot];
  if (is_infinite(slot)) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    balls_[slot] = {Vector3d::Constant(unknown), unknown, unknown};
  } else {
    balls_[slot] =
        ball_of(points_[corners[0]], points_[corners[1]], points_[corners[2]], points_[corners[3]]);
  }
  for (const std::uint32_t v : corners)
    if (v != kInfinite) cell_at_[v] = slot;
}

void DelaunayTriangulation::link(Facet facet, Facet other) {
  cells_[cell_of(facet)].across[corner_of(facet)] = other;
  cells_[cell_of(other)].across[corner_of(other)] = facet;
}

int DelaunayTriangulation::side_of(Facet facet, const Vector3d& p) const {
  const auto& c = cells_[cell_of(facet)].corners;
  const auto& [i, j, k] = kFacetCorners[corner_of(facet)];
  return orientation(points_[c[i]], points_[c[j]], points_[c[k]], p);
}

std::uint32_t DelaunayTriangulation::locate(const Vector3d& p, std::uint32_t from) const {
  std::uint32_t cell = from, entered = 4;
  if (const std::uint32_t i = infinite_corner(cell); i < 4) cell = neighbour(cell, i);
  for (;;) {
    std::uint32_t i = 0;
    while (i < 4 && (i == entered || side_of(4 * cell + i, p) <= 0)) ++i;
    if (i == 4) return cell;
    const Facet facet = across(cell, i);
    cell = cell_of(facet);
    entered = corner_of(facet);
    if (is_infinite(cell)) return cell;
  }
}

bool DelaunayTriangulation::has_corner_at(std::uint32_t cell, const Vector3d& p) const {
  const auto& c = cells_[cell].corners;
  return std::any_of(c.begin(), c.end(), [&](std::uint32_t v) { return v != kInfinite && points_[v] == p; });
}

bool DelaunayTriangulation::is_surely_in_conflict(std::uint32_t cell, const Vector3d& p) const {
  const auto& c = cells_[cell].corners;
  const std::uint32_t i = infinite_corner(cell);
  if (i == 4) return is_in_sphere(points_[c[0]], points_[c[1]], points_[c[2]], points_[c[3]], p);
  // Seen from the infinite cell the hull lies beyond.
  const int side = side_of(4 * cell + i, p);
  return side != 0 ? side < 0 : is_in_conflict(neighbour(cell, i), p);
}

void DelaunayTriangulation::insert(std::uint32_t vertex, const Cavity& cavity, Stock& stock) {
  std::vector<std::uint32_t>& made = stock.made;
  made.assign(stock.slots.rbegin(), stock.slots.rbegin() + static_cast<std::ptrdiff_t>(cavity.rim.size()));
  stock.slots.resize(stock.slots.size() - cavity.rim.size());
  stock.untouched = std::min(stock.untouched, stock.slots.size());
  for (std::size_t n = 0; n < made.size(); ++n) {
    const Facet facet = cavity.rim[n], own = 4 * made[n] + corner_of(facet);
    std::array<std::uint32_t, 4> corners = cells_[cell_of(facet)].corners;
    corners[corner_of(facet)] = vertex;
    fill(made[n], corners);
    link(own, across(facet));
    cells_[cell_of(facet)].across[corner_of(facet)] = kReplaced | own;
  }
  // New cells meet in facets of the vertex and an edge of the rim. From the facet of the rim on one side of
  // the edge to that on the other it goes around the edge through the cavity.
  for (std::size_t n = 0; n < made.size(); ++n) {
    const std::uint32_t start = cell_of(cavity.rim[n]), apex = corner_of(cavity.rim[n]);
    for (std::uint32_t j = 0; j < 4; ++j) {
      if (j == apex || cells_[made[n]].across[j] != kNone) continue;
      std::uint32_t cell = start, in = apex, out = j;
      Facet facet = across(cell, out);
      while ((facet & kReplaced) == 0) {
        const std::uint32_t behind = cells_[cell].corners[in];
        cell = cell_of(facet);
        in = corner_of(facet);
        out = corner_at(cell, behind);
        facet = across(cell, out);
      }
      link(4 * made[n] + j, 4 * cell_of(facet & ~kReplaced) + in);
    }
  }
  for (const std::uint32_t cell : cavity.cells) ++versions_[cell];
  stock.slots.insert(stock.slots.end(), cavity.cells.rbegin(), cavity.cells.rend());
}

void DelaunayTriangulation::find_star(std::uint32_t vertex, Cavity& cavity) const {
  cavity.marks.resize(cells_.size(), 0);
  cavity.mark += 2;
  cavity.cells.assign(1, cell_at_[vertex]);
  cavity.marks[cavity.cells[0]] = cavity.mark;
  for (std::size_t k = 0; k < cavity.cells.size(); ++k) {
    const std::uint32_t cell = cavity.cells[k];
    for (std::uint32_t i = 0; i < 4; ++i) {
      if (cells_[cell].corners[i] == vertex) continue;
      const std::uint32_t next = neighbour(cell, i);
      if (std::exchange(cavity.marks[next], cavity.mark) != cavity.mark) cavity.cells.push_back(next);
    }
  }
}

}  // namespace voxtet
