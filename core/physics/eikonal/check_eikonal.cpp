#include "physics/eikonal/check_eikonal.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "physics/tissue/conducting_points.h"
#include "types/stage_names.h"

namespace voxtet::eikonal {
namespace {

/// Room for the rounding of a unit vector that was stored with few digits.
constexpr double kUnitTolerance = 1e-3;

template <class... Parts>
std::string text_of(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

template <class... Parts>
Error usage(const Parts&... parts) {
  return usage_error(kEikonalStage, text_of(parts...));
}

Error at_tet(const TetMesh& mesh, std::size_t t, Error error) {
  error.where = {{mesh.points[mesh.tets[t][0]]}, {static_cast<std::uint32_t>(t)}, "", On::kTets};
  return error;
}

std::optional<Error> check_count(const char* list, std::size_t found, const TetMesh& mesh) {
  if (found == mesh.tets.size()) return std::nullopt;
  return Error{ErrorCode::kInternal,
               kEikonalStage,
               text_of("physics.tissue.", list, ": found ", found, " entries, expected one for each of ",
                       mesh.tets.size(), " tetrahedra"),
               {}};
}

std::optional<Error> check_counts(const TetMesh& mesh, const Tissue& tissue) {
  if (auto error = check_count("kind", tissue.kind.size(), mesh)) return error;
  if (!tissue.share.empty())
    if (auto error = check_count("share", tissue.share.size(), mesh)) return error;
  if (!tissue.fibre.empty())
    if (auto error = check_count("fibre", tissue.fibre.size(), mesh)) return error;
  for (std::size_t t = 0; t < tissue.kind.size(); ++t)
    if (tissue.kind[t] != Tissue::kNone && tissue.kind[t] >= tissue.kinds.size())
      return at_tet(mesh, t,
                    {ErrorCode::kInternal,
                     kEikonalStage,
                     text_of("physics.tissue.kind of tetrahedron ", t, ": found ", tissue.kind[t],
                             ", expected less than the number of kinds, ", tissue.kinds.size()),
                     {}});
  return std::nullopt;
}

std::optional<Error> check_kinds(const Tissue& tissue) {
  for (std::size_t k = 0; k < tissue.kinds.size(); ++k) {
    const TissueKind& kind = tissue.kinds[k];
    for (const auto& [field, speed] :
         {std::pair{"along", kind.along_mm_per_ms}, std::pair{"across", kind.across_mm_per_ms}})
      if (!(std::isfinite(speed) && speed > 0))
        return usage("physics.tissue.kinds[", k, "].", field, "_mm_per_ms: found ", speed,
                     ", expected a finite number > 0 mm/ms");
  }
  return std::nullopt;
}

std::optional<Error> check_shares_and_fibres(const TetMesh& mesh, const Tissue& tissue) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (tissue.kind[t] == Tissue::kNone) continue;
    if (!tissue.share.empty() && !(tissue.share[t] > 0 && tissue.share[t] <= 1))
      return at_tet(mesh, t,
                    usage("physics.tissue.share of tetrahedron ", t, ": found ", tissue.share[t],
                          ", expected more than 0, at most 1"));
    const TissueKind& kind = tissue.kinds[tissue.kind[t]];
    if (tissue.fibre.empty() || kind.along_mm_per_ms == kind.across_mm_per_ms) continue;
    if (!(std::abs(tissue.fibre[t].norm() - 1) <= kUnitTolerance))
      return at_tet(mesh, t,
                    usage("physics.tissue.fibre of tetrahedron ", t, ": found a length of ",
                          tissue.fibre[t].norm(), ", expected 1"));
  }
  return std::nullopt;
}

std::optional<Error> check_sources(const std::vector<bool>& conducts,
                                   std::span<const EikonalSource> sources) {
  if (sources.empty()) return usage("physics.eikonal.sources: found none, expected at least one");
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const auto [point, time_ms] = sources[s];
    if (point >= conducts.size())
      return usage("physics.eikonal.sources[", s, "].point: found ", point, ", expected less than ",
                   conducts.size(), ", the number of points of the mesh");
    if (!conducts[point])
      return usage("physics.eikonal.sources[", s, "].point: found ", point,
                   ", which touches no tetrahedron that conducts, expected one that does");
    if (!std::isfinite(time_ms))
      return usage("physics.eikonal.sources[", s, "].time_ms: found ", time_ms, ", expected a finite number");
  }
  return std::nullopt;
}

}  // namespace

std::optional<Error> check_input(const TetMesh& mesh, const Tissue& tissue,
                                 std::span<const EikonalSource> sources) {
  if (auto error = check_counts(mesh, tissue)) return error;
  if (auto error = check_kinds(tissue)) return error;
  if (auto error = check_shares_and_fibres(mesh, tissue)) return error;
  const std::vector<bool> conducts = conducting_points(mesh, tissue);
  if (std::find(conducts.begin(), conducts.end(), true) == conducts.end())
    return usage("physics.tissue.kind: found no tetrahedron that conducts, expected at least one");
  return check_sources(conducts, sources);
}

}  // namespace voxtet::eikonal
