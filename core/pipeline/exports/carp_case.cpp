#include "pipeline/exports/carp_case.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "io/mesh/write_carp_case.h"
#include "physics/monodomain/activation_log.h"
#include "physics/monodomain/cell.h"
#include "physics/monodomain/membrane_voltage.h"
#include "physics/tissue/conducting_points.h"
#include "physics/tissue/stimulated_points.h"
#include "pipeline/exports/exported_fields.h"
#include "types/stage_names.h"

namespace voxtet {
namespace {

static_assert(kRestingVoltageMv == kRestMv);

using LabelAndKind = std::pair<Label, std::uint16_t>;

/// A region for each label and kind of tissue that tetrahedra have.
Result<std::map<LabelAndKind, Label>> number_regions(const TetMesh& mesh, const Tissue& tissue) {
  std::map<LabelAndKind, Label> regions;
  Label next = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    regions[{mesh.labels[t], tissue.kind[t]}] = mesh.labels[t];
    next = std::max(next, mesh.labels[t]);
  }
  const LabelAndKind* before = nullptr;
  for (auto& [key, region] : regions) {
    if (before && before->first == key.first) {
      if (next == std::numeric_limits<Label>::max())
        return usage_error(kTissueStage,
                           "labels: found label 65535 and labels of several kinds of tissue, expected room "
                           "for the numbers of openCARP's regions above the labels");
      region = ++next;
    }
    before = &key;
  }
  return regions;
}

void add_tissues(const std::map<LabelAndKind, Label>& regions, const Tissue& tissue, CarpCase& out) {
  for (std::size_t k = 0; k < tissue.kinds.size(); ++k) {
    const TissueKind& kind = tissue.kinds[k];
    const double along = kSiemensPerM * diffusivity_of(kind.along_mm_per_ms, kind.cell);
    const double across = kSiemensPerM * diffusivity_of(kind.across_mm_per_ms, kind.cell);
    CarpCase::Tissue added{{}, along, tissue.fibre.empty() ? along : across, kind.cell};
    for (const auto& [key, region] : regions)
      if (key.second == k) added.regions.push_back(region);
    if (!added.regions.empty()) out.tissues.push_back(std::move(added));
  }
  for (const auto& [key, region] : regions)
    if (region != key.first)
      out.notes.push_back("Region " + std::to_string(region) + ": label " + std::to_string(key.first) +
                          (key.second == Tissue::kNone ? ", which does not conduct"
                                                       : " as tissue " + std::to_string(key.second)));
  if (tissue.fibre.empty())
    out.notes.emplace_back("Tissue without fibres: the direction in .lon means nothing, all are alike.");
}

/// S1, S2 and S3 of each stimulus, as far as they begin before the end.
Status add_currents(const std::vector<Stimulus>& stimuli, const TetMesh& mesh,
                    const std::vector<bool>& conducts, CarpCase& out) {
  for (std::size_t i = 0; i < stimuli.size(); ++i) {
    const Stimulus& stimulus = stimuli[i];
    Result<std::vector<std::uint32_t>> points =
        stimulated_points(mesh.points, conducts, stimulus, "physics.stimuli[" + std::to_string(i) + "]");
    if (!points) return points.error();
    out.electrodes.push_back(std::move(points).value());
    CarpCase::Current current{stimulus.name.empty() ? "stimulus " + std::to_string(i) : stimulus.name,
                              i,
                              stimulus.start_ms,
                              stimulus.duration_ms,
                              kVoltageRangeMv * stimulus.strength_per_ms,
                              stimulus.count,
                              stimulus.interval_ms};
    const std::vector<double> starts = start_times_ms(stimulus);
    if (current.start_ms < out.end_ms) out.currents.push_back(current);
    current.count = 1;
    for (auto extra = static_cast<std::size_t>(stimulus.count); extra < starts.size(); ++extra) {
      current.start_ms = starts[extra];
      if (current.start_ms < out.end_ms) out.currents.push_back(current);
    }
  }
  return std::monostate{};
}

std::vector<float> conducting_values(const std::vector<float>& values, const std::vector<bool>& conducts) {
  std::vector<float> kept;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (conducts[i]) kept.push_back(values[i]);
  return kept;
}

Field x_direction(const Tissue& tissue) {
  Field field{std::string(kFibreField), "Direction", "1", On::kTets, Scale::kSequential, 3, {}};
  for (const std::uint16_t kind : tissue.kind)
    field.values.insert(field.values.end(), {kind == Tissue::kNone ? 0.0F : 1.0F, 0, 0});
  return field;
}

/// But for the tissues.
CarpCase begin_case(const MonodomainParams& wave) {
  CarpCase out;
  out.step_ms = wave.step_ms;
  out.end_ms = wave.end_ms;
  out.frame_ms = wave.frame_ms;
  const double consistent = consistent_mass_of(wave);
  out.lumped = consistent < 1;
  if (consistent > 0 && consistent < 1)
    out.notes.emplace_back(
        "Ours was computed with a partly lumped mass matrix, between mass_lumping 0 and 1.");
  if (wave.correct_speed)
    out.notes.emplace_back(
        "Ours was computed with conductivities that were corrected for the mesh, tetrahedron by tetrahedron; "
        "regions cannot say this, and on coarse meshes the two differ.");
  out.rest_mv = kRestMv;
  out.peak_mv = kRestMv + kVoltageRangeMv;
  out.activated_mv = membrane_mv(ActivationLog::kActivated);
  return out;
}

}  // namespace

