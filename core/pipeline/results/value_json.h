// Values of types/ as the JSON of reports.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

#include "types/label_volume.h"

namespace voxtet {

/// Sixteen numbers, row by row.
nlohmann::json matrix_json(const Eigen::Matrix4d& m);

/// {size, spacing_mm, index_to_mm, digest, labels: [{label, name, colour, voxels}]}.
nlohmann::json volume_json(const LabelVolume& volume, const std::string& digest);

}  // namespace voxtet
