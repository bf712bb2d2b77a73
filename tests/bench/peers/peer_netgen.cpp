// Netgen by nglib, as it comes, with three rounds of optimisation. Its sizes inside follow the surface:
// Ng_RestrictMeshSizePoint hardly changes them.
#include <algorithm>
#include <cstddef>
#include <string>

#include "bench/peers/fill_peer.h"

namespace nglib {
#include <nglib.h>
}

using namespace voxtet;

namespace {

void hand_over(const SurfaceMesh& surface, nglib::Ng_Mesh* mesh) {
  for (Eigen::Vector3d p : surface.points) nglib::Ng_AddPoint(mesh, p.data());
  for (const Triangle& t : surface.triangles) {
    int corners[3] = {static_cast<int>(t[0]) + 1, static_cast<int>(t[1]) + 1, static_cast<int>(t[2]) + 1};
    nglib::Ng_AddSurfaceElement(mesh, nglib::NG_TRIG, corners);
  }
}

peers::Filled take(nglib::Ng_Mesh* mesh) {
  peers::Filled filled;
  filled.points.resize(static_cast<std::size_t>(nglib::Ng_GetNP(mesh)));
  for (std::size_t i = 0; i < filled.points.size(); ++i)
    nglib::Ng_GetPoint(mesh, static_cast<int>(i) + 1, filled.points[i].data());
  for (int i = 1; i <= nglib::Ng_GetNE(mesh); ++i) {
    int corners[10] = {};
    nglib::Ng_GetVolumeElement(mesh, i, corners);
    Tet tet{};
    for (std::size_t c = 0; c < 4; ++c) tet[c] = static_cast<std::uint32_t>(corners[c] - 1);
    filled.tets.push_back(tet);
  }
  return filled;
}

Result<peers::Filled> fill(const peers::FillTask& task, const std::string&) {
  nglib::Ng_Init();
  nglib::Ng_Mesh* mesh = nglib::Ng_NewMesh();
  hand_over(task.surface, mesh);
  nglib::Ng_Meshing_Parameters parameters;
  parameters.maxh = *std::max_element(task.sizing.h_mm.begin(), task.sizing.h_mm.end());
  nglib::Ng_RestrictMeshSizeGlobal(mesh, parameters.maxh);
  const nglib::Ng_Result result = nglib::Ng_GenerateVolumeMesh(mesh, &parameters);
  if (result != nglib::NG_OK)
    return Error{ErrorCode::kMeshing, "peers", "nglib answered with code " + std::to_string(result), {}};
  return take(mesh);
}

}  // namespace

int main(int argc, char** argv) {
  return peers::fill_main(argc, argv, fill);
}
