// What is wrong with a request for the heart's surfaces.
#pragma once

#include <optional>
#include <string>

#include "anatomy/find_heart_surfaces.h"

namespace voxtet::anatomy {

/// kUsage: "physics.anatomy.FIELD: found ..., expected ...".
Error anatomy_error(const std::string& field, const std::string& found, const std::string& expected);

/// "1, 2, 5".
std::string list_of(const std::vector<Label>& labels);

/// The first complaint about the labels, if any.
std::optional<Error> check_labels(const TetMesh& mesh, const LabelVolume& image, const AnatomyParams& params);

}  // namespace voxtet::anatomy
