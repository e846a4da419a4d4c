#pragma once

#include <string>
#include <string_view>

namespace patchlight::server {

/// One key as it stands in a JSON pointer: "~" is written "~0", "/" is written "~1" (RFC 6901).
std::string escaped_for_pointer(std::string_view key);

}  // namespace patchlight::server
