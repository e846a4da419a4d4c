#pragma once

#include <string>
#include <string_view>

namespace patchlight::server {

/// The text with '?' for each byte that is no part of a UTF-8 character (RFC 3629). Names in files
/// of other programs may be in any encoding; results are JSON, which is UTF-8.
std::string as_utf8(std::string_view text);

}  // namespace patchlight::server
