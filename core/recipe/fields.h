// The recipe's fields, declared once: name, unit, range and sentence. Reading, writing, the schema and the
// docs all visit this table. A visitor provides field(), choice(), group(), optional_group() and list().
#pragma once

#include <limits>
#include <utility>

#include "recipe/recipe.h"

namespace voxtet {

/// What is declared for a field. The range is inclusive; for vectors it holds for each component.
struct FieldInfo {
  const char* name;
  const char* unit;
  double min, max;
  const char* description;
  const char* formerly = nullptr;  ///< an older name under which it is still read
};

inline constexpr double kAnyMin = std::numeric_limits<double>::lowest();
inline constexpr double kAnyMax = std::numeric_limits<double>::max();

template <class Enum>
struct Choice {
  const char* name;
  Enum value;
  const char* formerly = nullptr;  ///< as in FieldInfo
};

template <class Enum>
using Choices = std::vector<Choice<Enum>>;

template <class V>
void visit_fields(V& v, PhantomParams& p) {
  v.choice({"kind", "", 0, 0, "Which body."}, p.kind,
           Choices<PhantomKind>{{"sphere", PhantomKind::kSphere},
                                {"shell", PhantomKind::kShell},
                                {"torus", PhantomKind::kTorus},
                                {"slab", PhantomKind::kSlab},
                                {"nested_boxes", PhantomKind::kNestedBoxes},
                                {"branching_tube", PhantomKind::kBranchingTube},
                                {"biventricle", PhantomKind::kBiventricle}});
  v.field({"spacing_mm", "mm", 0.05, 50, "Distance between voxel centres along the image axes."},
          p.spacing_mm);
  v.field({"rotation_deg", "deg", -360, 360, "Rotation of the image axes about x, then y, then z."},
          p.rotation_deg);
  v.field({"mirrored", "", 0, 0, "First image axis reversed."}, p.mirrored);
  v.field(
      {"radius_mm", "mm", 0.1, 1000, "Radius: sphere, shell (outer), torus (major); half size of the boxes."},
      p.radius_mm);
  v.field({"inner_radius_mm", "mm", 0.1, 1000, "Inner radius of the shell, minor radius of the torus."},
          p.inner_radius_mm);
  v.field({"thickness_mm", "mm", 0.1, 1000, "Thickness of the slab."}, p.thickness_mm);
  v.field({"scale", "", 0.1, 10, "Biventricle: size, 1 is an adult heart."}, p.scale);
  v.field({"roughness_mm", "mm", 0, 12, "Biventricle: amplitude of the seeded roughness of the walls."},
          p.roughness_mm);
  v.field({"blood_pools", "", 0, 0, "Biventricle: label the cavities as 3 and 4."}, p.blood_pools);
  v.field({"scar", "", 0, 0, "Biventricle: scar core 5, crossed by an isthmus, with border zone 6."}, p.scar);
  v.field({"seed", "", 0, 4294967295.0, "Biventricle: seed of the roughness."}, p.seed);
}

template <class V>
void visit_fields(V& v, FileSource& p) {
  v.field({"name", "", 0, 0, "Name of the file that holds the volume."}, p.name);
  v.field({"sha256", "", 0, 0, "Digest of its voxels and affine; empty accepts any."}, p.sha256);
}

template <class V>
void visit_fields(V& v, Source& p) {
  v.optional_group({"phantom", "", 0, 0, "A parametric body, generated."}, p.phantom);
  v.optional_group({"file", "", 0, 0, "A file that the user holds."}, p.file);
}

template <class V>
void visit_fields(V& v, Expected& p) {
  v.field({"engine", "", 0, 0, "Version of voxtet that made the mesh."}, p.engine);
  v.field({"digest", "", 0, 0, "SHA-256 of the mesh's points, tetrahedra and labels."}, p.digest);
  v.field({"tets", "", 0, 4294967295.0, "Number of tetrahedra."}, p.tets);
}

template <class V>
void visit_fields(V& v, VolumeParams& p) {
  v.field({"slice_ratio", "", 0, 100,
           "Slices thicker than so many pixels are interpolated to voxels; 0 never does."},
          p.slice_ratio);
  v.field({"speck_voxels", "voxel", 0, 1e9, "Pieces of a label with fewer voxels are removed; 0 keeps all."},
          p.speck_voxels);
  v.field({"hole_voxels", "voxel", 0, 1e9,
           "Enclosed pieces of background with fewer voxels are filled; 0 keeps all."},
          p.hole_voxels);
}

template <class V>
void visit_fields(V& v, ExtractParams& p) {
  v.choice({"method", "", 0, 0, "How the label surface is extracted; auto: by the number of labels."},
           p.method,
           Choices<ExtractMethod>{{"auto", ExtractMethod::kAuto},
                                  {"marching_cubes", ExtractMethod::kMarchingCubes},
                                  {"marching_tets", ExtractMethod::kMarchingTets}});
}

template <class V>
void visit_fields(V& v, SmoothParams& p) {
  v.field(
      {"iterations", "", 0, 1000,
       "Bi-Laplacian steps, and as many again for thick regions of several labels; 0 leaves the staircase."},
      p.iterations);
  v.field({"step", "", 0.01, 0.49, "Step of each iteration."}, p.step);
  v.field({"max_move_voxels", "voxel", 0.01, 1, "How far a vertex may move along each image axis."},
          p.max_move_voxels);
  v.field({"keep_volume", "", 0, 0, "Restore each label's volume after smoothing."}, p.keep_volume);
}

template <class V>
void visit_fields(V& v, LabelSize& p) {
  v.field({"label", "", 1, 65535, "The label."}, p.label);
  v.field({"edge_mm", "mm", 0.01, 1000, "Edge length inside it."}, p.edge_mm);
}

template <class V>
void visit_fields(V& v, Region& p) {
  v.choice(
      {"shape", "", 0, 0, "Shape of the region."}, p.shape,
      Choices<RegionShape>{
          {"sphere", RegionShape::kSphere}, {"box", RegionShape::kBox}, {"capsule", RegionShape::kCapsule}});
  v.field({"centre_mm", "mm", kAnyMin, kAnyMax, "Centre of sphere or box, first end of a capsule; RAS."},
          p.centre_mm);
  v.field({"end_mm", "mm", kAnyMin, kAnyMax, "Second end of a capsule; RAS."}, p.end_mm);
  v.field({"half_size_mm", "mm", 0.001, 10000, "Half edges of a box."}, p.half_size_mm);
  v.field({"axes_deg", "deg", -360, 360, "Rotation of a box about x, then y, then z."}, p.axes_deg);
  v.field({"radius_mm", "mm", 0.001, 10000, "Radius of sphere or capsule."}, p.radius_mm);
}

template <class V>
void visit_fields(V& v, SizeRegion& p) {
  v.field({"name", "", 0, 0, "Name of the region."}, p.name);
  visit_fields(v, static_cast<Region&>(p));
  v.field({"edge_mm", "mm", 0.01, 1000, "Edge length inside."}, p.edge_mm);
  v.field({"band_mm", "mm", 0, 10000,
           "Width of the band around it over which the size returns to its surroundings'."},
          p.band_mm);
}

template <class V>
void visit_fields(V& v, DistanceSize& p) {
  v.field({"label", "", 1, 65535, "The label from which distance is measured."}, p.label);
  v.field({"edge_mm", "mm", 0.01, 1000, "Edge length at the label."}, p.edge_mm);
  v.field({"slope", "mm/mm", 0, 10, "Growth of the edge length per mm of distance."}, p.slope);
}

template <class V>
void visit_fields(V& v, ThicknessSize& p) {
  v.field({"wall", "", 1, 65535, "Labels of the image that form the wall."}, p.wall);
  v.field({"inner", "", 1, 65535,
           "Labels on its inner side (blood pools); none: the cavities of the background."},
          p.inner);
  v.field({"layers", "", 0, 20, "Elements asked for across the wall; 0: the ranges below instead."},
          p.layers);
  v.choice(
      {"layering", "", 0, 0,
       "How the layers are had: size: by the size of elements alone; exact: by sheets across the wall, with "
       "one element between two of them."},
      p.layering, Choices<Layering>{{"size", Layering::kSize}, {"exact", Layering::kExact}});
  v.field({"edge_thin_mm", "mm", 0.01, 1000, "Edge length where the wall is thin."}, p.edge_thin_mm);
  v.field({"edge_thick_mm", "mm", 0.01, 1000, "Edge length where the wall is thick."}, p.edge_thick_mm);
  v.field({"thin_mm", "mm", 0, 1000, "Thickness that is thin; 0 with thick_mm 0: the first percentile."},
          p.thin_mm);
  v.field({"thick_mm", "mm", 0, 1000, "Thickness that is thick; 0 with thin_mm 0: the last percentile."},
          p.thick_mm);
}

template <class V>
void visit_fields(V& v, MaskSize& p) {
  v.field({"name", "", 0, 0, "Name of the file that holds the mask, a label volume on any grid."}, p.name);
  v.field({"sha256", "", 0, 0, "Digest of its voxels and affine; empty accepts any."}, p.sha256);
  v.list({"edges", "", 0, 0, "Edge length where the mask has a label."}, p.edges);
}

template <class V>
void visit_fields(V& v, ImageSize& p) {
  v.field({"name", "", 0, 0, "Name of the file (NIfTI) that holds edge lengths in mm, on any grid."}, p.name);
  v.field({"sha256", "", 0, 0, "Digest of its voxels and affine; empty accepts any."}, p.sha256);
}

template <class V>
void visit_fields(V& v, CurvatureSize& p) {
  v.field({"labels", "", 1, 65535, "Labels whose surfaces count; none: all."}, p.labels);
  v.field({"edges_per_turn", "", 3, 1000, "Edges to a full turn of the surface's circle of curvature."},
          p.edges_per_turn);
  v.field({"edge_min_mm", "mm", 0.01, 1000, "No edge length below this is asked, however sharp the bend."},
          p.edge_min_mm);
}

template <class V>
void visit_fields(V& v, WaveSize& p) {
  v.field({"labels", "", 1, 65535, "Labels in which; none: all."}, p.labels);
  v.field({"speed_mm_per_ms", "mm/ms", 0.01, 10,
           "Speed of the wave in its slowest direction, across the fibres."},
          p.speed_mm_per_ms);
  v.field({"error_percent", "%", 0.1, 50, "Error of its speed that the mesh may cause."}, p.error_percent);
  v.field(
      {"consistent_mass", "", 0, 1, "Share of the consistent mass in the simulation to come; explicit: 0."},
      p.consistent_mass);
}

template <class V>
void visit_fields(V& v, SizingParams& p) {
  v.field({"edge_mm", "mm", 0.01, 1000, "Edge length wherever nothing smaller is asked."}, p.edge_mm);
  v.list({"labels", "", 0, 0, "Edge length inside single labels, instead of edge_mm."}, p.labels);
  v.list({"regions", "", 0, 0, "Places with their own edge length."}, p.regions);
  v.list({"distances", "", 0, 0, "Edge length growing with the distance to a label."}, p.distances);
  v.list({"thickness", "", 0, 0, "Edge length by the thickness of a wall, instead of edge_mm there."},
         p.thickness);
  v.list({"masks", "", 0, 0, "Edge lengths painted over the volume."}, p.masks);
  v.list({"images", "", 0, 0, "Images of edge lengths, instead of edge_mm where they have one."}, p.images);
  v.list({"curvature", "", 0, 0, "Edge length by the curvature of the label surface."}, p.curvature);
  v.list({"waves", "", 0, 0, "Edge length by the error that it causes in the speed of an excitation wave."},
         p.waves);
  v.field({"edge_min_mm", "mm", 0.01, 1000, "No edge length below this is asked."}, p.edge_min_mm);
  v.field({"edge_max_mm", "mm", 0.01, 1000, "No edge length above this is asked."}, p.edge_max_mm);
  v.field({"gradation", "mm/mm", 0.01, 1, "Bound on how fast the edge length may change per mm."},
          p.gradation);
}

template <class V>
void visit_fields(V& v, RemeshParams& p) {
  v.choice({"method", "", 0, 0, "How the adapted surface is made."}, p.method,
           Choices<RemeshMethod>{{"delaunay", RemeshMethod::kDelaunay},
                                 {"adapt", RemeshMethod::kAdapt, "remesh"}});
  v.choice({"keep_topology", "", 0, 0,
            "What makes method delaunay give way to adapt: a lost or self-touching label, any change of "
            "topology, or nothing."},
           p.keep_topology,
           Choices<KeepTopology>{{"labels", KeepTopology::kLabels},
                                 {"all", KeepTopology::kAll},
                                 {"nothing", KeepTopology::kNothing}});
  v.field({"facet_angle_deg", "deg", 0, 30, "delaunay: lower bound on the triangles' angles."},
          p.facet_angle_deg);
  v.field({"max_distance_voxels", "voxel", 0.01, 10, "delaunay: distance allowed from triangles to labels."},
          p.max_distance_voxels);
  v.choice({"schedule", "", 0, 0, "adapt: adaptive, or the paper's coarsen, refine, optimise."}, p.schedule,
           Choices<AdaptSchedule>{{"adaptive", AdaptSchedule::kAdaptive}, {"paper", AdaptSchedule::kPaper}});
  v.field({"shape_weight", "", 0, 1, "adapt: weight of shape against size when points are moved."},
          p.shape_weight);
  v.field({"verify", "", 0, 0, "adapt: check every operation for intersections; slow."}, p.verify);
}

template <class V>
void visit_fields(V& v, FillParams& p) {
  v.choice({"backend", "", 0, 0, "Which mesher fills the surface."}, p.backend,
           Choices<TetBackend>{{"tetgen", TetBackend::kTetgen}, {"delaunay", TetBackend::kDelaunay}});
  v.field({"radius_edge", "", 1.2, 10, "Bound on circumradius over shortest edge."}, p.radius_edge);
  v.field(
      {"min_dihedral_deg", "deg", 0, 18, "tetgen: smallest dihedral angle that refinement aims at; 0: none."},
      p.min_dihedral_deg);
  v.field(
      {"max_dihedral_deg", "deg", 130, 180, "tetgen: largest dihedral angle that its optimisation aims at."},
      p.max_dihedral_deg);
}

template <class V>
void visit_fields(V& v, OptimiseParams& p) {
  v.field({"rounds", "", 0, 20, "Rounds of work on badly shaped tetrahedra; 0 leaves them."}, p.rounds);
  v.field({"min_dihedral_deg", "deg", 1, 45, "Tetrahedra with a smaller dihedral angle are worked on."},
          p.min_dihedral_deg);
  v.field({"insertion_deg", "deg", 1, 45,
           "Where tetrahedra stay below this, vertices are inserted, and those on the surface slide."},
          p.insertion_deg);
  v.field(
      {"slide", "", 0, 0.5,
       "How far from the label surface vertices may slide, as a part of the target edge length; 0: not at "
       "all."},
      p.slide);
}

template <class V>
void visit_fields(V& v, TransferParams& p) {
  v.field({"labels", "", 1, 65535, "Labels of the image to transfer to the tetrahedra, meshed or not."},
          p.labels);
  v.field({"samples_min", "", 1, 4096, "Samples of each tetrahedron, at least."}, p.samples_min);
  v.field({"samples_max", "", 1, 4096, "Samples of each tetrahedron, at most."}, p.samples_max);
}

template <class V>
void visit_fields(V& v, QualityParams& p) {
  v.field({"histogram_bins", "", 4, 1024, "Bins of each histogram."}, p.histogram_bins);
  v.field(
      {"sample_spacing_voxels", "voxel", 0.05, 10, "Spacing of the samples that distances are measured at."},
      p.sample_spacing_voxels);
}

template <class V>
void visit_fields(V& v, DiffusionParams& p) {
  v.field({"from", "", 1, 65535, "Label from which heat spreads."}, p.from);
  v.field({"diffusivity_mm2_per_ms", "mm2/ms", 1e-9, 1e9, "Diffusivity, the same everywhere."},
          p.diffusivity_mm2_per_ms);
  v.field({"end_ms", "ms", 1e-9, 1e9, "Time at the end."}, p.end_ms);
  v.field({"step_ms", "ms", 1e-9, 1e9, "Time step."}, p.step_ms);
  v.field({"frame_ms", "ms", 1e-9, 1e9, "Time between two frames."}, p.frame_ms);
}

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
  v.list({"electrodes", "", 0, 0, "Places where the extracellular potential is recorded."}, p.electrodes);
}

