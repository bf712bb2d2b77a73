#include "remesh/cells/extract_interface.h"

#include <utility>
#include "geometry/search/morton_curve.h"

namespace voxtet::remesh {
namespace {

/// What is done to a surface triangle by triangle then finds what it needs in the processor's cache.
void sort_in_space(SurfaceMesh& surface) {
  if (surface.triangles.empty()) return;
  const MortonCurve curve(surface.points);
  const std::vector<std::uint32_t> along =
      curve.order(surface.triangles.size(), [&](std::size_t t) -> Eigen::Vector3d {
        const auto& [a, b, c] = surface.triangles[t];
        return (surface.points[a] + surface.points[b] + surface.points[c]) / 3;
      });
  std::vector<Triangle> triangles;
  std::vector<Sides> sides;
  for (const std::uint32_t t : along) {
    triangles.push_back(surface.triangles[t]);
    sides.push_back(surface.sides[t]);
  }
  surface.triangles = std::move(triangles);
  surface.sides = std::move(sides);
}

}  // namespace

SurfaceMesh extract_interface(const LabelledCells& cells) {
  SurfaceMesh out;
  std::vector<std::uint8_t> used(cells.points.size(), 0);
  for (std::size_t c = 0; c < cells.labels.size(); ++c)
    for (std::size_t i = 0; i < 4; ++i) {
      const Label behind = cells.labels[c], front = cells.label_or_background(cells.neighbours[c][i]);
      if (behind <= front) continue;
      Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        triangle[k] = cells.vertices[c][kFacetCorners[i][k]];
        used[triangle[k]] = 1;
      }
      out.triangles.push_back(triangle);
      out.sides.push_back({behind, front});
    }
  std::vector<std::uint32_t> id(cells.points.size(), LabelledCells::kNone);
  for (std::size_t p = 0; p < cells.points.size(); ++p)
    if (used[p]) {
      id[p] = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(cells.points[p]);
    }
  for (Triangle& triangle : out.triangles)
    for (std::uint32_t& corner : triangle) corner = id[corner];
  sort_in_space(out);
  return out;
}

}  // namespace voxtet::remesh
