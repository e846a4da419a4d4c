#include "server/http/exchange.h"

#include <stdexcept>

namespace patchlight::server {
namespace {

constexpr const char* broken = "The request is broken";

Problem problem(int status, const char* kind, const char* title, const char* detail) {
    return {status, kind, title, detail, {}};
}

}  // namespace

Problem head_problem(HeadEnd end, bool in_reserve) {
    if (in_reserve && end == HeadEnd::too_slow)
        return problem(503, "too-many-connections", "Too many connections",
                       "every connection is taken; try again");
    switch (end) {
        case HeadEnd::too_slow:
            return problem(408, "request-too-slow", "The request came too slowly",
                           "its header did not come in time");
        case HeadEnd::target_too_long:
            return problem(414, "target-too-long", "The request line is too long",
                           "shorten the path or the query");
        case HeadEnd::fields_too_long:
            return problem(431, "fields-too-large", "The header fields are too large",
                           "send fewer of them, or shorter ones");
        case HeadEnd::complete:
        case HeadEnd::closed:
            break;
    }
    throw std::logic_error("an end of a head that is no problem");
}

Problem body_problem(const Exchange& exchange, bool is_over_limit) {
    if (is_over_limit || exchange.connection.body_failure() == 413)
        return problem(413, "body-too-large", "The body is too large",
                       "the body is over the limit of this server (--max-body)");
    if (exchange.connection.body_failure() == 408)
        return problem(408, "body-too-slow", "The body came too slowly",
                       "the body did not come in time; send it again, faster");
    return problem(400, "bad-request", broken, "the body ended early, or its chunks are broken");
}

Problem bodies_problem() {
    return problem(503, "too-many-bodies", "Too many large bodies",
                   "other requests hold all the memory there is for bodies; try again");
}

Problem unreadable_request() {
    return problem(400, "bad-request", broken, "the request cannot be read");
}

Problem failure_here() {
    return problem(500, "internal", "Something failed on our side",
                   "the server's log says what, under the id of this request");
}

}  // namespace patchlight::server
