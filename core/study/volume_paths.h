// Which volumes a pattern means.
#pragma once

#include <string>
#include <vector>

#include "types/result.h"

namespace voxtet {

/// As paths from the folder, sorted; in each part of the pattern * stands for any text and ? for one
/// character. A path without them need not be there. Errors: kBadInput if there is none, and for a name that
/// no table can hold.
Result<std::vector<std::string>> volumes_like(const std::string& folder, const std::string& text);

}  // namespace voxtet
