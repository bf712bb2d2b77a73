#include "pipeline/exports/mechanics_case.h"

#include <utility>
#include <variant>

#include "physics/beat/beat_params.h"
#include "pipeline/exports/exported_fields.h"

namespace voxtet {
namespace {

constexpr const char* kExportStage = "export";
constexpr double kPressureKpa = 1;
constexpr int kSteps = 10;

/// That of physics.mechanics, or its default.
Result<MechanicsCase> muscle_of(const PhysicsParams& physics) {
  const BeatParams params = physics.mechanics.value_or(BeatParams{});
  const mechanics::Material material = params.material.chosen();
  MechanicsCase out;
  const auto set = [&](double c1, double c2, double a, double b) {
    out.c1_kpa = c1;
    out.c2_kpa = c2;
    out.a_kpa = a;
    out.b = b;
  };
  if (const auto* muscle = std::get_if<mechanics::TransverselyIsotropic>(&material))
    set(muscle->c1_kpa, muscle->c2_kpa, muscle->a_f_kpa, muscle->b_f);
  else if (const auto* plain = std::get_if<mechanics::MooneyRivlin>(&material))
    set(plain->c1_kpa, plain->c2_kpa, 0, 1);
  else
    return usage_error(kExportStage,
                       "physics.mechanics.material: found one that a case of mechanics is not written with, "
                       "expected transversely_isotropic or mooney_rivlin");
  out.bulk_kpa = params.bulk_kpa;
  out.pressure_kpa = kPressureKpa;
  out.steps = kSteps;
  for (const MuscleLabels& other : params.labels)
    for (const Label label : other.labels)
      if (other.stiffness != 1)
        out.notes.push_back("label " + std::to_string(label) +
                            " is as stiff as the others, and has a factor of its own in voxtet");
  return out;
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

  Result<MechanicsCase> muscle = muscle_of(*session.recipe().physics);
  if (!muscle) return muscle.error();
  MechanicsCase wanted = *std::move(muscle);
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
