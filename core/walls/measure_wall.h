// Labels and their smoothed surface -> how thick a wall is, everywhere in it.
#pragma once

#include <vector>

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"
#include "walls/wall_field.h"

namespace voxtet {

/// Which labels form the wall, and which lie on its inner side (blood pools). Without inner labels the inner
/// spaces are the cavities of the background: see walls/find_cavities.h.
struct WallLabels {
  std::vector<Label> wall, inner;
  bool shares = false;  ///< whether WallField::inner_shares are needed
};

/// `anatomy` holds all labels of the image, `meshed` those that are meshed, on the same grid; `surface` is
/// the smoothed surface of `meshed`.
struct WallInput {
  const LabelVolume& anatomy;
  const LabelVolume& meshed;
  const SurfaceMesh& surface;
};

/// Thickness is the length of the field line of the Laplace potential through a point, from the inner to the
/// outer surface (Jones, Buchbinder and Aharon, Human Brain Mapping 11, 2000; Yezzi and Prince, IEEE Trans.
/// Med. Imaging 22, 2003), measured to the smoothed surface. There is one potential for each inner space: 0
/// on its surface, 1 on everything outside of it, other inner spaces too. The thickness is the smallest of
/// all, so that a septum is as thick as the distance from ventricle to ventricle. The potential returned is
/// that of the first inner space whose line is at most a quarter longer than the shortest. The rim of an open
/// base and the image's border are no surfaces: lines run along them. Walls of which more than 5 % are
/// thinner than three voxels are measured on voxels of half the size. Where no line reaches both surfaces,
/// values are taken from the nearest part of the wall.
///
/// On shells and slabs: bias within 0.1 voxel, 95 % of the voxels within 0.25 (tests). `name` is what the
/// recipe calls the request, for messages. Errors: kUsage for labels that are listed twice or that the volume
/// does not hold, for a wall without two sides, and for sheared axes; kCancelled.
Result<WallField> measure_wall(const WallInput& input, const WallLabels& labels, const std::string& name,
                               RunContext& ctx);

}  // namespace voxtet
