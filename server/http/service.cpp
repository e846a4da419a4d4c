#include "server/http/service.h"

#include "server/http/access_token.h"
#include "server/http/problem.h"
#include "server/http/routes.h"
#include "server/wording.h"

#include <stdexcept>
#include <thread>

namespace patchlight::server {
namespace {

HttpAnswer problem_answer(int status, const char* kind, const char* title,
                          const std::string& detail) {
    return answer_of({status, kind, title, detail, {}});
}

HttpAnswer unavailable(const char* kind, const char* title, const char* detail) {
    return try_again_later({503, kind, title, detail, {}}, 1.0);
}

HttpAnswer state(const char* word) {
    HttpAnswer answer;
    answer.content_type = "application/json";
    answer.body = std::string("{\"status\": \"") + word + "\"}\n";
    return answer;
}

HttpAnswer unauthorized() {
    HttpAnswer answer =
        problem_answer(401, "unauthorized", "A token is needed",
                       "send the field `Authorization: Bearer TOKEN` with the token that "
                       "the server was started with");
    answer.fields.emplace_back("WWW-Authenticate", "Bearer realm=\"patchlight\"");
    return answer;
}

}  // namespace

Service::Service(const ServiceSettings& settings, RequestLog& log)
    : settings_(settings),
      log_(log),
      hosts_(settings.host, settings.allowed_hosts),
      render_(settings.render, settings.threads),
      server_(*this, settings.http) {}

bool Service::is_busy() const { return render_.queue().running() + render_.queue().waiting() > 0; }

void Service::stop(std::chrono::milliseconds patience) {
    constexpr std::chrono::milliseconds slice{10};
    server_.stop();
    for (auto waited = slice; waited < patience && server_.open_connections() > 0; waited += slice)
        std::this_thread::sleep_for(slice);
    server_.abandon();
}

std::optional<HttpAnswer> Service::admit(const HttpRequest& request) {
    std::optional<HttpAnswer> answer = refusal(request);
    if (const Route* const route = find_route(request.path); answer && route)
        answer->route = route->path;
    return answer;
}

std::optional<HttpAnswer> Service::refusal(const HttpRequest& request) const {
    const Route* const route = find_route(request.path);
    const bool is_public = route && route->is_public;
    if (request.in_reserve && !is_public)
        return unavailable("too-many-connections", "Too many connections",
                           "every connection is taken; try again");
    if (auto answer = foreign(request)) return answer;
    if (settings_.token && !is_public && !shows_token(request, *settings_.token))
        return unauthorized();
    if (!route) return no_such_path(request.path);
    if (!takes_method(*route, request.method) || request.method == "OPTIONS")
        return allowed_methods(*route, request.method);
    if (is_public) return std::nullopt;
    if (is_draining_)
        return unavailable("shutting-down", "The server is shutting down",
                           "send it to another, or later");
    return render_.admit(request);
}

/// Asked by a page that is none of ours.
std::optional<HttpAnswer> Service::foreign(const HttpRequest& request) const {
    const auto host = request.field("Host");
    if (host && !hosts_.passes(*host))
        return problem_answer(403, "host-refused", "Unknown host",
                              "this server does not go by the name " + in_quotes(*host) +
                                  "; if it should, start it with --allow-host");
    if (const auto origin = request.field("Origin"); origin && !is_same_origin(*origin, host))
        return problem_answer(403, "origin-refused", "Pages from elsewhere are refused",
                              "this server does not serve pages of " + in_quotes(*origin));
    return std::nullopt;
}

HttpAnswer Service::answer(HttpRequest& request) {
    const Route* const route = find_route(request.path);
    if (!route) throw std::logic_error("a request without a route was admitted");
    const auto chosen = [&] {
        switch (route->name) {
            case RouteName::health:
                return state("alive");
            case RouteName::readiness:
                return readiness();
            case RouteName::render:
                return render_.answer(request);
        }
        throw std::logic_error("a route without an answer");
    };
    HttpAnswer answer = chosen();
    answer.route = route->path;
    return answer;
}

HttpAnswer Service::readiness() const {
    if (is_draining_)
        return unavailable("shutting-down", "The server is shutting down",
                           "send nothing more to it");
    if (render_.queue().is_full())
        return unavailable("queue-full", "Too many renders wait already", "send it later");
    return state("ready");
}

void Service::note(const HttpRequest& request, const HttpAnswer& answer, const Delivery& delivery) {
    log_.request(request, answer, delivery);
}

void Service::failed(const HttpRequest& request, const std::string& what) {
    log_.failure(request, what);
}

}  // namespace patchlight::server
