// Which part of a complex corresponds to which part of the reference.
#pragma once

#include <cstdint>
#include <vector>

#include "remesh/complex/complex_mesh.h"
#include "remesh/complex/edit.h"

namespace voxtet::remesh {

/// kNone, or an edge of two kNone, if nothing corresponds.
struct Correspondence {
  std::vector<std::uint32_t>
      hints;  ///< by vertex of the complex: a near reference vertex on its sheet or curve
  std::vector<std::uint32_t> hosts;    ///< by reference vertex on a surface: a near triangle with its labels
  std::vector<CurveEdge> curve_hosts;  ///< by reference vertex on a curve: a near edge with its labels
};

/// For a complex that is a copy of the reference.
Correspondence same_complex(const ComplexMesh& mesh);

/// For any complex with the same table of sides. For each vertex of the reference, finds the part between the
/// same labels that is closest, or any that is nearer than `content_mm`. The hints follow from this; where
/// nothing is closest, they are taken from neighbours.
Correspondence nearest_parts(const ComplexMesh& mesh, const ComplexMesh& reference, double content_mm);

}  // namespace voxtet::remesh
