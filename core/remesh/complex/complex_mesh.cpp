#include "remesh/complex/complex_mesh.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace voxtet::remesh {
namespace {

constexpr std::uint16_t kSmallestBlockLog2 = 3;

}  // namespace

ComplexMesh::ComplexMesh(const SurfaceMesh& surface, std::vector<Sides> sides)
    : points_(surface.points), triangles_(surface.triangles), sides_(std::move(sides)) {
  std::sort(sides_.begin(), sides_.end());
  sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
  pairs_.reserve(surface.sides.size());
  for (const Sides& s : surface.sides)
    pairs_.push_back(static_cast<PairId>(std::lower_bound(sides_.begin(), sides_.end(), s) - sides_.begin()));
  std::vector<std::uint16_t> count(points_.size(), 0);
  for (const Triangle& t : triangles_)
    for (const std::uint32_t v : t) ++count[v];
  rows_.resize(points_.size());
  std::uint32_t size = 0;
  for (std::size_t v = 0; v < rows_.size(); ++v) {
    const auto log2 =
        static_cast<std::uint16_t>(std::bit_width(static_cast<unsigned>(std::max(1, count[v] - 1))));
    rows_[v] = {size, 0, std::max(kSmallestBlockLog2, log2)};
    size += 1U << rows_[v].capacity_log2;
  }
  pool_.resize(size);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    for (const std::uint32_t v : triangles_[t]) pool_[rows_[v].first + rows_[v].count++] = t;
  classify();
}

std::uint32_t ComplexMesh::edge_degree(std::uint32_t a, std::uint32_t b) const {
  std::uint32_t degree = 0;
  for (const std::uint32_t t : star(a)) degree += has_corner(triangles_[t], b) ? 1 : 0;
  return degree;
}

std::uint32_t ComplexMesh::take_block(std::uint16_t capacity_log2) {
  std::vector<std::uint32_t>& free = free_blocks_[capacity_log2];
  if (!free.empty()) {
    const std::uint32_t block = free.back();
    free.pop_back();
    return block;
  }
  const auto block = static_cast<std::uint32_t>(pool_.size());
  pool_.resize(pool_.size() + (std::size_t{1} << capacity_log2));
  return block;
}

void ComplexMesh::attach(std::uint32_t v, std::uint32_t t) {
  Row row = rows_[v];
  if (row.count == 1U << row.capacity_log2) {
    const std::uint32_t block = take_block(row.capacity_log2 + 1);
    std::copy_n(pool_.begin() + row.first, row.count, pool_.begin() + block);
    free_blocks_[row.capacity_log2].push_back(row.first);
    row.first = block;
    ++row.capacity_log2;
  }
  pool_[row.first + row.count++] = t;
  rows_[v] = row;
}

void ComplexMesh::detach(std::uint32_t v, std::uint32_t t) {
  Row& row = rows_[v];
  std::uint32_t* begin = pool_.data() + row.first;
  *std::find(begin, begin + row.count, t) = begin[row.count - 1];
  --row.count;
}

std::uint32_t ComplexMesh::add_vertex(const Eigen::Vector3d& p, Stratum stratum) {
  points_.push_back(p);
  strata_.push_back(stratum);
  rows_.push_back({take_block(kSmallestBlockLog2), 0, kSmallestBlockLog2});
  return static_cast<std::uint32_t>(points_.size() - 1);
}

void ComplexMesh::drop_last_vertex() {
  free_blocks_[rows_.back().capacity_log2].push_back(rows_.back().first);
  points_.pop_back();
  strata_.pop_back();
  rows_.pop_back();
}

void ComplexMesh::replace(std::uint32_t t, const Facet& facet) {
  const Triangle old = triangles_[t];
  for (const std::uint32_t v : old)
    if (!has_corner(facet.corners, v)) detach(v, t);
  for (const std::uint32_t v : facet.corners)
    if (!has_corner(old, v)) attach(v, t);
  triangles_[t] = facet.corners;
  pairs_[t] = facet.pair;
}

