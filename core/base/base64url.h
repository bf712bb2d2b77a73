// Bytes as text that a link can hold.
#pragma once

#include <string>
#include <string_view>

#include "types/result.h"

namespace voxtet {

/// Base64url (RFC 4648, section 5) without padding.
std::string base64url(std::string_view bytes);

/// The bytes of such a text. Errors, of `stage`: kUsage naming `holder` and the first character that has no
/// place in it.
Result<std::string> from_base64url(std::string_view text, const std::string& stage,
                                   const std::string& holder);

}  // namespace voxtet
