// Which part of a complex stands for which part of the reference.
#pragma once

#include <cstdint>
#include <vector>

#include "remesh/complex/complex_mesh.h"
#include "remesh/complex/edit.h"

namespace voxtet::remesh {

/// kNone, or an edge of two of them, where nothing corresponds.
struct Correspondence {
  std::vector<std::uint32_t>
      hints;  ///< by vertex of the complex: a reference vertex near, on its sheet or curve
  std::vector<std::uint32_t> hosts;    ///< by reference vertex on a surface: a triangle near, of its labels
  std::vector<CurveEdge> curve_hosts;  ///< by reference vertex on a curve: an edge near, of its labels
};

/// Of a complex that is a copy of the reference.
Correspondence same_complex(const ComplexMesh& mesh);

/// Of any complex with the same table of sides: for the reference's vertices what is closest to them, or
/// nearer than `content_mm`, between the same labels; from there the hints, handed on to neighbours where
/// nothing is closest.
Correspondence nearest_parts(const ComplexMesh& mesh, const ComplexMesh& reference, double content_mm);

}  // namespace voxtet::remesh