bool has_wave(const Session& session) {
  return session.is_current(Stage::kTissue) && (session.monodomain() || session.eikonal());
}

Result<std::vector<OutputFile>> carp_case_files(const Session& session, PatientSpace space,
                                                const std::string& name) {
  TetMesh mesh = *session.mesh();
  const Tissue& tissue = session.result<TissueResult>(Stage::kTissue)->tissue;
  const PhysicsParams& physics = *session.recipe().physics;
  const std::vector<bool> conducts = conducting_points(mesh, tissue);
  const Result<std::map<LabelAndKind, Label>> regions = number_regions(mesh, tissue);
  if (!regions) return regions.error();

  CarpCase simulation = begin_case(physics.monodomain.value_or(MonodomainParams{}));
  add_tissues(*regions, tissue, simulation);
  simulation.conductivity_factors = tissue.share;
  if (Status added = add_currents(physics.stimuli, mesh, conducts, simulation); !added) return added.error();
  const Trajectory* found = session.monodomain();
  if (!found) simulation.notes.emplace_back("Ours is the activation by the eikonal equation.");
  simulation.expected_ms = conducting_values(
      found ? find_field(found->fields, "activation_ms")->values : session.eikonal()->fields[0].values,
      conducts);

  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    mesh.labels[t] = regions->at({mesh.labels[t], tissue.kind[t]});
  WriteMeshOptions options = exported_fields(session, MeshFormat::kCarp, false).options;
  options.space = space;
  options.name = name;
  if (tissue.fibre.empty()) options.cell_data.push_back(x_direction(tissue));
  Result<std::vector<OutputFile>> files = write_tet_mesh(mesh, MeshFormat::kCarp, options);
  if (!files) return files;
  std::vector<OutputFile> more = write_carp_case(simulation, name);
  std::move(more.begin(), more.end(), std::back_inserter(*files));
  return files;
}

Result<Field> values_on_mesh(const Session& session, const PointValues& values, std::size_t frame) {
  const std::size_t points = session.mesh()->points.size();
  const auto* found = session.result<TissueResult>(Stage::kTissue);
  std::vector<bool> conducts;
  if (values.count() != points && found) conducts = conducting_points(*session.mesh(), found->tissue);
  const auto conducting = static_cast<std::size_t>(std::count(conducts.begin(), conducts.end(), true));
  if (conducting == 0 || values.count() != conducting) {
    if (Status fits = values.check_count(points); !fits) {
      Error error = fits.error();
      if (conducting > 0)
        error.message += ", or " + std::to_string(conducting) + ", one for each point that conducts";
      return error;
    }
    return values.frame(frame);
  }
  Result<Field> field = values.frame(frame);
  if (!field) return field;
  std::vector<float> spread(points, std::numeric_limits<float>::quiet_NaN());
  std::size_t next = 0;
  for (std::size_t i = 0; i < points; ++i)
    if (conducts[i]) spread[i] = field->values[next++];
  field->values = std::move(spread);
  return field;
}

}  // namespace voxtet