void ComplexMesh::remove(std::uint32_t t) {
  for (const std::uint32_t v : triangles_[t]) detach(v, t);
  triangles_[t][0] = kNone;
  free_slots_.push_back(t);
}

std::uint32_t ComplexMesh::add(const Facet& facet) {
  std::uint32_t t = 0;
  if (free_slots_.empty()) {
    t = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(facet.corners);
    pairs_.push_back(facet.pair);
  } else {
    t = free_slots_.back();
    free_slots_.pop_back();
    triangles_[t] = facet.corners;
    pairs_[t] = facet.pair;
  }
  for (const std::uint32_t v : facet.corners) attach(v, t);
  return t;
}

void ComplexMesh::classify() {
  strata_.assign(points_.size(), Stratum::kSurface);
  std::vector<Spoke> spokes;
  for (std::uint32_t v = 0; v < points_.size(); ++v)
    if (rows_[v].count > 0) strata_[v] = stratum_of(v, spokes);
}

Stratum ComplexMesh::stratum_of(std::uint32_t v, std::vector<Spoke>& spokes) const {
  spokes.clear();
  for (const std::uint32_t t : star(v))
    for (const std::uint32_t other : triangles_[t]) {
      if (other == v) continue;
      const auto known =
          std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& spoke) { return spoke.end == other; });
      if (known != spokes.end())
        ++known->degree;
      else
        spokes.push_back({other, 1});
    }
  std::erase_if(spokes, [](const Spoke& spoke) { return spoke.degree == 2; });
  if (spokes.empty() && is_one_fan(v)) return Stratum::kSurface;
  if (spokes.size() == 2 && is_book(v, spokes[0].end, spokes[1].end)) return Stratum::kCurve;
  return Stratum::kCorner;
}

/// Goes from triangle `t`, away from its corner `over`, around v until the next corner is one of the two
/// stops. Returns how many triangles were met.
std::uint32_t ComplexMesh::walk_sheet(std::uint32_t v, std::uint32_t t, std::uint32_t over,
                                      std::uint32_t stop_a, std::uint32_t stop_b, std::uint32_t& end) const {
  for (std::uint32_t met = 1; met <= star(v).size(); ++met) {
    end = third_corner(triangles_[t], v, over);
    if (end == stop_a || end == stop_b) return met;
    for (const std::uint32_t next : star(v))
      if (next != t && has_corner(triangles_[next], end)) {
        t = next;
        break;
      }
    over = end;
  }
  return 0;
}

bool ComplexMesh::is_one_fan(std::uint32_t v) const {
  const std::uint32_t t = star(v).front();
  const std::uint32_t first = triangles_[t][triangles_[t][0] == v ? 1 : 0];
  std::uint32_t end = 0;
  return walk_sheet(v, t, first, first, first, end) == star(v).size();
}

bool ComplexMesh::is_book(std::uint32_t v, std::uint32_t from, std::uint32_t to) const {
  std::size_t met = 0;
  for (const std::uint32_t t : star(v)) {
    if (!has_corner(triangles_[t], from)) continue;
    std::uint32_t end = 0;
    met += walk_sheet(v, t, from, from, to, end);
    if (end != to) return false;
  }
  return met == star(v).size();
}

SurfaceMesh ComplexMesh::to_surface() const {
  SurfaceMesh out;
  std::vector<std::uint32_t> id(points_.size(), kNone);
  for (std::uint32_t v = 0; v < points_.size(); ++v)
    if (rows_[v].count > 0) {
      id[v] = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(points_[v]);
    }
  for (std::uint32_t t = 0; t < triangles_.size(); ++t)
    if (alive(t)) {
      const Triangle& c = triangles_[t];
      out.triangles.push_back({id[c[0]], id[c[1]], id[c[2]]});
      out.sides.push_back(sides_[pairs_[t]]);
    }
  return out;
}

}  // namespace voxtet::remesh
