#include "physics/monodomain/conducting_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "base/wave_speed_error.h"
#include "geometry/elements/tet_measures.h"
#include "geometry/search/morton_curve.h"
#include "physics/monodomain/cell.h"
#include "physics/tissue/conducting_points.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

std::optional<Error> check(const TetMesh& mesh, const Tissue& tissue) {
  const auto has_all = [&](std::size_t count) { return count == mesh.tets.size(); };
  if (!has_all(tissue.kind.size()) || !(tissue.share.empty() || has_all(tissue.share.size())) ||
      !(tissue.fibre.empty() || has_all(tissue.fibre.size())))
    return Error{
        ErrorCode::kInternal, kMonodomainStage, "tissue: expected an entry for each tetrahedron", {}};
  for (std::size_t k = 0; k < tissue.kinds.size(); ++k) {
    const TissueKind& kind = tissue.kinds[k];
    const std::string name = "physics.tissue.kinds[" + std::to_string(k) + "].";
    if (const auto fault = fault_of(kind.cell)) return usage_error(kMonodomainStage, name + *fault);
    for (const auto& [field, speed] : {std::pair{"along_mm_per_ms", kind.along_mm_per_ms},
                                       std::pair{"across_mm_per_ms", kind.across_mm_per_ms}}) {
      if (std::isfinite(speed) && speed > 0) continue;
      std::ostringstream text;
      text << name << field << ": found " << speed << ", expected a finite number above 0";
      return usage_error(kMonodomainStage, text.str());
    }
  }
  return std::nullopt;
}

TetCorners corners_of(const TetMesh& mesh, std::size_t t) {
  const Tet& tet = mesh.tets[t];
  return {mesh.points[tet[0]], mesh.points[tet[1]], mesh.points[tet[2]], mesh.points[tet[3]]};
}

Eigen::Matrix3d diffusivity(const TetMesh& mesh, const Tissue& tissue, std::size_t t,
                            std::optional<double> corrected_for) {
  const TissueKind& kind = tissue.kinds[tissue.kind[t]];
  const double share = tissue.share.empty() ? 1 : tissue.share[t];
  const auto at = [&](double speed) {
    const double wanted = share * diffusivity_of(speed, kind.cell);
    return corrected_for ? diffusivity_on_mesh(mean_edge_mm(corners_of(mesh, t)), wanted, *corrected_for)
                         : wanted;
  };
  const double along = at(kind.along_mm_per_ms);
  if (tissue.fibre.empty()) return along * Eigen::Matrix3d::Identity();
  const double across = at(kind.across_mm_per_ms);
  const Eigen::Vector3d& f = tissue.fibre[t];
  return across * Eigen::Matrix3d::Identity() + (along - across) * f * f.transpose();
}

/// Of each point the kind with most volume around it, the first of equals.
std::vector<std::uint16_t> kinds_of_points(const ConductingMesh& part,
                                           const std::vector<std::uint16_t>& of_tets, std::size_t kinds) {
  const std::size_t count = part.mesh.points.size();
  std::vector<std::uint16_t> most(count, 0);
  std::vector<double> volume(count, 0), of_kind(count);
  for (std::size_t k = 0; k < kinds; ++k) {
    std::fill(of_kind.begin(), of_kind.end(), 0);
    for (std::size_t t = 0; t < of_tets.size(); ++t)
      if (of_tets[t] == k)
        for (const std::uint32_t point : part.mesh.tets[t])
          of_kind[point] += tet_volume_mm3(corners_of(part.mesh, t));
    for (std::size_t i = 0; i < count; ++i)
      if (of_kind[i] > volume[i]) volume[i] = of_kind[i], most[i] = static_cast<std::uint16_t>(k);
  }
  return most;
}

}  // namespace

Result<ConductingMesh> conducting_mesh(const TetMesh& whole, const Tissue& tissue,
                                       std::optional<double> corrected_for) {
  if (auto error = check(whole, tissue)) return *std::move(error);
  ConductingMesh part;
  const std::vector<bool> conducts = conducting_points(whole, tissue);
  std::vector<std::uint32_t> number(whole.points.size());  // of the points that conduct
  const MortonCurve curve(whole.points);
  for (const std::uint32_t i : curve.order(number.size(), [&](std::size_t at) { return whole.points[at]; })) {
    if (!conducts[i]) continue;
    number[i] = static_cast<std::uint32_t>(part.points.size());
    part.points.push_back(i);
    part.mesh.points.push_back(whole.points[i]);
  }
  std::vector<std::uint16_t> kinds;
  for (std::size_t t = 0; t < whole.tets.size(); ++t) {
    if (tissue.kind[t] == Tissue::kNone) continue;
    Tet tet = whole.tets[t];
    for (std::uint32_t& point : tet) point = number[point];
    part.mesh.tets.push_back(tet);
    part.diffusivity.push_back(diffusivity(whole, tissue, t, corrected_for));
    kinds.push_back(tissue.kind[t]);
  }
  if (part.points.empty())
    return usage_error(
        kMonodomainStage,
        "physics.tissue: found no tetrahedron that conducts, expected tissue with a speed above 0");
  part.kind = kinds_of_points(part, kinds, tissue.kinds.size());
  return part;
}

}  // namespace voxtet
