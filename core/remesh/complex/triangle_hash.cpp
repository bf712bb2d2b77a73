#include "remesh/complex/triangle_hash.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace voxtet::remesh {
namespace {

/// More than the rounding to float can be.
constexpr float kRounding = 1.2e-7F;

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return f - kRounding * std::abs(f);
}
float round_up(double x) {
  const auto f = static_cast<float>(x);
  return f + kRounding * std::abs(f);
}

}  // namespace

void FloatBox::extend(const FloatBox& o) {
  for (int d = 0; d < 3; ++d) {
    low[d] = std::min(low[d], o.low[d]);
    high[d] = std::max(high[d], o.high[d]);
  }
}

FloatBox FloatBox::grown(double margin) const {
  if (margin == 0) return *this;
  FloatBox box;
  for (int d = 0; d < 3; ++d) {
    box.low[d] = round_down(low[d] - margin);
    box.high[d] = round_up(high[d] + margin);
  }
  return box;
}

FloatBox box_of(const Corners& t) {
  FloatBox box;
  for (int d = 0; d < 3; ++d) {
    box.low[d] = round_down(std::min({t[0][d], t[1][d], t[2][d]}));
    box.high[d] = round_up(std::max({t[0][d], t[1][d], t[2][d]}));
  }
  return box;
}

TriangleHash::TriangleHash(const ComplexMesh& mesh, double cell_mm) {
  for (std::size_t level = 0; level < kLevels; ++level) {
    cell_mm_[level] = cell_mm;
    cells_per_mm_[level] = 1 / cell_mm;
    cell_mm *= 2;
  }
  std::size_t alive = 0;
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t) alive += mesh.alive(t) ? 1 : 0;
  const std::size_t size = std::bit_ceil(alive + 1024);
  heads_.assign(size, kNone);
  mask_ = static_cast<std::uint32_t>(size - 1);
  entries_.resize(mesh.slot_count());
  for (std::uint32_t t = 0; t < mesh.slot_count(); ++t)
    if (mesh.alive(t)) insert(t, mesh.corners(mesh.triangle(t)));
}

/// Neighbours along i stand side by side in memory.
std::uint32_t TriangleHash::bucket(int level, int i, int j, int k) const {
  return (static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(j) * 73856093U +
          static_cast<std::uint32_t>(k) * 19349663U + static_cast<std::uint32_t>(level) * 83492791U) &
         mask_;
}

int TriangleHash::level_of(const FloatBox& box) const {
  const double size = std::max(
      {double{box.high[0]} - box.low[0], double{box.high[1]} - box.low[1], double{box.high[2]} - box.low[2]});
  int level = 0;
  while (level + 1 < kLevels && cell_mm_[static_cast<std::size_t>(level)] < size) ++level;
  return level;
}

std::uint32_t TriangleHash::bucket_of(const FloatBox& box, int level) const {
  const double scale = 0.5 * cells_per_mm_[static_cast<std::size_t>(level)];
  std::array<int, 3> cell{};
  for (std::size_t d = 0; d < 3; ++d)
    cell[d] = static_cast<int>(std::floor((double{box.low[d]} + box.high[d]) * scale));
  return bucket(level, cell[0], cell[1], cell[2]);
}

void TriangleHash::link(std::uint32_t t, int level) {
  std::uint32_t& head = heads_[bucket_of(entries_[t].box, level)];
  entries_[t].next = head;
  head = t;
  ++population_[static_cast<std::size_t>(level)];
}

void TriangleHash::unlink(std::uint32_t t, int level) {
  std::uint32_t* link = &heads_[bucket_of(entries_[t].box, level)];
  while (*link != t) link = &entries_[*link].next;
  *link = entries_[t].next;
  --population_[static_cast<std::size_t>(level)];
}

void TriangleHash::insert(std::uint32_t t, const Corners& corners) {
  if (t >= entries_.size()) entries_.resize(t + 1);
  entries_[t].box = box_of(corners);
  link(t, level_of(entries_[t].box));
}

void TriangleHash::erase(std::uint32_t t) {
  unlink(t, level_of(entries_[t].box));
}

void TriangleHash::move(std::uint32_t t, const Corners& corners) {
  erase(t);
  insert(t, corners);
}

void TriangleHash::find(const FloatBox& box, Search& search, std::vector<std::uint32_t>& out) const {
  out.clear();
  ++search.number;
  search.met_by.resize(entries_.size(), 0);
  for (int level = 0; level < kLevels; ++level) {
    const auto at = static_cast<std::size_t>(level);
    if (population_[at] == 0) continue;
    std::array<int, 3> low{}, high{};
    for (std::size_t d = 0; d < 3; ++d) {
      // A little more than half a cell, for the rounding of centres.
      low[d] = static_cast<int>(std::floor(box.low[d] * cells_per_mm_[at] - 0.5001));
      high[d] = static_cast<int>(std::floor(box.high[d] * cells_per_mm_[at] + 0.5001));
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          for (std::uint32_t t = heads_[bucket(level, i, j, k)]; t != kNone; t = entries_[t].next) {
            if (!entries_[t].box.meets(box) || search.met_by[t] == search.number) continue;
            search.met_by[t] = search.number;
            out.push_back(t);
          }
  }
}

}  // namespace voxtet::remesh
