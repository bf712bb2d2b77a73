#include "remesh/triangle_hash.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace voxtet::remesh {
namespace {

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float round_up(double x) {
  const auto f = static_cast<float>(x);
  return f < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

void FloatBox::extend(const FloatBox& o) {
  for (int d = 0; d < 3; ++d) {
    low[d] = std::min(low[d], o.low[d]);
    high[d] = std::max(high[d], o.high[d]);
  }
}

FloatBox box_of(const Corners& t, double margin) {
  FloatBox box;
  for (int d = 0; d < 3; ++d) {
    box.low[d] = round_down(std::min({t[0][d], t[1][d], t[2][d]}) - margin);
    box.high[d] = round_up(std::max({t[0][d], t[1][d], t[2][d]}) + margin);
  }
  return box;
}

TriangleHash::TriangleHash(const ComplexMesh& mesh, double cell_mm) : cells_per_mm_(1 / cell_mm) {
  const std::size_t size = std::bit_ceil(mesh.slot_count() + 1024);
  heads_.assign(size, kNone);
  mask_ = static_cast<std::uint32_t>(size - 1);
  nodes_.reserve(4 * mesh.slot_count());
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t)) insert(t, mesh.corners(mesh.triangle(t)));
}

TriangleHash::Cells TriangleHash::cells_of(const FloatBox& box) const {
  Cells cells{};
  for (int d = 0; d < 3; ++d) {
    cells.low[d] = static_cast<int>(std::floor(box.low[d] * cells_per_mm_));
    cells.high[d] = static_cast<int>(std::floor(box.high[d] * cells_per_mm_));
  }
  return cells;
}

std::uint32_t TriangleHash::bucket(int i, int j, int k) const {
  std::uint32_t h = static_cast<std::uint32_t>(i) * 73856093U ^ static_cast<std::uint32_t>(j) * 19349663U ^
                    static_cast<std::uint32_t>(k) * 83492791U;
  h ^= h >> 15;
  return h & mask_;
}

template <class Visit>
void TriangleHash::for_buckets(const Cells& cells, Visit&& visit) {
  for (int k = cells.low[2]; k <= cells.high[2]; ++k)
    for (int j = cells.low[1]; j <= cells.high[1]; ++j)
      for (int i = cells.low[0]; i <= cells.high[0]; ++i) visit(bucket(i, j, k));
}

void TriangleHash::insert(std::uint32_t t, const Corners& corners) {
  if (t >= boxes_.size()) {
    boxes_.resize(t + 1);
    visited_.resize(t + 1, 0);
  }
  boxes_[t] = box_of(corners);
  for_buckets(cells_of(boxes_[t]), [&](std::uint32_t b) {
    std::uint32_t node = free_;
    if (node == kNone) {
      node = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
    } else {
      free_ = nodes_[node].next;
    }
    nodes_[node] = {t, heads_[b]};
    heads_[b] = node;
  });
}

void TriangleHash::erase(std::uint32_t t) {
  for_buckets(cells_of(boxes_[t]), [&](std::uint32_t b) {
    std::uint32_t* link = &heads_[b];
    while (nodes_[*link].triangle != t) link = &nodes_[*link].next;
    const std::uint32_t node = *link;
    *link = nodes_[node].next;
    nodes_[node].next = free_;
    free_ = node;
  });
}

void TriangleHash::move(std::uint32_t t, const Corners& corners) {
  const FloatBox box = box_of(corners);
  if (cells_of(box) == cells_of(boxes_[t])) {
    boxes_[t] = box;
    return;
  }
  erase(t);
  insert(t, corners);
}

void TriangleHash::find(const FloatBox& box, std::vector<std::uint32_t>& out) {
  out.clear();
  ++search_;
  for_buckets(cells_of(box), [&](std::uint32_t b) {
    for (std::uint32_t node = heads_[b]; node != kNone; node = nodes_[node].next) {
      const std::uint32_t t = nodes_[node].triangle;
      if (visited_[t] == search_) continue;
      visited_[t] = search_;
      if (boxes_[t].meets(box)) out.push_back(t);
    }
  });
}

}  // namespace voxtet::remesh
