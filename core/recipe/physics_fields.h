// The fields of the recipe's group `physics`: a part of the table in recipe/fields.h.
#pragma once

#include "recipe/field_info.h"
#include "recipe/mechanics_fields.h"
#include "recipe/recipe.h"

namespace voxtet {

template <class V>
void visit_fields(V& v, AnatomyParams& p) {
  v.field(
      {"wall", "", 1, 65535, "Meshed labels of the ventricles' wall, with scar; none: all but the pools."},
      p.wall);
  v.field({"lv_pool", "", 1, 65535,
           "Labels of the left cavity, meshed or not; none: found as a cavity of the wall."},
          p.lv_pool);
  v.field({"rv_pool", "", 1, 65535, "Labels of the right cavity."}, p.rv_pool);
}

template <class V>
void visit_fields(V& v, FibreAngles& p) {
  v.field({"alpha_endo_deg", "deg", -180, 180, "Helix angle at the endocardium."}, p.alpha_endo);
  v.field({"alpha_epi_deg", "deg", -180, 180, "Helix angle at the epicardium."}, p.alpha_epi);
  v.field({"beta_endo_deg", "deg", -180, 180, "Sheet angle at the endocardium."}, p.beta_endo);
  v.field({"beta_epi_deg", "deg", -180, 180, "Sheet angle at the epicardium."}, p.beta_epi);
}

template <class V>
void visit_fields(V& v, FibreParams& p) {
  v.choice({"rule", "", 0, 0, "linear: angles linear in the depth of the wall; bayer: as published in 2012."},
           p.rule, Choices<FibreRule>{{"linear", FibreRule::kLinear}, {"bayer", FibreRule::kBayer}});
  visit_fields(v, p.wall);
  v.optional_group({"septum", "", 0, 0, "Angles of the septum, from its left to its right side."}, p.septum);
}

template <class V>
void visit_fields(V& v, TissueLabels& p) {
  v.field({"labels", "", 1, 65535, "Labels that are this kind of tissue."}, p.labels);
  v.field({"along_mm_per_ms", "mm/ms", 0.01, 10, "Speed of a plane wave along the fibres, in rested tissue."},
          p.along_mm_per_ms);
  v.field({"across_mm_per_ms", "mm/ms", 0.01, 10, "Speed across the fibres; counts where there are fibres."},
          p.across_mm_per_ms);
  v.choice({"cell", "", 0, 0,
            "Mitchell and Schaeffer's cell, or that of Corrado and Niederer, which never paces itself."},
           p.cell.modified, Choices<bool>{{"ms", false}, {"mms", true}});
  v.field({"tau_in_ms", "ms", 0.2, 10, "Time of the inward current: how fast cells depolarise."},
          p.cell.tau_in_ms);
  v.field({"tau_out_ms", "ms", 0.2, 100, "Time of the outward current; more than four times tau_in_ms."},
          p.cell.tau_out_ms);
  v.field({"tau_open_ms", "ms", 1, 10000, "Time in which the gate opens again: how fast cells recover."},
          p.cell.tau_open_ms);
  v.field(
      {"tau_close_ms", "ms", 1, 10000, "Time in which the gate closes: how long an action potential lasts."},
      p.cell.tau_close_ms);
  v.field({"gate", "", 0.01, 0.45, "Voltage, as a part of its range, at which the gate turns."}, p.cell.gate);
}

template <class V>
void visit_fields(V& v, TissueParams& p) {
  v.choice({"by", "", 0, 0,
            "Where a tetrahedron's label comes from: the mesh, or labels transferred to it by centroid, "
            "majority or as "
            "fractions."},
           p.by,
           Choices<TissueBy>{{"mesh", TissueBy::kMesh},
                             {"centroid", TissueBy::kCentroid},
                             {"majority", TissueBy::kMajority},
                             {"fraction", TissueBy::kFraction}});
  v.list({"kinds", "", 0, 0, "Kinds of tissue; labels without an entry do not conduct."}, p.kinds);
}

template <class V>
void visit_fields(V& v, Stimulus& p) {
  v.field({"name", "", 0, 0, "Name of the stimulus."}, p.name);
  visit_fields(v, static_cast<Region&>(p));
  v.field({"start_ms", "ms", 0, 1e9, "When it is first given."}, p.start_ms);
  v.field({"duration_ms", "ms", 0.01, 1e6, "How long the current flows."}, p.duration_ms);
  v.field({"strength_per_ms", "1/ms", 1e-3, 1000, "The current, as a part of the voltage's range each ms."},
          p.strength_per_ms);
  v.field({"count", "", 1, 10000, "How often it is given (S1)."}, p.count);
  v.field({"interval_ms", "ms", 1, 1e6, "From one start to the next."}, p.interval_ms);
  v.field({"s2_ms", "ms", 0, 1e6, "Interval of one extra stimulus after these (S2); 0: none."}, p.s2_ms);
  v.field({"s3_ms", "ms", 0, 1e6, "Interval of one more after that (S3); 0: none."}, p.s3_ms);
}

template <class V>
void visit_fields(V& v, Electrode& p) {
  v.field({"name", "", 0, 0, "Name of the electrode."}, p.name);
  v.field({"at_mm", "mm", kAnyMin, kAnyMax, "Where it is; RAS."}, p.at_mm);
}

template <class V>
void visit_fields(V& v, MonodomainParams& p) {
  v.choice({"integration", "", 0, 0,
            "Steps in time: semi_implicit, with half-lumped mass, for results; explicit, with lumped mass, "
            "for a quick "
            "look."},
           p.integration,
           Choices<Integration>{{"explicit", Integration::kExplicit},
                                {"semi_implicit", Integration::kSemiImplicit}});
  v.field({"end_ms", "ms", 0.01, 1e6, "Time at the end."}, p.end_ms);
  v.field({"step_ms", "ms", 0.001, 0.5, "Time step."}, p.step_ms);
  v.field({"frame_ms", "ms", 0.01, 1e6, "Time between two frames."}, p.frame_ms);
  v.field({"consistent_mass", "", 0, 1, "semi_implicit: share of the consistent mass; the rest is lumped."},
          p.consistent_mass);
  v.field(
      {"correct_speed", "", 0, 0,
       "Correct each tetrahedron's conductivity so that the wave has its speed on this mesh too, by what was "
       "measured on others."},
      p.correct_speed);
  v.list({"electrodes", "", 0, 0, "Places where the extracellular potential is recorded."}, p.electrodes);
}

template <class V>
void visit_fields(V& v, PhysicsParams& p) {
  v.optional_group({"anatomy", "", 0, 0, "Named surfaces and coordinates of the ventricles."}, p.anatomy);
  v.optional_group({"fibres", "", 0, 0, "Fibres by rule; needs anatomy."}, p.fibres);
  v.group({"tissue", "", 0, 0, "Which labels conduct, and how."}, p.tissue);
  v.list({"stimuli", "", 0, 0, "Where and when the tissue is excited from outside."}, p.stimuli);
  v.optional_group({"monodomain", "", 0, 0, "The excitation wave, with its recovery."}, p.monodomain);
  v.optional_group({"mechanics", "", 0, 0, "The beating heart; needs anatomy and fibres."}, p.mechanics);
  v.optional_group({"diffusion", "", 0, 0, "Heat that spreads from a label."}, p.diffusion);
}

}  // namespace voxtet
