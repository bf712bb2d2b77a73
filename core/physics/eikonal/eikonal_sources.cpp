#include "physics/eikonal/eikonal_sources.h"

#include <string>

#include "physics/tissue/conducting_points.h"
#include "physics/tissue/stimulated_points.h"
#include "types/stage_names.h"

namespace voxtet {

Result<std::vector<EikonalSource>> eikonal_sources(const TetMesh& mesh, const Tissue& tissue,
                                                   const std::vector<Stimulus>& stimuli) {
  if (stimuli.empty())
    return usage_error(kEikonalStage,
                       "physics.stimuli: found none, expected at least one, where the wave starts");
  const std::vector<bool> conducts = conducting_points(mesh, tissue);
  std::vector<EikonalSource> sources;
  for (std::size_t s = 0; s < stimuli.size(); ++s) {
    const auto points =
        stimulated_points(mesh.points, conducts, stimuli[s], "physics.stimuli[" + std::to_string(s) + "]");
    if (!points) return points.error();
    for (const std::uint32_t point : *points) sources.push_back({point, stimuli[s].start_ms});
  }
  return sources;
}

}  // namespace voxtet
