// The recipe's fields, declared once: name, unit, range and sentence. Reading, writing, the schema and the
// docs all visit this table. A visitor provides field(), choice(), group(), optional_group() and list().
#pragma once

#include "recipe/field_info.h"
#include "recipe/physics_fields.h"
#include "recipe/recipe.h"

namespace voxtet {

template <class V>
void visit_fields(V& v, PhantomParams& p) {
  v.choice({"kind", "", 0, 0, "Which body."}, p.kind,
           Choices<PhantomKind>{{"sphere", PhantomKind::kSphere},
                                {"shell", PhantomKind::kShell},
                                {"torus", PhantomKind::kTorus},
                                {"slab", PhantomKind::kSlab},
                                {"nested_boxes", PhantomKind::kNestedBoxes},
                                {"branching_tube", PhantomKind::kBranchingTube},
                                {"biventricle", PhantomKind::kBiventricle},
                                {"atlas", PhantomKind::kAtlas}});
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
  v.field({"scale", "", 0.1, 10, "Biventricle and atlas: size, 1 is an adult's."}, p.scale);
  v.field({"roughness_mm", "mm", 0, 12, "Biventricle: amplitude of the seeded roughness of the walls."},
          p.roughness_mm);
  v.field({"wall_scale", "", 0.5, 2,
           "Biventricle: factor on the LV wall's thickness, which grows outwards; the cavities stay."},
          p.wall_scale);
  v.field({"length_scale", "", 0.75, 1.35,
           "Biventricle: factor on the length of both cavities along the LV's axis; widths and walls stay."},
          p.length_scale);
  v.field({"rv_dilation", "", 0.7, 3.5,
           "Biventricle: factor on the depth of the RV cavity, from the septum to the free wall."},
          p.rv_dilation);
  v.field({"rv_wall_mm", "mm", 3, 10,
           "Biventricle: thickness of the RV free wall at scale 1, which grows outwards."},
          p.rv_wall_mm);
  v.field({"blood_pools", "", 0, 0, "Biventricle: label the cavities as 3 and 4."}, p.blood_pools);
  v.field({"scar", "", 0, 0, "Biventricle: scar core 5, crossed by an isthmus, with border zone 6."}, p.scar);
  v.field({"scar_angle_deg", "deg", -180, 180,
           "Biventricle: place of the scar around the LV, 0 is antero-lateral, 37 lateral, 127 inferior, "
           "-53 anterior, -143 septal."},
          p.scar_angle_deg);
  v.field({"scar_height_mm", "mm", -20, 20,
           "Biventricle: place of the scar along the LV's axis at scale 1, from 0 in the middle; positive: "
           "towards the base."},
          p.scar_height_mm);
  v.field({"scar_arc_mm", "mm", 20, 72,
           "Biventricle: width of the scar core around the LV, in the middle of the wall at scale 1."},
          p.scar_arc_mm);
  v.field({"scar_length_mm", "mm", 16, 60,
           "Biventricle: length of the scar core along the LV's axis at scale 1."},
          p.scar_length_mm);
  v.field(
      {"scar_depth", "", 0.05, 1, "Biventricle: share of the wall that the scar core fills, from inside."},
      p.scar_depth);
  v.field({"border_mm", "mm", 0, 10,
           "Biventricle: width of the border zone around the core at scale 1; 0: none."},
          p.border_mm);
  v.field({"isthmus_mm", "mm", 0, 40, "Biventricle: width of the isthmus at scale 1; 0 closes it."},
          p.isthmus_mm);
  v.field({"regions", "", 1, 2000, "Atlas: number of labels."}, p.regions);
  v.field({"seed", "", 0, 4294967295.0, "Biventricle: seed of the roughness. Atlas: seed of the regions."},
          p.seed);
}

template <class V>
void visit_fields(V& v, InlineSource& p) {
  v.field({"name", "", 0, 0, "Name of the file that it was read from."}, p.name);
  v.field({"data", "", 0, 0, "The labels and their affine, coded, as base64url."}, p.data);
}

template <class V>
void visit_fields(V& v, FileSource& p) {
  v.field({"name", "", 0, 0, "Name of the file that holds the volume, or a mesh that was made elsewhere."},
          p.name);
  v.field({"sha256", "", 0, 0, "Digest of its voxels and affine, or of its mesh; empty accepts any."},
          p.sha256);
  v.field({"url", "", 0, 0, "Address where the file can be had."}, p.url);
}

template <class V>
void visit_fields(V& v, Threshold& p) {
  v.field({"lower", "", -1e9, 1e9, "Smallest value that becomes label 1."}, p.lower);
  v.field({"upper", "", -1e9, 1e9, "Largest value that becomes label 1."}, p.upper);
}

template <class V>
void visit_fields(V& v, ReadOptions& p) {
  v.choice({"unit", "", 0, 0, "Unit of the file's lengths, whatever it says; file: as it says."}, p.unit,
           Choices<LengthUnit>{{"file", LengthUnit::kOfFile},
                               {"m", LengthUnit::kMetre},
                               {"cm", LengthUnit::kCentimetre},
                               {"mm", LengthUnit::kMillimetre},
                               {"um", LengthUnit::kMicrometre},
                               {"nm", LengthUnit::kNanometre}});
  v.field({"precedence", "", 0, 0,
           "Segments by name or label: where segments overlap the first of these wins, and else the last of "
           "the file."},
          p.precedence);
  v.field({"background", "", -2147483648.0, 4294967295.0, "Value of the file that is its background."},
          p.background);
  v.field({"frame", "", -1, 65535, "Frame of a file with several, counted from 0; -1: none is chosen."},
          p.frame);
  v.optional_group({"threshold", "", 0, 0, "Of an image without labels: values that become label 1."},
                   p.threshold);
}

template <class V>
void visit_fields(V& v, Source& p) {
  v.optional_group({"phantom", "", 0, 0, "A parametric body, generated."}, p.phantom);
  v.optional_group({"inline", "", 0, 0, "A label volume within the recipe."}, p.inlined);
  v.optional_group({"file", "", 0, 0, "A file that the user holds."}, p.file);
  visit_fields(v, p.read);
}

template <class V>
void visit_fields(V& v, Expected& p) {
  v.field({"engine", "", 0, 0, "Version of voxtet that made the mesh."}, p.engine);
  v.field({"digest", "", 0, 0, "SHA-256 of the mesh's points, tetrahedra and labels."}, p.digest);
  v.field({"tets", "", 0, 4294967295.0, "Number of tetrahedra."}, p.tets);
  v.field({"physics", "", 0, 0, "Version of the physics that was simulated; empty: none is promised."},
          p.physics);
  v.group({"stages", "", 0, 0, "SHA-256 of what simulations found."}, p.stages);
}

template <class V>
void visit_fields(V& v, SliceShift& p) {
  v.field({"slice", "", 0, 100000, "Slice of the file, counted from 0."}, p.slice);
  v.field({"first_mm", "mm", -1000, 1000, "Move along the first of the slice's two image axes."}, p.first_mm);
  v.field({"second_mm", "mm", -1000, 1000, "Move along the second of the slice's two image axes."},
          p.second_mm);
}

template <class V>
void visit_fields(V& v, AlignParams& p) {
  v.field({"align_slices", "", 0, 0,
           "Thick slices that are shifted against each other, as by breath-holds, are put back."},
          p.align_slices);
  v.field({"largest_shift_mm", "mm", 0, 1000, "No slice is moved farther, unless slice_shifts says so."},
          p.largest_shift_mm);
  v.list({"slice_shifts", "", 0, 0, "Moves of single thick slices in their plane, instead of found ones."},
         p.slice_shifts);
}

template <class V>
void visit_fields(V& v, CutParams& p) {
  v.field({"name", "", 0, 0, "Name of the surface in the plane; empty: cut, cut_2, ..."}, p.name);
  v.field({"labels", "", 1, 65535, "Labels that are cut; none: all."}, p.labels);
  v.field({"point_mm", "mm", kAnyMin, kAnyMax, "A point of the plane; RAS."}, p.point_mm);
  v.field({"normal", "", kAnyMin, kAnyMax, "Direction across the plane; what it points to is cut away; RAS."},
          p.normal);
}

template <class V>
void visit_fields(V& v, VolumeParams& p) {
  v.field({"slice_ratio", "", 0, 100,
           "Slices thicker than so many pixels are interpolated to voxels; 0 never does."},
          p.slice_ratio);
  v.field({"speck_voxels", "voxel", 0, 1e9,
           "Pieces of a label with fewer voxels are removed, but never its largest; 0 keeps all."},
          p.speck_voxels);
  v.field({"hole_voxels", "voxel", 0, 1e9,
           "Enclosed pieces of background with fewer voxels are filled; 0 keeps all."},
          p.hole_voxels);
  v.field({"handle_voxels", "voxel", 0, 1e9,
           "Handles, tunnels and pits one voxel wide are opened, closed or filled if fewer voxels change; 0 "
           "keeps all."},
          p.handle_voxels);
  v.field({"flat_border", "", 0, 0,
           "Faces at which the image cuts a body off are flat, with a sharp rim and a name."},
          p.flat_border);
  v.list({"cut", "", 0, 0, "Planes at which labels are cut off: flat faces with a sharp rim and a name."},
         p.cut);
  visit_fields(v, p.align);
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
  v.field({"slice_share", "", 0, 1,
           "Across thick slices vertices may move as if so much of a slice were a voxel; 0: they may not."},
          p.slice_share);
  v.field({"keep_volume", "", 0, 0, "Restore each label's volume after smoothing."}, p.keep_volume);
}

template <class V>
void visit_fields(V& v, LabelSize& p) {
  v.field({"label", "", 1, 65535, "The label."}, p.label);
  v.field({"edge_mm", "mm", 0.01, 1000, "Edge length inside it."}, p.edge_mm);
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
  v.field({"sha256", "", 0, 0, "Digest of its voxels and affine, or of its mesh; empty accepts any."},
          p.sha256);
  v.list({"edges", "", 0, 0, "Edge length where the mask has a label."}, p.edges);
}

template <class V>
void visit_fields(V& v, ImageSize& p) {
  v.field({"name", "", 0, 0, "Name of the file (NIfTI) that holds edge lengths in mm, on any grid."}, p.name);
  v.field({"sha256", "", 0, 0, "Digest of its voxels and affine, or of its mesh; empty accepts any."},
          p.sha256);
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
           Choices<RemeshMethod>{{"delaunay", RemeshMethod::kDelaunay}, {"adapt", RemeshMethod::kAdapt}});
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
void visit_fields(V& v, Limits& p) {
  v.field({"tets", "", 0, 1e9, "Most tetrahedra; a case forecast to have more is refused. 0: no limit."},
          p.tets);
  v.field({"memory_mb", "MB", 0, 1e9, "Most memory, by forecast; 0: no limit."}, p.memory_mb);
  v.field({"seconds", "s", 0, 1e9, "Most time, by forecast; 0: no limit."}, p.seconds);
}

template <class V>
void visit_fields(V& v, LegendEntry& p) {
  v.field({"label", "", 1, 65535, "The label."}, p.label);
  v.field({"name", "", 0, 0, "What it is called, in exports too; empty: as in the file."}, p.name);
  v.field({"colour", "", 0, 0, "Its colour as #rrggbb; empty: as in the file."}, p.colour);
}

template <class V>
void visit_fields(V& v, ViewParams& p) {
  v.field({"stage", "", 0, 0, "Stage whose result is shown; empty: the last one."}, p.stage);
  v.field({"colour", "", 0, 0, "Field that the mesh is coloured by; empty: labels."}, p.colour);
  v.choice({"layout", "", 0, 0, "The body alone, or beside slices of the image."}, p.layout,
           Choices<ViewLayout>{{"model", ViewLayout::kModel}, {"slices", ViewLayout::kSlices}});
  v.optional_group({"camera", "", 0, 0, "From where the body is seen, z upwards; absent: from its front."},
                   p.camera);
  v.optional_group({"cut", "", 0, 0, "Plane that the body is cut along."}, p.cut);
  v.field({"crosshair", "", 0, 1, "Place of the slices, as a fraction of the image along its axes."},
          p.crosshair);
  v.field({"hidden", "", 1, 65535, "Labels that are not shown."}, p.hidden);
  v.field({"element", "", -1, 2147483647, "Tetrahedron that is singled out, by its number from 0; -1: none."},
          p.element);
  v.field({"edges", "", 0, 0, "Edges of the elements are drawn."}, p.edges);
  v.field({"explode", "", 0, 2, "How far labels are pulled apart; 1 doubles the distances of their middles."},
          p.explode);
  v.field({"time_ms", "ms", 0, 1e9, "Time that is shown of a simulation."}, p.time_ms);
}

template <class V>
void visit_fields(V& v, ViewCamera& p) {
  v.field({"position_mm", "mm", -1e6, 1e6, "Where it stands; RAS."}, p.position_mm);
  v.field({"target_mm", "mm", -1e6, 1e6, "What it looks at; RAS."}, p.target_mm);
}

template <class V>
void visit_fields(V& v, ViewCut& p) {
  v.field({"normal", "", -1, 1, "Direction of the side that is taken away; RAS."}, p.normal);
  v.field({"place", "", 0, 1, "How far along it the plane lies: 0 and 1 are the ends of the body."}, p.place);
  v.field({"flat", "", 0, 0, "Through the elements; else they stay whole."}, p.flat);
}

template <class V>
void visit_fields(V& v, ExpectedStages& p) {
  v.field({"eikonal", "", 0, 0, "Digest of the activation map; empty: none is promised."}, p.eikonal);
  v.field({"monodomain", "", 0, 0, "Digest of the wave; empty: none is promised."}, p.monodomain);
  v.field({"mechanics", "", 0, 0, "Digest of the beating heart; empty: none is promised."}, p.mechanics);
}

template <class V>
void visit_fields(V& v, Recipe& r) {
  v.field({"version", "", 1, kRecipeVersion, "Version of the recipe's format; absent: the first."},
          r.version);
  v.group({"source", "", 0, 0, "Where the labels come from."}, r.source);
  v.list({"legend", "", 0, 0, "Names and colours of labels, before those of the file."}, r.legend);
  v.field({"labels", "", 1, 65535, "Labels to mesh; none: all."}, r.labels);
  v.field({"merge", "", 1, 65535, "Groups of labels; each is meshed as one region."}, r.merge);
  v.group({"volume", "", 0, 0, "Preparation of the labels."}, r.volume);
  v.group({"surface", "", 0, 0, "Extraction of the label surface."}, r.surface);
  v.group({"smooth", "", 0, 0, "Smoothing of the label surface."}, r.smooth);
  v.group({"sizing", "", 0, 0, "The rules for element size."}, r.sizing);
  v.group({"remesh", "", 0, 0, "The adapted surface."}, r.remesh);
  v.group({"tetra", "", 0, 0, "The tetrahedra."}, r.tetra);
  v.group({"optimise", "", 0, 0, "Better shapes for the tetrahedra."}, r.optimise);
  v.group({"transfer", "", 0, 0, "Labels transferred to tetrahedra instead of meshed."}, r.transfer);
  v.group({"quality", "", 0, 0, "The evidence."}, r.quality);
  v.optional_group({"physics", "", 0, 0, "What is simulated on the mesh."}, r.physics);
  v.group({"limits", "", 0, 0, "What meshing may take."}, r.limits);
  v.group({"expected", "", 0, 0, "What a shared case promises."}, r.expected);
  v.optional_group({"view", "", 0, 0, "What a page shows first; nothing that is made depends on it."},
                   r.view);
}

}  // namespace voxtet
