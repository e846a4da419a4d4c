#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace patchlight::server {

/// The bytes that base64 text stands for (RFC 4648, section 4), with or without its padding. Empty
/// if it is no base64.
std::optional<std::string> decode_base64(std::string_view text);

}  // namespace patchlight::server
