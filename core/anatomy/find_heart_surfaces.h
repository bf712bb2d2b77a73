// Labels and a mesh of one or two ventricles -> its named surfaces.
#pragma once

#include <vector>

#include "types/heart_surfaces.h"
#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Labels of the mesh that form the ventricles' wall, scar and border zone too, and labels of the image that
/// fill the cavities, whether they are meshed or not. Without pools the cavities are found as those of the
/// wall (walls/find_cavities.h). A left pool alone makes a single ventricle.
struct AnatomyParams {
  std::vector<Label> wall;
  std::vector<Label> lv_pool, rv_pool;
};

/// Names the faces of the wall by what lies across them in `image`, which holds all of its labels, in
/// the place of the mesh. What the steps do is said in anatomy/name_faces.h.
///
/// Where no pools are named, the left ventricle is the one whose free wall is thicker on the mean. Each
/// endocardium is one connected part: other parts, as of trabeculae's pockets, take the name around them.
/// Shells that touch none of the named surfaces, as bubbles within the wall, are kNone. Notes say what was
/// found, with areas. The same bytes for any number of threads.
///
/// Errors, which name the field (physics.anatomy.wall): kUsage for labels that neither mesh or image hold, or
/// that are listed twice; a wall without a cavity, or with more than two; a cavity that no face of the wall
/// looks into; a wall that is closed on all sides, so that it has no base. kCancelled.
Result<HeartSurfaces> find_heart_surfaces(const TetMesh& mesh, const LabelVolume& image,
                                          const AnatomyParams& params, RunContext& ctx);

}  // namespace voxtet
