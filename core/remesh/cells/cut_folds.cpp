#include "remesh/cells/cut_folds.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/cut/cut_faces.h"
#include "remesh/cells/cell_stars.h"

namespace voxtet::remesh {
namespace {

constexpr int kUnfoldRounds = 4;

/// Facets of interfaces as triangles, and the cuts of all points.
struct CutCorners {
  std::vector<Triangle> triangles;
  std::vector<Sides> sides;
  std::vector<CutBits> of_points;
};

CutCorners cut_corners(const CutPlanes& cuts, const LabelledCells& cells,
                       const std::vector<InterfaceFacet>& facets) {
  CutCorners out;
  for (const InterfaceFacet& facet : facets) {
    const auto& corners = kFacetCorners[facet.corner];
    Triangle& triangle = out.triangles.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      triangle[c] = cells.vertices[facet.cell][static_cast<std::size_t>(corners[c])];
    out.sides.push_back(
        {cells.labels[facet.cell], cells.label_or_background(cells.neighbours[facet.cell][facet.corner])});
  }
  out.of_points = cuts_of_points(cells.points.size(), out.triangles, out.sides, cuts);
  return out;
}

std::vector<InterfaceFacet> folds_among(const CutPlanes& cuts, const CutCorners& corners,
                                        const std::vector<InterfaceFacet>& facets) {
  std::vector<InterfaceFacet> folds;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& [a, b, c] = corners.triangles[f];
    const CutBits common = corners.of_points[a] & corners.of_points[b] & corners.of_points[c];
    if ((common & ~cuts_of_sides(corners.sides[f], cuts)) != 0) folds.push_back(facets[f]);
  }
  return folds;
}

class Unfolder {
 public:
  explicit Unfolder(LabelledCells& cells) : cells_(cells), stars_(cells) {}

  /// Gives a cell the best of the labels around it; whether there is one.
  bool relabel(std::uint32_t cell) {
    const Label own = cells_.labels[cell];
    const std::vector<std::uint32_t> points = stars_.points_of({cell});
    const std::size_t defects = stars_.defects(points);
    Label best = own;
    std::size_t fewest = facets_between(cell);
    for (const std::uint32_t other : cells_.neighbours[cell]) {
      cells_.labels[cell] = cells_.label_or_background(other);
      if (const std::size_t count = facets_between(cell);
          count < fewest && stars_.defects(points) <= defects) {
        best = cells_.labels[cell];
        fewest = count;
      }
    }
    cells_.labels[cell] = best;
    return best != own;
  }

 private:
  std::size_t facets_between(std::uint32_t cell) const {
    const auto& around = cells_.neighbours[cell];
    return static_cast<std::size_t>(std::count_if(around.begin(), around.end(), [&](std::uint32_t other) {
      return cells_.label_or_background(other) != cells_.labels[cell];
    }));
  }

  LabelledCells& cells_;
  const CellStars stars_;
};

}  // namespace

std::vector<InterfaceFacet> find_cut_folds(const CutPlanes& cuts, const LabelledCells& cells,
                                           const std::vector<InterfaceFacet>& facets) {
  if (cuts.empty()) return {};
  return folds_among(cuts, cut_corners(cuts, cells, facets), facets);
}

void remove_cut_folds(const CutPlanes& cuts, LabelledCells& cells) {
  if (cuts.empty()) return;
  Unfolder unfolder(cells);
  bool any = true;
  for (int round = 0; round < kUnfoldRounds && any; ++round) {
    any = false;
    const std::vector<InterfaceFacet> facets = find_interface_edges(cells).facets;
    const CutCorners corners = cut_corners(cuts, cells, facets);
    for (const InterfaceFacet& fold : folds_among(cuts, corners, facets))
      for (const std::uint32_t cell : {fold.cell, cells.neighbours[fold.cell][fold.corner]}) {
        if (cells.label_or_background(cell) == kBackground) continue;
        const auto& [a, b, c, d] = cells.vertices[cell];
        const std::vector<CutBits>& of = corners.of_points;
        if ((of[a] & of[b] & of[c] & of[d]) != 0) any = unfolder.relabel(cell) || any;
      }
  }
}

}  // namespace voxtet::remesh
