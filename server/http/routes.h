#pragma once

#include "server/http/http_message.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace patchlight::server {

enum class RouteName : std::uint8_t { health, readiness, render };

/// A path that is there.
struct Route {
    RouteName name;
    std::string_view path;
    std::string_view methods;  // as in Allow: "GET, HEAD, OPTIONS"
    bool is_public;            // needs no token
};

const Route* find_route(std::string_view path);

bool takes_method(const Route& route, std::string_view method);

/// 404; for what the contract names but this version lacks, it says so.
HttpAnswer no_such_path(const std::string& path);

/// 405 with Allow, or 204 if the method is OPTIONS.
HttpAnswer allowed_methods(const Route& route, std::string_view method);

}  // namespace patchlight::server
