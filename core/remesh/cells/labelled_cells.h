// A labelled Delaunay triangulation as flat arrays.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/elements/facet_corners.h"
#include "types/label_volume.h"

namespace voxtet::remesh {

/// Finite cells of a triangulation of a box around the labels. Every cell is positive:
/// (p1-p0) . ((p2-p0) x (p3-p0)) > 0. Cells on the hull are background.
struct LabelledCells {
  static constexpr std::uint32_t kNone = 0xffffffffU;

  std::vector<Eigen::Vector3d> points;                 ///< mm
  std::vector<std::array<std::uint32_t, 4>> vertices;  ///< per cell, into points
  std::vector<std::array<std::uint32_t, 4>>
      neighbours;             ///< per cell, across the facet opposite each vertex; kNone
  std::vector<Label> labels;  ///< per cell

  Eigen::Vector3d centroid(std::uint32_t cell) const {
    const auto& [a, b, c, d] = vertices[cell];
    return 0.25 * points[a] + 0.25 * points[b] + 0.25 * points[c] + 0.25 * points[d];
  }
  Label label_or_background(std::uint32_t cell) const { return cell == kNone ? kBackground : labels[cell]; }
};

}  // namespace voxtet::remesh
