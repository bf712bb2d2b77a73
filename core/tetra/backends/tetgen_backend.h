// TetGen 1.5 behind one function: the only file that knows its interface.
// H. Si, "TetGen, a Delaunay-based quality tetrahedral mesh generator", ACM Trans. Math. Softw. 41(2), 2015.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tetra/backends/filled_parts.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/sizing_field.h"
#include "types/surface_mesh.h"

namespace voxtet {

struct TetgenOptions {
  double radius_edge = 1.414;
  double min_dihedral_deg = 14;         ///< 0: not asked for
  double max_dihedral_deg = 145;        ///< 0: TetGen's default
  double tolerance = 1e-8;              ///< relative to the bounding box: points closer than this are merged
  std::size_t max_points = 0x7fffffff;  ///< gives up if more are needed, or as much work
};

/// Fills everything inside the surface except for the parts that contain a hole seed; no point is added on
/// the surface. Edge lengths follow `sizing`. Errors: kCancelled; kOutOfMemory; kMeshing with what TetGen
/// stopped at. is_runaway tells whether that was max_points, which depends on the input alone, never on time.
Result<FilledParts> run_tetgen(const SurfaceMesh& surface, const std::vector<Eigen::Vector3d>& hole_seeds,
                               const SizingField& sizing, const TetgenOptions& options,
                               const RunContext& ctx);

bool is_runaway(const Error& error);

}  // namespace voxtet
