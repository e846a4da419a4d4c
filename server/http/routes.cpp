#include "server/http/routes.h"

#include "server/http/problem.h"
#include "server/wording.h"

#include <algorithm>
#include <array>

namespace patchlight::server {
namespace {

constexpr std::array routes{
    Route{RouteName::health, "/healthz", "GET, HEAD, OPTIONS", true},
    Route{RouteName::readiness, "/readyz", "GET, HEAD, OPTIONS", true},
    Route{RouteName::render, "/v1/render", "POST, OPTIONS", false},
};

/// A line goes when its feature comes.
constexpr std::array<std::string_view, 3> not_built{"/metrics", "/v1/openapi.json", "/"};

bool is_not_built(std::string_view path) {
    return path == "/v1/jobs" || path.starts_with("/v1/jobs/") ||
           std::find(not_built.begin(), not_built.end(), path) != not_built.end();
}

}  // namespace

const Route* find_route(std::string_view path) {
    for (const Route& route : routes)
        if (route.path == path) return &route;
    return nullptr;
}

bool takes_method(const Route& route, std::string_view method) {
    std::string_view methods = route.methods;
    while (!methods.empty()) {
        const std::size_t end = std::min(methods.find(", "), methods.size());
        if (methods.substr(0, end) == method) return true;
        methods.remove_prefix(std::min(end + 2, methods.size()));
    }
    return false;
}

HttpAnswer no_such_path(const std::string& path) {
    const std::string there = "; there are POST /v1/render, GET /healthz and GET /readyz";
    if (is_not_built(path))
        return answer_of({404,
                          "not-built",
                          "Not built yet",
                          in_quotes(path.substr(0, 60)) + " is not built yet" + there,
                          {}});
    return answer_of(
        {404, "not-found", "No such path", "there is no " + in_quotes(path) + there, {}});
}

HttpAnswer allowed_methods(const Route& route, std::string_view method) {
    HttpAnswer answer;
    answer.status = 204;
    if (method != "OPTIONS")
        answer = answer_of({405,
                            "method-not-allowed",
                            "The path does not take this method",
                            std::string(route.path) + " takes " + std::string(route.methods),
                            {}});
    answer.fields.emplace_back("Allow", route.methods);
    return answer;
}

}  // namespace patchlight::server
