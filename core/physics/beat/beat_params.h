// What a beating heart is made of, what drives it and what it works against.
#pragma once

#include <optional>
#include <vector>

#include "physics/active/active_stress.h"
#include "physics/circulation/closed_loop.h"
#include "physics/circulation/windkessel.h"
#include "physics/mechanics/elements/nodes.h"
#include "physics/mechanics/materials/material.h"
#include "types/result.h"
#include "types/surface_mesh.h"

namespace voxtet {

/// What the wall is made of. At most one is given; none: TransverselyIsotropic as it is.
struct MuscleMaterial {
  std::optional<mechanics::TransverselyIsotropic> transversely_isotropic;
  std::optional<mechanics::HolzapfelOgden> holzapfel_ogden;
  std::optional<mechanics::Guccione> guccione;
  std::optional<mechanics::MooneyRivlin> mooney_rivlin;
  std::optional<mechanics::Corotational> corotational;

  mechanics::Material chosen() const;
};

/// Where the wall is another one than elsewhere, as in a scar.
struct MuscleLabels {
  std::vector<Label> labels;
  double stiffness = 1;      ///< multiplies the stresses of the material
  double contractility = 1;  ///< multiplies the active stress
};

/// Where the time comes from at which a place is activated.
enum class ActivationBy {
  kEikonal,      ///< the map of activation
  kMonodomain,   ///< the first wave that was simulated, with its recovery where that was seen
  kSynchronous,  ///< all at once
};

/// When and how strongly muscle contracts.
struct ContractionParams {
  ActiveStressPresetName preset = ActiveStressPresetName::kFast;
  std::optional<ActiveStressLaw> lv, rv;  ///< instead of the preset's
  ActivationBy by = ActivationBy::kEikonal;
  double start_ms = 150;     ///< time 0 of the map within each beat, or when all contracts
  double duration_ms = 250;  ///< from a place's activation to its recovery
};

/// Springs and dampers around the heart, by undeformed area.
struct SupportParams {
  double epicardium_kpa_per_mm = 0.01;  ///< along the epicardium's normal, as the pericardium's
  double base_kpa_per_mm = 1;           ///< in all directions, on the base
  double damping_kpa_s_per_mm = 5e-3;   ///< on both, in the directions of the springs
};

/// The open circulation: each ventricle between an atrium of given pressure and a Windkessel.
struct WindkesselParams {
  VentricleLoad systemic = systemic_load(), pulmonary = pulmonary_load();
  double systemic_start_kpa = 10, pulmonary_start_kpa = 2;  ///< in the Windkessels, at the first beat's start
  double regurgitation = 0;  ///< what the pulmonary valve lets back, of its conductance when open
};

/// The closed loop of both circulations; its period is that of the beats.
struct LoopParams : ClosedLoopParams {
  LoopParams();  ///< that of regazzoni_heart(), with atria that contract as a beat begins
  double regurgitation = 0;
};

/// Lengths in mm, pressures in kPa. Fields of the recipe's physics.mechanics.
struct BeatParams {
  mechanics::Formulation element = mechanics::Formulation::kAverageNodalPressure;
  bool fine_fibres =
      false;  ///< linear elements have fibres at four places, not at one; quadratic ones do too
  MuscleMaterial material;
  std::vector<MuscleLabels> labels;
  double bulk_kpa = 1000;
  double viscosity_kpa_s = 0.1;
  double density_kg_per_m3 = 1000;
  ContractionParams contraction;
  SupportParams support;
  WindkesselParams windkessel;
  std::optional<LoopParams> closed_loop;  ///< instead of `windkessel`
  double period_ms = 800;
  int beats = 5;             ///< at most
  double cycle_percent = 1;  ///< ends where no volume at the end of two beats differs by more; 0: never
  double fill_ms = 300;      ///< in which pressures rise from 0 to those of the atria, before the first beat
  double step_ms = 5;        ///< the longest
  double frame_ms = 10;
};

/// Returns kUsage, naming the field of physics.mechanics, for what no heart can have.
Status check_beat_params(const BeatParams& params);

}  // namespace voxtet
