#include "physics/monodomain/speed_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/wave_speed_error.h"
#include "physics/monodomain/cell.h"

namespace voxtet {
namespace {

double mean_edge_mm(const TetMesh& mesh, const Tet& tet) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) sum += (mesh.points[tet[i]] - mesh.points[tet[j]]).norm();
  return sum / 6;
}

}  // namespace

std::vector<float> speed_errors_percent(const TetMesh& mesh, const Tissue& tissue, double consistent_mass) {
  std::vector<double> slowest;
  for (const TissueKind& kind : tissue.kinds)
    slowest.push_back(diffusivity_of(
        tissue.fibre.empty() ? kind.along_mm_per_ms : std::min(kind.along_mm_per_ms, kind.across_mm_per_ms),
        kind.cell));
  std::vector<float> errors(mesh.tets.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t t = 0; t < errors.size(); ++t) {
    if (tissue.kind[t] == Tissue::kNone) continue;
    const double share = tissue.share.empty() ? 1 : tissue.share[t];
    errors[t] = static_cast<float>(wave_speed_error_percent(
        mean_edge_mm(mesh, mesh.tets[t]), share * slowest[tissue.kind[t]], consistent_mass));
  }
  return errors;
}

}  // namespace voxtet
