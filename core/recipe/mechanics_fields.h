// The fields of the recipe's group `physics.mechanics`: a part of the table in recipe/fields.h.
#pragma once

#include "physics/beat/beat_params.h"
#include "recipe/field_info.h"

namespace voxtet {

template <class V>
void visit_fields(V& v, mechanics::TransverselyIsotropic& p) {
  v.field({"c1_kpa", "kPa", 0, 1e6, "c1 of c1 (I1 - 3) + c2 (I2 - 3), all around."}, p.c1_kpa);
  v.field({"c2_kpa", "kPa", 0, 1e6, "c2 of the same."}, p.c2_kpa);
  v.field({"a_f_kpa", "kPa", 0, 1e6, "Stiffness of stretched fibres."}, p.a_f_kpa);
  v.field({"b_f", "", 1e-6, 1000, "How fast fibres stiffen."}, p.b_f);
}

template <class V>
void visit_fields(V& v, mechanics::HolzapfelOgden& p) {
  v.field({"a_kpa", "kPa", 0, 1e6, "Stiffness all around."}, p.a_kpa);
  v.field({"b", "", 1e-6, 1000, "How fast it stiffens."}, p.b);
  v.field({"a_f_kpa", "kPa", 0, 1e6, "Stiffness along fibres."}, p.a_f_kpa);
  v.field({"b_f", "", 1e-6, 1000, "How fast they stiffen."}, p.b_f);
  v.field({"a_s_kpa", "kPa", 0, 1e6, "Stiffness along sheets."}, p.a_s_kpa);
  v.field({"b_s", "", 1e-6, 1000, "How fast they stiffen."}, p.b_s);
  v.field({"a_fs_kpa", "kPa", 0, 1e6, "Stiffness against shear of fibres and sheets."}, p.a_fs_kpa);
  v.field({"b_fs", "", 1e-6, 1000, "How fast that stiffens."}, p.b_fs);
  v.field({"k", "", 1e-3, 1e4, "How sharply fibres and sheets slacken when they are pressed."}, p.k);
}

template <class V>
void visit_fields(V& v, mechanics::Guccione& p) {
  v.field({"c_kpa", "kPa", 0, 1e6, "Stiffness."}, p.c_kpa);
  v.field({"b_f", "", 1e-6, 1000, "Exponent along fibres."}, p.b_f);
  v.field({"b_t", "", 1e-6, 1000, "Exponent across fibres."}, p.b_t);
  v.field({"b_fs", "", 1e-6, 1000, "Exponent of shears of fibres."}, p.b_fs);
}

template <class V>
void visit_fields(V& v, mechanics::MooneyRivlin& p) {
  v.field({"c1_kpa", "kPa", 0, 1e6, "c1 of c1 (I1 - 3) + c2 (I2 - 3)."}, p.c1_kpa);
  v.field({"c2_kpa", "kPa", 0, 1e6, "c2 of the same; 0: neo-Hookean."}, p.c2_kpa);
}

template <class V>
void visit_fields(V& v, mechanics::Corotational& p) {
  v.field({"shear_across_kpa", "kPa", 0, 1e6, "Shear modulus across fibres."}, p.shear_across_kpa);
  v.field({"shear_along_kpa", "kPa", 0, 1e6, "Shear modulus along them."}, p.shear_along_kpa);
  v.field({"fibre_kpa", "kPa", 0, 1e6, "What fibres add to the stiffness along them."}, p.fibre_kpa);
}

template <class V>
void visit_fields(V& v, MuscleMaterial& p) {
  v.optional_group({"transversely_isotropic", "", 0, 0, "Isotropic, with fibres that resist stretch."},
                   p.transversely_isotropic);
  v.optional_group({"holzapfel_ogden", "", 0, 0, "Holzapfel and Ogden 2009."}, p.holzapfel_ogden);
  v.optional_group({"guccione", "", 0, 0, "Guccione 1991."}, p.guccione);
  v.optional_group({"mooney_rivlin", "", 0, 0, "Mooney-Rivlin, the same in all directions."},
                   p.mooney_rivlin);
  v.optional_group({"corotational", "", 0, 0, "Linear elasticity in a frame that turns with the body."},
                   p.corotational);
}

template <class V>
void visit_fields(V& v, MuscleLabels& p) {
  v.field({"labels", "", 1, 65535, "Labels of the wall that are another muscle."}, p.labels);
  v.field({"stiffness", "", 1e-3, 1e4, "Factor of the material's stresses."}, p.stiffness);
  v.field({"contractility", "", 0, 100, "Factor of the active stress; 0: none, as in a scar."},
          p.contractility);
}

template <class V>
void visit_fields(V& v, ActiveStressLaw& p) {
  v.field({"peak_kpa", "kPa", 0, 1e6, "Stress to which the muscle would come in the end."}, p.peak_kpa);
  v.field({"rise_per_s", "1/s", 1e-3, 1e4, "How fast it comes."}, p.rise_per_s);
  v.field({"fall_per_s", "1/s", 1e-3, 1e4, "How fast it goes."}, p.fall_per_s);
  v.field({"switch_ms", "ms", 0, 1000, "How long switching takes; 0: none."}, p.switch_ms);
}

template <class V>
void visit_fields(V& v, ContractionParams& p) {
  v.choice({"preset", "", 0, 0, "Published active stress: fast, ambit or elastodynamics."}, p.preset,
           Choices<ActiveStressPresetName>{{"fast", ActiveStressPresetName::kFast},
                                           {"ambit", ActiveStressPresetName::kAmbit},
                                           {"elastodynamics", ActiveStressPresetName::kElastodynamics}});
  v.optional_group({"lv", "", 0, 0, "Active stress of the left ventricle, instead of the preset's."}, p.lv);
  v.optional_group({"rv", "", 0, 0, "Active stress of the right ventricle's free wall."}, p.rv);
  v.choice(
      {"by", "", 0, 0,
       "What activates a place: the eikonal map, the first wave of the monodomain model, or nothing but time "
       "(synchronous)."},
      p.by,
      Choices<ActivationBy>{{"eikonal", ActivationBy::kEikonal},
                            {"monodomain", ActivationBy::kMonodomain},
                            {"synchronous", ActivationBy::kSynchronous}});
  v.field({"start_ms", "ms", 0, 1e5, "Time of the beat at which that map begins."}, p.start_ms);
  v.field({"duration_ms", "ms", 1, 1e5, "From activation to recovery, where the map does not say it."},
          p.duration_ms);
}

template <class V>
void visit_fields(V& v, SupportParams& p) {
  v.field({"epicardium_kpa_per_mm", "kPa/mm", 0, 1e4, "Springs on the epicardium, along its normal."},
          p.epicardium_kpa_per_mm);
  v.field({"base_kpa_per_mm", "kPa/mm", 0, 1e4, "Springs on the base, in all directions."},
          p.base_kpa_per_mm);
  v.field({"damping_kpa_s_per_mm", "kPa s/mm", 0, 1e4, "Dampers beside both."}, p.damping_kpa_s_per_mm);
}

template <class V>
void visit_fields(V& v, VentricleLoad& p) {
  v.field({"resistance_kpa_s_per_ml", "kPa s/ml", 1e-6, 1e3, "Resistance of the vessels."},
          p.arteries.resistance_kpa_s_per_ml);
  v.field({"compliance_ml_per_kpa", "ml/kPa", 1e-6, 1e4, "Compliance of the arteries."},
          p.arteries.compliance_ml_per_kpa);
  v.field({"impedance_kpa_s_per_ml", "kPa s/ml", 0, 1e3, "Impedance of the great artery."},
          p.arteries.impedance_kpa_s_per_ml);
  v.field({"venous_kpa", "kPa", -10, 100, "Pressure into which the vessels drain."}, p.arteries.venous_kpa);
  v.field({"atrium_kpa", "kPa", 0, 100, "Pressure of the atrium at rest."}, p.atrium.rest_kpa);
  v.field({"kick_kpa", "kPa", 0, 100, "Pressure at the height of its contraction."}, p.atrium.kick_kpa);
  v.field({"kick_start_s", "s", 0, 100, "When it contracts in each beat."}, p.atrium.start_s);
  v.field({"kick_s", "s", 1e-3, 100, "How long it does."}, p.atrium.duration_s);
}

template <class V>
void visit_fields(V& v, WindkesselParams& p) {
  v.group({"systemic", "", 0, 0, "What the left ventricle fills from and ejects into."}, p.systemic);
  v.group({"pulmonary", "", 0, 0, "The same of the right ventricle."}, p.pulmonary);
  v.field({"systemic_start_kpa", "kPa", 0, 100, "Pressure in the arteries as the first beat begins."},
          p.systemic_start_kpa);
  v.field({"pulmonary_start_kpa", "kPa", 0, 100, "The same of the lung's."}, p.pulmonary_start_kpa);
  v.field({"regurgitation", "", 0, 1, "Share of its conductance with which the pulmonary valve leaks."},
          p.regurgitation);
}

template <class V>
void visit_fields(V& v, Vessels& p) {
  v.field({"resistance_kpa_s_per_ml", "kPa s/ml", 1e-7, 1e3, "Resistance."}, p.resistance_kpa_s_per_ml);
  v.field({"compliance_ml_per_kpa", "ml/kPa", 1e-6, 1e5, "Compliance."}, p.compliance_ml_per_kpa);
  v.field({"inertance_kpa_s2_per_ml", "kPa s2/ml", 1e-9, 1e3, "Inertance."}, p.inertance_kpa_s2_per_ml);
}

template <class V>
void visit_fields(V& v, Elastance& p) {
  v.field({"active_kpa_per_ml", "kPa/ml", 0, 1e3, "Elastance that contraction adds."}, p.active_kpa_per_ml);
  v.field({"passive_kpa_per_ml", "kPa/ml", 1e-6, 1e3, "Elastance at rest."}, p.passive_kpa_per_ml);
  v.field({"unloaded_ml", "ml", -1e4, 1e4, "Volume without pressure."}, p.unloaded_ml);
  v.field({"start_s", "s", 0, 100, "When it contracts in each beat."}, p.start_s);
  v.field({"contraction_s", "s", 1e-3, 100, "How long it contracts."}, p.contraction_s);
  v.field({"relaxation_s", "s", 1e-3, 100, "How long it relaxes."}, p.relaxation_s);
}

template <class V>
void visit_fields(V& v, LoopParams& p) {
  v.group({"left_atrium", "", 0, 0, "Left atrium."}, p.left_atrium);
  v.group({"right_atrium", "", 0, 0, "Right atrium."}, p.right_atrium);
  v.group({"systemic_arteries", "", 0, 0, "Systemic arteries."}, p.systemic_arteries);
  v.group({"systemic_veins", "", 0, 0, "Systemic veins."}, p.systemic_veins);
  v.group({"pulmonary_arteries", "", 0, 0, "Pulmonary arteries."}, p.pulmonary_arteries);
  v.group({"pulmonary_veins", "", 0, 0, "Pulmonary veins."}, p.pulmonary_veins);
  v.field({"regurgitation", "", 0, 1, "Share of its conductance with which the pulmonary valve leaks."},
          p.regurgitation);
}

template <class V>
void visit_fields(V& v, BeatParams& p) {
  v.choice(
      {"element", "", 0, 0,
       "Elements: p1_anp, linear with pressures averaged at points; p1_stabilised, linear with stabilised "
       "pressures; p1, which locks; p2, quadratic."},
      p.element,
      Choices<mechanics::Formulation>{{"p1_anp", mechanics::Formulation::kAverageNodalPressure},
                                      {"p1_stabilised", mechanics::Formulation::kStabilised},
                                      {"p1", mechanics::Formulation::kLinear},
                                      {"p2", mechanics::Formulation::kQuadratic}});
  v.field({"fine_fibres", "", 0, 0,
           "Fibres at four places of each tetrahedron, not at its centroid alone; needs physics.fibres."},
          p.fine_fibres);
  v.group({"material", "", 0, 0, "The passive muscle; none given: transversely isotropic."}, p.material);
  v.list({"labels", "", 0, 0, "Where muscle is stiffer or contracts less than elsewhere."}, p.labels);
  v.field({"bulk_kpa", "kPa", 1, 1e7, "Resistance to a change of volume."}, p.bulk_kpa);
  v.field({"viscosity_kpa_s", "kPa s", 0, 1e4, "Resistance to the rate of strain."}, p.viscosity_kpa_s);
  v.field({"density_kg_per_m3", "kg/m3", 0, 1e5, "Density."}, p.density_kg_per_m3);
  v.group({"contraction", "", 0, 0, "When and how strongly muscle contracts."}, p.contraction);
  v.group({"support", "", 0, 0, "What holds the heart from outside."}, p.support);
  v.group({"windkessel", "", 0, 0, "The open circulation: atria of given pressure, and Windkessels."},
          p.windkessel);
  v.optional_group({"closed_loop", "", 0, 0, "The closed loop of both circulations, instead."},
                   p.closed_loop);
  v.field({"period_ms", "ms", 100, 1e5, "Length of a beat."}, p.period_ms);
  v.field({"beats", "", 1, 1000, "Beats at most."}, p.beats);
  v.field(
      {"cycle_percent", "%", 0, 100,
       "Ends sooner where no ventricle's volume at the end of a beat differs by more from the one before; 0: "
       "never."},
      p.cycle_percent);
  v.field({"fill_ms", "ms", 1, 1e5, "Before the first beat, pressures rise from 0 to those of the atria."},
          p.fill_ms);
  v.field({"step_ms", "ms", 0.01, 50, "The longest time step; halved where that is too long."}, p.step_ms);
  v.field({"frame_ms", "ms", 0.01, 1e5, "Time between two frames."}, p.frame_ms);
}

}  // namespace voxtet
