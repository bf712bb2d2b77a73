#include "remesh/cells/interface_edges.h"

#include <algorithm>

namespace voxtet::remesh {
namespace {

/// A facet at one point: its other two corners and its two labels.
struct Blade {
  std::array<std::uint32_t, 2> rim;
  std::array<Label, 2> sides;
};

/// Room that counting needs.
struct FanScratch {
  std::vector<std::uint8_t> waiting;
  std::vector<std::size_t> stack;
};

/// Number of fans into which the blades of one label fall.
int count_fans(const std::vector<Blade>& blades, Label label, FanScratch& scratch) {
  auto& [waiting, stack] = scratch;
  waiting.clear();
  for (const Blade& b : blades) waiting.push_back(b.sides[0] == label || b.sides[1] == label);
  int fans = 0;
  for (std::size_t first = 0; first < blades.size(); ++first) {
    if (!waiting[first]) continue;
    ++fans;
    waiting[first] = 0;
    stack.push_back(first);
    while (!stack.empty()) {
      const Blade& blade = blades[stack.back()];
      stack.pop_back();
      for (std::size_t i = 0; i < blades.size(); ++i) {
        if (!waiting[i]) continue;
        const auto& r = blades[i].rim;
        if (r[0] != blade.rim[0] && r[0] != blade.rim[1] && r[1] != blade.rim[0] && r[1] != blade.rim[1])
          continue;
        waiting[i] = 0;
        stack.push_back(i);
      }
    }
  }
  return fans;
}

/// Edges at which some label has more than two boundary facets.
std::vector<std::uint32_t> find_pinched_edges(const LabelledCells& cells, const InterfaceEdges& edges) {
  std::vector<std::uint32_t> pinched;
  std::vector<Label> sides;
  for (std::uint32_t e = 0; e < edges.ends.size(); ++e) {
    if (edges.start[e + 1] - edges.start[e] <= 2) continue;
    sides.clear();
    for (std::uint32_t k = edges.start[e]; k < edges.start[e + 1]; ++k) {
      const InterfaceFacet& facet = edges.facets[edges.facet_of[k]];
      sides.push_back(cells.labels[facet.cell]);
      sides.push_back(cells.label_or_background(cells.neighbours[facet.cell][facet.corner]));
    }
    std::sort(sides.begin(), sides.end());
    bool thrice = false;
    for (std::size_t s = 2; s < sides.size(); ++s) thrice = thrice || sides[s] == sides[s - 2];
    if (thrice) pinched.push_back(e);
  }
  return pinched;
}

/// Points at which the boundary facets of some label form more than one fan.
std::vector<std::uint32_t> find_pinched_points(const LabelledCells& cells, const InterfaceEdges& edges) {
  std::vector<std::uint32_t> start(cells.points.size() + 1, 0);
  const auto corners = [&](const InterfaceFacet& facet) {
    std::array<std::uint32_t, 3> out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = cells.vertices[facet.cell][kFacetCorners[facet.corner][k]];
    return out;
  };
  for (const InterfaceFacet& facet : edges.facets)
    for (const std::uint32_t p : corners(facet)) ++start[p + 1];
  for (std::size_t p = 1; p < start.size(); ++p) start[p] += start[p - 1];
  std::vector<std::uint32_t> fill(start.begin(), start.end() - 1);
  std::vector<Blade> blades(start.back());
  for (const InterfaceFacet& facet : edges.facets) {
    const std::array<std::uint32_t, 3> c = corners(facet);
    const Label front = cells.label_or_background(cells.neighbours[facet.cell][facet.corner]);
    for (std::size_t k = 0; k < 3; ++k)
      blades[fill[c[k]]++] = {{c[(k + 1) % 3], c[(k + 2) % 3]}, {cells.labels[facet.cell], front}};
  }
  std::vector<std::uint32_t> pinched;
  std::vector<Blade> here;
  std::vector<Label> labels;
  FanScratch scratch;
  for (std::uint32_t p = 0; p + 1 < start.size(); ++p) {
    here.assign(blades.begin() + start[p], blades.begin() + start[p + 1]);
    labels.clear();
    for (const Blade& b : here) labels.insert(labels.end(), b.sides.begin(), b.sides.end());
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    if (labels.size() == 2) labels.pop_back();  // both have the same facets
    if (std::any_of(labels.begin(), labels.end(), [&](Label l) { return count_fans(here, l, scratch) > 1; }))
      pinched.push_back(p);
  }
  return pinched;
}

}  // namespace

InterfaceEdges find_interface_edges(const LabelledCells& cells) {
  struct Entry {
    std::uint32_t high, facet;
  };
  InterfaceEdges out;
  for (std::uint32_t c = 0; c < cells.labels.size(); ++c)
    for (std::uint32_t i = 0; i < 4; ++i)
      if (cells.labels[c] > cells.label_or_background(cells.neighbours[c][i])) out.facets.push_back({c, i});

  // Bucketed by the lower point, then sorted within the (small) bucket by the higher.
  const auto corners = [&](std::uint32_t f, std::size_t k) {
    const InterfaceFacet& facet = out.facets[f];
    return cells.vertices[facet.cell][kFacetCorners[facet.corner][k % 3]];
  };
  std::vector<std::uint32_t> bucket(cells.points.size() + 1, 0);
  const auto count = static_cast<std::uint32_t>(out.facets.size());
  for (std::uint32_t f = 0; f < count; ++f)
    for (std::size_t k = 0; k < 3; ++k) ++bucket[std::min(corners(f, k), corners(f, k + 1)) + 1];
  for (std::size_t p = 1; p < bucket.size(); ++p) bucket[p] += bucket[p - 1];
  std::vector<std::uint32_t> fill(bucket.begin(), bucket.end() - 1);
  std::vector<Entry> entries(3 * static_cast<std::size_t>(count));
  for (std::uint32_t f = 0; f < count; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners(f, k), b = corners(f, k + 1);
      entries[fill[std::min(a, b)]++] = {std::max(a, b), f};
    }
  out.facet_of.reserve(entries.size());
  for (std::uint32_t p = 0; p + 1 < bucket.size(); ++p) {
    const auto first = entries.begin() + bucket[p], last = entries.begin() + bucket[p + 1];
    std::sort(first, last, [](const Entry& x, const Entry& y) {
      return x.high != y.high ? x.high < y.high : x.facet < y.facet;
    });
    for (auto e = first; e != last; ++e) {
      if (e == first || e->high != (e - 1)->high) {
        out.ends.push_back({p, e->high});
        out.start.push_back(static_cast<std::uint32_t>(out.facet_of.size()));
      }
      out.facet_of.push_back(e->facet);
    }
  }
  out.start.push_back(static_cast<std::uint32_t>(out.facet_of.size()));
  return out;
}

std::vector<std::uint32_t> Pinches::points() const {
  std::vector<std::uint32_t> points = at_points;
  for (const std::uint32_t e : at_edges)
    points.insert(points.end(), edges.ends[e].begin(), edges.ends[e].end());
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

Pinches find_pinches(const LabelledCells& cells) {
  Pinches pinches;
  pinches.edges = find_interface_edges(cells);
  pinches.at_edges = find_pinched_edges(cells, pinches.edges);
  pinches.at_points = find_pinched_points(cells, pinches.edges);
  return pinches;
}

}  // namespace voxtet::remesh
