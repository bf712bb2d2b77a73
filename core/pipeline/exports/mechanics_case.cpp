#include "pipeline/exports/mechanics_case.h"

#include <algorithm>
#include <utility>

#include "physics/mechanics/elements/body.h"
#include "pipeline/exports/exported_fields.h"

namespace voxtet {
namespace {

constexpr const char* kExportStage = "export";
constexpr double kPressureKpa = 1;
constexpr int kSteps = 10;

MechanicsCase default_muscle() {
  const mechanics::TransverselyIsotropic muscle;
  return {muscle.c1_kpa,
          muscle.c2_kpa,
          muscle.a_f_kpa,
          muscle.b_f,
          mechanics::Muscle{}.bulk_kpa,
          kPressureKpa,
          kSteps,
          {},
          {}};
}

/// A surface that a pressure may act on has nothing in front of it.
Status check_free(const TetMesh& mesh, const NamedSet& surface) {
  for (const std::uint32_t face : surface.members)
    if (const auto [behind, front] = mesh.face_sides[face]; front != kBackground)
      return usage_error(kExportStage, surface.name + ": found the meshed labels " + std::to_string(behind) +
                                           " and " + std::to_string(front) +
                                           " on its sides, expected an empty cavity: mesh the wall alone");
  return std::monostate{};
}

}  // namespace

Result<std::vector<OutputFile>> mechanics_case_files(const Session& session, MechanicsProgram program,
                                                     WriteMeshOptions options) {
  const auto* anatomy = session.result<AnatomyResult>(Stage::kAnatomy);
  const auto* fibres = session.result<FibresResult>(Stage::kFibres);
  if (!anatomy || !anatomy->surfaces || !fibres || fibres->fields.empty())
    return usage_error(kExportStage,
                       "a case of mechanics: found no physics.anatomy with physics.fibres, expected both");
  const TetMesh& mesh = *session.mesh();
  Exported exported = exported_fields(session, MeshFormat::kVtu, false);
  options.infos = std::move(exported.options.infos);
  options.surfaces = std::move(exported.options.surfaces);
  options.cell_data = fibres->fields;

  MechanicsCase wanted = default_muscle();
  for (const NamedSet& surface : options.surfaces) {
    if (surface.name == name_of(HeartSurface::kBase)) wanted.held = surface.name;
    if (surface.name != name_of(HeartSurface::kLvEndocardium) &&
        surface.name != name_of(HeartSurface::kRvEndocardium) &&
        surface.name != name_of(HeartSurface::kRvSeptum))
      continue;
    if (Status free = check_free(mesh, surface); !free) return free.error();
    wanted.loaded.push_back(surface.name);
  }
  if (wanted.held.empty())
    return usage_error(kExportStage,
                       "a case of mechanics: found no surface named base, expected one to hold");
  return write_mechanics_case(mesh, wanted, program, options);
}

}  // namespace voxtet
