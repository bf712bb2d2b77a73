#include "remesh/extract_interface.h"

namespace voxtet::remesh {

SurfaceMesh extract_interface(const CellComplex& cells) {
  SurfaceMesh out;
  std::vector<std::uint8_t> used(cells.points.size(), 0);
  for (std::size_t c = 0; c < cells.labels.size(); ++c)
    for (std::size_t i = 0; i < 4; ++i) {
      const Label behind = cells.labels[c], front = cells.label_or_background(cells.neighbours[c][i]);
      if (behind <= front) continue;
      Triangle triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        triangle[k] = cells.vertices[c][static_cast<std::size_t>(kFacetCorners[i][k])];
        used[triangle[k]] = 1;
      }
      out.triangles.push_back(triangle);
      out.sides.push_back({behind, front});
    }
  std::vector<std::uint32_t> id(cells.points.size(), CellComplex::kNone);
  for (std::size_t p = 0; p < cells.points.size(); ++p)
    if (used[p]) {
      id[p] = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(cells.points[p]);
    }
  for (Triangle& triangle : out.triangles)
    for (std::uint32_t& corner : triangle) corner = id[corner];
  return out;
}

}  // namespace voxtet::remesh
