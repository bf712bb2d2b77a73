// Volumes and areas of a complex, label by label.
#pragma once

#include <vector>

#include "remesh/complex/complex_mesh.h"

namespace voxtet::remesh {

/// Volume by label, mm^3, relative to one point of the complex; entry 0 (background) has no meaning.
std::vector<double> label_volumes(const ComplexMesh& mesh);

/// Area by pair of labels, mm^2.
std::vector<double> pair_areas(const ComplexMesh& mesh);

}  // namespace voxtet::remesh
