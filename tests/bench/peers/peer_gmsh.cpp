// Gmsh from a discrete surface: VARIANT `delaunay` (Mesh.Algorithm3D 1, its default) or `hxt` (10).
#include <gmsh.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bench/peers/fill_peer.h"

using namespace voxtet;

namespace {

constexpr int kTriangle = 2, kTetrahedron = 4;  // Gmsh's element types

void hand_over(const SurfaceMesh& surface) {
  std::vector<std::size_t> tags(surface.points.size()), corners;
  std::iota(tags.begin(), tags.end(), 1);
  std::vector<double> coordinates;
  for (const Eigen::Vector3d& p : surface.points)
    coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  for (const Triangle& t : surface.triangles)
    for (const std::uint32_t v : t) corners.push_back(v + 1);
  gmsh::model::add("surface");
  gmsh::model::addDiscreteEntity(2, 1);
  gmsh::model::mesh::addNodes(2, 1, tags, coordinates);
  gmsh::model::mesh::addElementsByType(1, kTriangle, {}, corners);
  gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop({1})});
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
