#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace patchlight::server {

/// Which of `offered` (the first is the favourite) a field Accept likes best; nothing if it takes
/// none of them. No field, or an empty one, takes anything.
/// Quality values: "HTTP Semantics" (RFC 9110), 12.5.1.
std::optional<std::string> negotiated_type(std::optional<std::string_view> accept,
                                           std::span<const std::string> offered);

/// The type in a field Content-Type, in small letters and without parameters: "application/json".
std::string media_type(std::string_view content_type);

}  // namespace patchlight::server
