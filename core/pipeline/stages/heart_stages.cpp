#include "pipeline/stages/heart_stages.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "geometry/elements/tet_measures.h"
#include "physics/eikonal/eikonal_sources.h"
#include "physics/monodomain/speed_error.h"
#include "physics/tissue/make_tissue.h"
#include "physics/ventricles/ventricular_coordinates.h"
#include "physics/ventricles/ventricular_fibres.h"
#include "pipeline/results/stage_results.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

Field tet_vectors(const char* name, const char* title, const std::vector<Eigen::Vector3d>& vectors) {
  Field field{name, title, "1", On::kTets, Scale::kSequential, 3, {}};
  field.values.reserve(3 * vectors.size());
  for (const Eigen::Vector3d& v : vectors)
    for (int d = 0; d < 3; ++d) field.values.push_back(static_cast<float>(v[d]));
  return field;
}

/// The labels of the mesh that are no blood pools.
std::vector<Label> wall_labels(const TetMesh& mesh, const AnatomyParams& params) {
  std::set<Label> labels(mesh.labels.begin(), mesh.labels.end());
  for (const auto* pool : {&params.lv_pool, &params.rv_pool})
    for (const Label label : *pool) labels.erase(label);
  return {labels.begin(), labels.end()};
}

/// Equations on flat or empty tetrahedra have no solution; ours have none, but others' may.
Status check_volumes(const TetMesh& mesh, const char* stage) {
  ErrorPlace where;
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.tets[t];
    if (!(tet_volume_mm3({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]}) > 0))
      where.elements.push_back(t);
  }
  if (where.elements.empty()) return std::monostate{};
  where.stage = kOptimiseStage;
  where.on = On::kTets;
  return Error{ErrorCode::kBadInput, stage,
               "source.file: found " + std::to_string(where.elements.size()) +
                   " tetrahedra without volume, the first is number " +
                   std::to_string(where.elements.front()) +
                   ", expected none: nothing can be simulated on them",
               std::move(where)};
}

/// The image without what planes of volume.cut took away, where a mesh was made of it.
std::shared_ptr<const LabelVolume> image_of(const VolumeResult& volume, const Recipe& recipe) {
  CutPlanes given = volume.prepared.cuts;
  std::erase_if(given, [](const CutPlane& cut) { return !cut.is_given(); });
  if (given.empty()) return volume.source;
  for (CutPlane& cut : given)
    for (const LabelGroup& group : recipe.merge)
      if (cut.cuts(*std::min_element(group.begin(), group.end())))
        cut.labels.insert(cut.labels.end(), group.begin(), group.end());
  return std::make_shared<const LabelVolume>(without_cut(*volume.source, given));
}

}  // namespace

Status run_anatomy(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  AnatomyResult result;
  if (recipe.physics && recipe.physics->anatomy) {
    const TetMesh& mesh = in.get<TetMesh>(Stage::kOptimise);
    if (Status valid = check_volumes(mesh, kAnatomyStage); !valid) return valid;
    AnatomyParams params = *recipe.physics->anatomy;
    if (params.wall.empty()) params.wall = wall_labels(mesh, params);
    RunContext first = ctx.part(0, 0.4), second = ctx.part(0.4, 0.8), third = ctx.part(0.8, 1);
    Result<HeartSurfaces> surfaces =
        find_heart_surfaces(mesh, *image_of(in.get<VolumeResult>(Stage::kVolume), recipe), params, first);
    if (!surfaces) return surfaces.error();
    Result<VentricularPotentials> potentials = ventricular_potentials(mesh, *surfaces, second);
    if (!potentials) return potentials.error();
    Result<std::vector<Field>> coordinates = ventricular_coordinates(mesh, *surfaces, *potentials, third);
    if (!coordinates) return coordinates.error();
    result = {std::move(surfaces).value(), std::move(potentials).value(), std::move(coordinates).value()};
  }
  out.put(std::move(result));
  return std::monostate{};
}

