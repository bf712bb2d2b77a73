// Where the voxels of an NRRD file are.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "io/volume/formats/nrrd_header.h"
#include "io/volume/voxels/reading.h"

namespace voxtet {

/// Where the voxels are: which axes of the file are spatial, and the affine in RAS, mm.
struct NrrdGeometry {
  std::vector<std::int64_t> sizes;
  std::array<std::size_t, 3> axes{};     ///< the spatial axes of the file
  std::optional<std::size_t> list_axis;  ///< the other one of a four-dimensional file
  Eigen::Matrix4d index_to_mm = Eigen::Matrix4d::Identity();
};

Result<NrrdGeometry> nrrd_geometry(const NrrdHeader& header, Reading& reading);

}  // namespace voxtet
