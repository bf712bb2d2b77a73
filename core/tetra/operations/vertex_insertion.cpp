#include "tetra/operations/vertex_insertion.h"

#include <algorithm>
#include <limits>

namespace voxtet::tetra {
namespace {

/// Tets of a cavity, at most.
constexpr std::size_t kMostTets = 50;
/// Tets dug in vain before giving up.
constexpr std::size_t kPatience = 12;
constexpr int kAscentSteps = 8;
/// The lowest quality has to grow by this factor to be worth a vertex.
constexpr double kLeastRise = 1.02;
/// New edges may be out of the range of sizes by this factor more than those of the cavity that no inserted
/// vertex has (or one vertex would allow the next an ever smaller place): between two interfaces that are
/// near each other a vertex has no other place.
constexpr double kSizeSlack = 1.5;

}  // namespace

void VertexInserter::absorb(std::uint32_t t, const Point& at) {
  cavity_.push_back(t);
  for (std::uint32_t c = 0; c < 4; ++c) {
    const Facet facet = complex_.across(t, c);
    const auto met =
        facet == kNone ? sides_.end() : std::find_if(sides_.begin(), sides_.end(), [facet](const Side& s) {
          return 4 * s.tet + s.corner == facet;
        });
    if (met != sides_.end()) {
      *met = sides_.back();
      sides_.pop_back();
      continue;
    }
    const Tet& corners = complex_.corners(t);
    const auto& side = kFacetCorners[c];
    sides_.push_back({t, c,
                      quality(at, complex_.point(corners[side[0]]), complex_.point(corners[side[1]]),
                              complex_.point(corners[side[2]]))});
  }
}

/// Absorbs the tet behind the worst side, again and again, and goes back to the best cavity on the way. With
/// `interfaces_count` the best one is that with the best of all sides, else of those that are no interfaces.
void VertexInserter::dig(const Point& at, bool interfaces_count) {
  std::vector<std::uint32_t> start = std::move(cavity_);
  cavity_.clear();
  sides_.clear();
  for (const std::uint32_t t : start) absorb(t, at);
  double best = -1;
  std::size_t best_size = cavity_.size();
  while (cavity_.size() < kMostTets && cavity_.size() < best_size + kPatience) {
    double lowest_interface = std::numeric_limits<double>::infinity(), lowest = lowest_interface;
    std::uint32_t next = kNone;
    for (const Side& side : sides_) {
      const std::uint32_t behind = complex_.behind(side.tet, side.corner);
      if (behind == kNone) {
        lowest_interface = std::min(lowest_interface, side.quality);
      } else if (side.quality < lowest) {
        lowest = side.quality;
        next = behind;
      }
    }
    if (lowest_interface == 0) break;
    const double reached = interfaces_count ? std::min(lowest, lowest_interface) : lowest;
    if (reached > best) {
      best = reached;
      best_size = cavity_.size();
    }
    if (next == kNone) break;
    absorb(next, at);
  }
  start.assign(cavity_.begin(), cavity_.begin() + static_cast<std::ptrdiff_t>(best_size));
  cavity_.clear();
  sides_.clear();
  for (const std::uint32_t t : start) absorb(t, at);
}

double VertexInserter::lowest_before() const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t t : cavity_) lowest = std::min(lowest, complex_.quality_of(t));
  return lowest;
}

Apex VertexInserter::smooth(const Point& at) {
  star_.clear();
  for (const Side& s : sides_) {
    const Tet& corners = complex_.corners(s.tet);
    const auto& side = kFacetCorners[s.corner];
    star_.push_back({complex_.point(corners[side[0]]), complex_.point(corners[side[1]]),
                     complex_.point(corners[side[2]])});
  }
  return ascend(at, star_, kAscentSteps);
}

bool VertexInserter::sizes_allow(const Point& at) const {
  double before = 1, after = 0;
  for (const Side& s : sides_) {
    const Tet& corners = complex_.corners(s.tet);
    const auto& side = kFacetCorners[s.corner];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[side[i]], b = corners[side[(i + 1) % 3]];
      if (std::max(a, b) < first_inserted_)
        before = std::max(before, guard_.misfit(complex_.point(a), complex_.point(b)));
      after = std::max(after, guard_.misfit(at, complex_.point(a)));
    }
  }
  return after <= kSizeSlack * before;
}

bool VertexInserter::commit(const Point& at) {
  const std::uint32_t vertex = complex_.add_point(at);
  made_.clear();
  for (const Side& s : sides_) {
    const Tet& corners = complex_.corners(s.tet);
    const auto& side = kFacetCorners[s.corner];
    made_.push_back({vertex, corners[side[0]], corners[side[1]], corners[side[2]]});
  }
  if (complex_.replace(cavity_, made_)) return true;
  complex_.drop_point();
  return false;
}

/// The place of a new vertex that starts there, after the cavity has grown; without quality if there is none.
Apex VertexInserter::settle(const Point& at, bool interfaces_count) {
  Apex apex{at, 0};
  // From where it went first it may take another cavity, and then another place.
  for (int round = 0; round < 2; ++round) {
    dig(apex.at, interfaces_count || round > 0);
    apex = smooth(apex.at);
    if (!(apex.quality > 0)) return {apex.at, 0};
  }
  return apex;
}

bool VertexInserter::insert_from(const Start& start, bool interfaces_count, double gain) {
  cavity_.assign(1, start.tet);
  const Apex apex = settle(start.at, interfaces_count);
  return apex.quality > 0 && apex.quality > gain * lowest_before() && sizes_allow(apex.at) && commit(apex.at);
}

std::vector<VertexInserter::Start> VertexInserter::starts_at(std::uint32_t t) const {
  const auto centre = [this](const Tet& c) {
    return Point((complex_.point(c[0]) + complex_.point(c[1]) + complex_.point(c[2]) + complex_.point(c[3])) /
                 4);
  };
  const Tet& c = complex_.corners(t);
  std::vector<Start> starts{{centre(c), t}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      starts.push_back({(complex_.point(c[i]) + complex_.point(c[j])) / 2, t});
  // From within a flat tet on an interface nothing gets better: from its neighbours.
  for (std::uint32_t side = 0; side < 4; ++side)
    if (const std::uint32_t behind = complex_.behind(t, side); behind != kNone)
      starts.push_back({centre(complex_.corners(behind)), behind});
  return starts;
}

bool VertexInserter::insert(std::uint32_t t) {
  const std::vector<Start> starts = starts_at(t);
  const std::span<const Start> all = starts, inside = all.first(kInside);
  const auto insert_one_of = [this](std::span<const Start> from, bool interfaces_count) {
    return std::any_of(from.begin(), from.end(),
                       [&](const Start& start) { return insert_from(start, interfaces_count, kLeastRise); });
  };
  return insert_one_of(inside, true) || insert_one_of(inside, false) ||
         insert_one_of(all.subspan(kInside), true);
}

}  // namespace voxtet::tetra