Status run_fibres(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  FibresResult result;
  const bool asked = recipe.physics && recipe.physics->fibres;
  const OpenedMesh* opened = opened_mesh(recipe, in.files);
  if (!asked && opened && !opened->fibres.fibre.empty()) {
    result.fibres = fibres_of_labels(*opened, recipe.labels);
    result.fields = {tet_vectors("fibre", "Fibre", result.fibres.fibre)};
    if (!result.fibres.sheet.empty())
      result.fields.push_back(tet_vectors("sheet", "Sheet", result.fibres.sheet));
  }
  if (asked) {
    const AnatomyResult& anatomy = in.get<AnatomyResult>(Stage::kAnatomy);
    if (!anatomy.surfaces)
      return usage_error(
          kFibresStage,
          "physics.fibres: found no physics.anatomy beside it, expected one: fibres follow the "
          "ventricles' surfaces");
    const TetMesh& mesh = in.get<TetMesh>(Stage::kOptimise);
    Result<Fibres> fibres =
        tet_fibres(mesh, *anatomy.surfaces, anatomy.potentials, *recipe.physics->fibres, ctx);
    if (!fibres) return fibres.error();
    result.fibres = std::move(fibres).value();
    result.fields = {tet_vectors("fibre", "Fibre", result.fibres.fibre),
                     tet_vectors("sheet", "Sheet", result.fibres.sheet)};
  }
  out.put(std::move(result));
  return std::monostate{};
}

Status run_tissue(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext&) {
  const TetMesh& mesh = in.get<TetMesh>(Stage::kOptimise);
  if (Status valid = check_volumes(mesh, kTissueStage); !valid) return valid;
  Result<Tissue> tissue = make_tissue(mesh, in.get<LabelTransfer>(Stage::kTransfer),
                                      recipe.physics ? recipe.physics->tissue : TissueParams{});
  if (!tissue) return tissue.error();
  tissue->fibre = in.get<FibresResult>(Stage::kFibres).fibres.fibre;
  std::size_t without = 0;
  for (std::size_t t = 0; t < tissue->fibre.size(); ++t)
    if (tissue->kind[t] != Tissue::kNone && tissue->fibre[t].isZero(0)) ++without;
  if (without > 0)
    return usage_error(kTissueStage,
                       "physics.tissue: found " + std::to_string(without) +
                           " conducting tetrahedra without a fibre, expected one for each: all labels that "
                           "conduct in physics.anatomy.wall, or in the mesh's .lon");
  const bool asked = recipe.physics && recipe.physics->monodomain;
  const MonodomainParams wave = asked ? *recipe.physics->monodomain : MonodomainParams{};
  Field error{"speed_error_percent",
              "Error of the wave's speed to be expected",
              "%",
              On::kTets,
              Scale::kDiverging,
              1,
              speed_errors_percent(mesh, *tissue, consistent_mass_of(wave), wave.correct_speed)};
  out.put(TissueResult{std::move(tissue).value(), {std::move(error)}});
  return std::monostate{};
}

Status run_eikonal(const StageInputs& in, const Recipe& recipe, StageOutput& out, RunContext& ctx) {
  const TetMesh& mesh = in.get<TetMesh>(Stage::kOptimise);
  const Tissue& tissue = in.get<TissueResult>(Stage::kTissue).tissue;
  const std::vector<Stimulus> stimuli = recipe.physics ? recipe.physics->stimuli : std::vector<Stimulus>{};
  Result<std::vector<EikonalSource>> sources = eikonal_sources(mesh, tissue, stimuli);
  if (!sources) return sources.error();
  Result<std::vector<double>> times = solve_eikonal(mesh, tissue, *sources, ctx);
  if (!times) return times.error();
  Field field{"eikonal_ms", "Activation time, eikonal", "ms", On::kPoints, Scale::kSequential, 1, {}};
  field.values.assign(times->begin(), times->end());
  out.put(EikonalResult{{std::move(field)}});
  return std::monostate{};
}

}  // namespace voxtet
