// A case as the fragment of a link: "#c1=" + base64url(deflate-raw(canonical JSON of the non-default
// fields)), or "#j=" + percent-encoded JSON, for people who write links by hand.
#pragma once

#include <string>
#include <string_view>

#include "recipe/recipe.h"
#include "types/result.h"

namespace voxtet {

/// The compressed fragment, "#c1=...".
std::string link_fragment(const Recipe& recipe);

/// Whether a text holds such a fragment (a bare fragment or a whole URL).
bool is_link(std::string_view text);

/// Recipe of a fragment or URL. Errors: kUsage (no fragment, damaged, inflating above 1 MiB, invalid recipe).
Result<Recipe> recipe_of_link(std::string_view text);

}  // namespace voxtet