template <class V>
void visit_fields(V& v, PhysicsParams& p) {
  v.optional_group({"anatomy", "", 0, 0, "Named surfaces and coordinates of the ventricles."}, p.anatomy);
  v.optional_group({"fibres", "", 0, 0, "Fibres by rule; needs anatomy."}, p.fibres);
  v.group({"tissue", "", 0, 0, "Which labels conduct, and how."}, p.tissue);
  v.list({"stimuli", "", 0, 0, "Where and when the tissue is excited from outside."}, p.stimuli);
  v.optional_group({"monodomain", "", 0, 0, "The excitation wave, with its recovery."}, p.monodomain);
  v.optional_group({"diffusion", "", 0, 0, "Heat that spreads from a label."}, p.diffusion);
}

template <class V>
void visit_fields(V& v, Limits& p) {
  v.field({"tets", "", 0, 1e9, "Most tetrahedra; a case forecast to have more is refused. 0: no limit."},
          p.tets);
  v.field({"memory_mb", "MB", 0, 1e9, "Most memory, by forecast; 0: no limit."}, p.memory_mb);
  v.field({"seconds", "s", 0, 1e9, "Most time, by forecast; 0: no limit."}, p.seconds);
}

template <class V>
void visit_fields(V& v, Recipe& r) {
  v.group({"source", "", 0, 0, "Where the labels come from."}, r.source);
  v.field({"labels", "", 1, 65535, "Labels to mesh; none: all."}, r.labels);
  v.field({"merge", "", 1, 65535, "Groups of labels; each is meshed as one region."}, r.merge);
  v.group({"volume", "", 0, 0, "Preparation of the labels."}, r.volume);
  v.group({"surface", "", 0, 0, "Extraction of the label surface."}, r.surface);
  v.group({"smooth", "", 0, 0, "Smoothing of the label surface."}, r.smooth);
  v.group({"sizing", "", 0, 0, "The rules for element size."}, r.sizing);
  v.group({"remesh", "", 0, 0, "The adapted surface."}, r.remesh);
  v.group({"tetra", "", 0, 0, "The tetrahedra."}, r.tetra);
  v.group({"optimise", "", 0, 0, "Better shapes for the tetrahedra."}, r.optimise);
  v.group({"transfer", "", 0, 0, "Labels transferred to tetrahedra instead of meshed.", "lookup"},
          r.transfer);
  v.group({"quality", "", 0, 0, "The evidence."}, r.quality);
  v.optional_group({"physics", "", 0, 0, "What is simulated on the mesh."}, r.physics);
  v.group({"limits", "", 0, 0, "What meshing may take."}, r.limits);
  v.group({"expected", "", 0, 0, "What a shared case promises."}, r.expected);
}

}  // namespace voxtet
