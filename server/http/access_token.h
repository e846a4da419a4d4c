#pragma once

#include "server/http/http_message.h"

#include <optional>
#include <string>
#include <string_view>

namespace patchlight::server {

/// Whether a request shows the token: "Authorization: Bearer <token>". How long the comparison
/// takes tells nothing about the token.
bool shows_token(const HttpRequest& request, std::string_view token);

/// The token that is configured: the first line of `file`, else the environment variable
/// PATCHLIGHT_TOKEN, else none. Throws WrongInput if it cannot be read or would not do.
std::optional<std::string> configured_token(const std::optional<std::string>& file);

/// 32 hexadecimal digits, 128 bits of chance.
std::string random_token();

}  // namespace patchlight::server
