// Parametric bodies with analytic truth, as label volumes at any spacing and direction.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "types/label_volume.h"
#include "types/result.h"

namespace voxtet {

enum class PhantomKind { kSphere, kShell, kTorus, kSlab, kNestedBoxes, kBranchingTube, kBiventricle, kAtlas };

/// One struct for all kinds; each kind reads the fields it needs.
struct PhantomParams {
  PhantomKind kind = PhantomKind::kBiventricle;
  Eigen::Vector3d spacing_mm = Eigen::Vector3d::Constant(1.5);
  Eigen::Vector3d rotation_deg = Eigen::Vector3d::Zero();  ///< of the image axes, extrinsic x, y, z
  bool mirrored = false;                                   ///< first image axis reversed (determinant < 0)
  double radius_mm = 20;  ///< sphere, shell (outer), torus (major), nested boxes and slab (half width), tube
                          ///< (a quarter of its length; twice the trunk's radius)
  double inner_radius_mm = 12;  ///< shell (inner), torus (minor)
  double thickness_mm = 8;      ///< slab
  double scale = 1;             ///< biventricle: 1 = adult end-diastolic heart; atlas: 1 = 140 x 170 x 120 mm
  double roughness_mm = 0.8;    ///< biventricle: amplitude of the seeded surface roughness
  bool blood_pools = true;      ///< biventricle: label cavities 3 and 4
  double wall_scale = 1;        ///< biventricle: factor on the LV wall's thickness; cavities are kept
  double length_scale = 1;      ///< biventricle: factor on both cavities' lengths along the LV's axis
  double rv_dilation = 1;       ///< biventricle: factor on the RV cavity's depth, septum to free wall
  double rv_wall_mm = 3.8;      ///< biventricle: thickness of the RV free wall at scale 1; cavities are kept
  bool scar = false;            ///< biventricle: scar core 5 with an isthmus, border zone 6, in the LV wall
  double scar_angle_deg = 0;    ///< biventricle: of the scar around the LV; 0: antero-lateral, 127: inferior
  double scar_height_mm = 0;    ///< biventricle: of the scar's middle above mid-height, at scale 1
  double scar_arc_mm = 48;      ///< biventricle: width of the core around the LV, at mid-wall and scale 1
  double scar_length_mm = 40;   ///< biventricle: length of the core along the LV's axis at scale 1
  double scar_depth = 0.7;      ///< biventricle: share of the wall that the core fills, from inside; 1: all
  double border_mm = 3;         ///< biventricle: width of the border zone around the core at scale 1; 0: none
  double isthmus_mm = 8;        ///< biventricle: width of the isthmus at scale 1; 0: closed
  int regions = 300;            ///< atlas: number of labels
  std::uint32_t seed = 1;       ///< biventricle: roughness; atlas: regions
};

/// A label volume sampled at voxel centres, cropped to the body with two background voxels around it. The
/// body is centred near the origin; torus and slab lie across z; the heart's base faces +z, its right
/// ventricle +x.
///
/// Labels: 1 (sphere, shell, torus, slab, tube); nested boxes 1 (outer), 2, 3; biventricle: 1 LV myocardium,
/// 2 RV myocardium, 3 LV blood pool, 4 RV blood pool, 5 scar core, 6 border zone. Each label of the heart is
/// one 6-connected component, except the scar core, which an open isthmus cuts in two: voxels that sampling
/// cuts off from their label go to a neighbouring label. Where the scar passes the septum or an insertion of
/// the RV, it stays within label 1; what of it lies above the base is not there. With scar_depth 1 the
/// isthmus is the only way through the scar that is not core. The atlas stands in for a parcellated brain: an
/// ellipsoid cut into regions of about one size, labels 1 to `regions`, which touch each other as chance will
/// have it, over as little as a voxel's edge; each label is one 6-connected component.
///
/// Errors: kUsage naming the parameter that is out of range, a volume that would exceed 512^3 voxels, a
/// spacing so coarse that no voxel centre lies inside, or a scar without a voxel of core.
Result<LabelVolume> make_phantom(const PhantomParams& params);

/// The label at a point (mm, RAS) of the body itself, without any grid; background everywhere if a parameter
/// is out of range.
std::function<Label(const Eigen::Vector3d&)> phantom_body(const PhantomParams& params);

/// Exact volume of a label (mm^3) where a closed form exists (sphere, shell, torus, slab, nested boxes), else
/// NaN.
double phantom_volume_mm3(const PhantomParams& params, Label label);

}  // namespace voxtet
