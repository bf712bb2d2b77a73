// Peers that fill a surface with tetrahedra.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "bench/peers/surface_file.h"
#include "types/result.h"
#include "types/tet_mesh.h"

namespace voxtet::peers {

/// What a mesher gave: the surface's points first, then its own.
struct Filled {
  std::vector<Eigen::Vector3d> points;
  std::vector<Tet> tets;
};

/// The main function of a peer: `NAME SURFACE OUT VARIANT TETS`. Where TETS is not 0 the target sizes are
/// scaled until about so many tetrahedra come out; the run that counts then does everything once more.
using FillSurface = std::function<Result<Filled>(const FillTask& task, const std::string& variant)>;
int fill_main(int argc, char** argv, const FillSurface& fill);

}  // namespace voxtet::peers
