// Gmsh from a discrete surface: VARIANT `delaunay` (Mesh.Algorithm3D 1, its default) or `hxt` (10).
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/fill_peer.h"
#include "bench/peers/surface_regions.h"

using namespace voxtet;

namespace {

constexpr int kTriangle = 2, kTetrahedron = 4;  // Gmsh's element types

/// A discrete surface for each pair of regions that meet, a volume for each region.
void hand_over(const SurfaceMesh& surface) {
  std::vector<std::size_t> tags(surface.points.size());
  std::iota(tags.begin(), tags.end(), 1);
  std::vector<double> coordinates;
  for (const Eigen::Vector3d& p : surface.points)
    coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  const peers::SurfaceRegions regions = peers::find_regions(surface);
  std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> corners;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const std::uint32_t v : surface.triangles[t]) corners[regions.of_triangle[t]].push_back(v + 1);
  gmsh::model::add("surface");
  std::vector<std::vector<int>> faces(regions.count + 1);
  int tag = 0;
  for (const auto& [sides, triangles] : corners) {
    gmsh::model::addDiscreteEntity(2, ++tag);
    if (tag == 1) gmsh::model::mesh::addNodes(2, tag, tags, coordinates);
    gmsh::model::mesh::addElementsByType(tag, kTriangle, {}, triangles);
    for (const std::uint32_t side : sides) faces[side].push_back(tag);
  }
  for (std::size_t region = 1; region < faces.size(); ++region)
    gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop(faces[region])});
  gmsh::model::geo::synchronize();
}

peers::Filled take(const SurfaceMesh& surface) {
  peers::Filled filled{surface.points, {}};
  std::vector<std::size_t> tags, elements, corners;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::size_t largest = surface.points.size();
  for (const std::size_t tag : tags) largest = std::max(largest, tag);
  filled.points.resize(largest, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < tags.size(); ++i)
    filled.points[tags[i] - 1] = Eigen::Vector3d::Map(&coordinates[3 * i]);
  gmsh::model::mesh::getElementsByType(kTetrahedron, elements, corners);
  for (std::size_t i = 0; i + 3 < corners.size(); i += 4) {
    Tet tet{};
    for (std::size_t c = 0; c < 4; ++c) tet[c] = static_cast<std::uint32_t>(corners[i + c] - 1);
    filled.tets.push_back(tet);
  }
  return filled;
}

void set_options(bool hxt) {
  const std::pair<const char*, double> options[] = {
      {"General.Terminal", 0},        {"General.NumThreads", 1},
      {"Mesh.MaxNumThreads3D", 1},    {"Mesh.MeshSizeExtendFromBoundary", 0},
      {"Mesh.MeshSizeFromPoints", 0}, {"Mesh.Algorithm3D", hxt ? 10 : 1}};
  for (const auto& [name, value] : options) gmsh::option::setNumber(name, value);
}

Result<peers::Filled> fill(const peers::FillTask& task, const std::string& variant) {
  std::string said = "nothing";
  try {
    gmsh::initialize();
    set_options(variant == "hxt");
    hand_over(task.surface);
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double z) {
      return task.sizing.at({x, y, z});
    });
    gmsh::model::mesh::generate(3);
    peers::Filled filled = take(task.surface);
    gmsh::finalize();
    if (!filled.tets.empty()) return filled;
  } catch (const std::string& error) {  // what Gmsh 4.8 throws
    said = error;
  }
  return Error{ErrorCode::kMeshing, "peers", "Gmsh gave no tetrahedra and said: " + said, {}};
}

}  // namespace

int main(int argc, char** argv) {
  return peers::fill_main(argc, argv, fill);
}
