// A line for each point: its number and its coordinates.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/bytes/byte_writer.h"
#include "io/mesh/shared/mesh_format.h"

namespace voxtet {

/// "1 0.5 0 2\n" and so on, from 1, in mm of `space`.
inline void write_numbered_points(ByteWriter& out, const std::vector<Eigen::Vector3d>& points,
                                  PatientSpace space) {
  for (std::size_t p = 0; p < points.size(); ++p) {
    out.integer(static_cast<std::int64_t>(p + 1));
    const Eigen::Vector3d point = in_space(points[p], space);
    for (int d = 0; d < 3; ++d) {
      out.text(" ");
      out.real(point[d]);
    }
    out.text("\n");
  }
}

}  // namespace voxtet
