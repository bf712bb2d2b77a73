// Label volume -> triangle complex, topologically exact.
#pragma once

#include "types/label_volume.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/surface_mesh.h"

namespace voxtet {

enum class ExtractMethod {
  kAuto,           ///< marching cubes for one label, marching tetrahedra for more
  kMarchingCubes,  ///< binary: any label against background; sides are {smallest label present, 0}
  kMarchingTets,   ///< many labels, conforming: barycentric dual on the six Kuhn tetrahedra of each cell
};

struct ExtractParams {
  ExtractMethod method = ExtractMethod::kAuto;
};

/// The boundary complex of all labels, vertices at lattice-edge midpoints (marching tetrahedra: also centres
/// of tetrahedron faces and tetrahedra), in mm, RAS. The volume is padded by background, so that every
/// label's boundary is a closed 2-manifold, also where a label touches the border of the image. Ambiguous
/// faces of marching cubes separate the foreground (6-connectivity). Linear time; identical for any
/// ctx.threads. Errors: kBadInput when no voxel has a label.
Result<SurfaceMesh> extract_surface(const LabelVolume& volume, const ExtractParams& params, RunContext& ctx);

}  // namespace voxtet
