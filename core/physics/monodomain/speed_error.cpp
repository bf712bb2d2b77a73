#include "physics/monodomain/speed_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/wave_speed_error.h"
#include "geometry/elements/tet_measures.h"
#include "physics/monodomain/cell.h"

namespace voxtet {

std::vector<float> speed_errors_percent(const TetMesh& mesh, const Tissue& tissue, double consistent_mass,
                                        bool corrected) {
  std::vector<double> slowest;
  for (const TissueKind& kind : tissue.kinds)
    slowest.push_back(diffusivity_of(
        tissue.fibre.empty() ? kind.along_mm_per_ms : std::min(kind.along_mm_per_ms, kind.across_mm_per_ms),
        kind.cell));
  std::vector<float> errors(mesh.tets.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t t = 0; t < errors.size(); ++t) {
    if (tissue.kind[t] == Tissue::kNone) continue;
    const double share = tissue.share.empty() ? 1 : tissue.share[t];
    const Tet& tet = mesh.tets[t];
    const double edge =
        mean_edge_mm({mesh.points[tet[0]], mesh.points[tet[1]], mesh.points[tet[2]], mesh.points[tet[3]]});
    const double wanted = share * slowest[tissue.kind[t]];
    const double used = corrected ? diffusivity_on_mesh(edge, wanted, consistent_mass) : wanted;
    const double speed =
        std::sqrt(used / wanted) * (100 + wave_speed_error_percent(edge, used, consistent_mass));
    errors[t] = static_cast<float>(speed - 100);
  }
  return errors;
}

}  // namespace voxtet
