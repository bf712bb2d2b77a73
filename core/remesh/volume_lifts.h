// How far to lift sheets so that labels get their volumes back.
#pragma once

#include <vector>

#include "remesh/complex_mesh.h"

namespace voxtet::remesh {

/// Volume by label, mm^3, relative to one point of the complex; entry 0 (background) means nothing.
std::vector<double> label_volumes(const ComplexMesh& mesh);

/// Area by pair of labels, mm^2.
std::vector<double> pair_areas(const ComplexMesh& mesh);

/// By pair of labels, a lift in mm along the normals that to first order gives each label the volume it
/// lacks: lambda_behind - lambda_front, which of all such lifts has the least area-weighted square. At most
/// `most_mm`. `lacking_mm3` by label; entry 0 (background) means nothing.
std::vector<double> volume_lifts(const std::vector<Sides>& pairs, const std::vector<double>& areas_mm2,
                                 const std::vector<double>& lacking_mm3, double most_mm);

}  // namespace voxtet::remesh
