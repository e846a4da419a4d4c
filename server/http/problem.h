#pragma once

#include "server/http/http_message.h"

#include <nlohmann/json.hpp>

#include <string>

namespace patchlight::server {

/// What went wrong, as a client is told: a document application/problem+json.
/// Format: Nottingham et al., "Problem Details for HTTP APIs" (RFC 9457), 2023.
struct Problem {
    int status = 500;
    std::string kind;                     // "json-syntax"; its type is urn:patchlight:json-syntax
    std::string title;                    // the same for all problems of a kind
    std::string detail;                   // about this one: what is wrong, and what would be right
    nlohmann::ordered_json members = {};  // such as "pointer"
};

/// Texts that are no UTF-8, which only a client can have sent, are shown with U+FFFD.
HttpAnswer answer_of(const Problem& problem);

/// A problem whose detail names a query parameter.
Problem wrong_parameter(const std::string& parameter, const std::string& detail);

/// The answer asks to come back after `seconds`, at least 1.
HttpAnswer try_again_later(const Problem& problem, double seconds);

}  // namespace patchlight::server
