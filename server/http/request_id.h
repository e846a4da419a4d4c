#pragma once

#include <string>
#include <string_view>

namespace patchlight::server {

/// 16 hexadecimal digits that no request before it had.
std::string new_request_id();

/// Whether a client's own X-Request-Id may go into answers and logs: 1 to 64 letters, digits,
/// dots, underlines and hyphens.
bool is_request_id(std::string_view text);

}  // namespace patchlight::server
