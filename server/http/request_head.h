#pragma once

#include "server/http/http_message.h"
#include "server/http/problem.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>

namespace patchlight::server {

/// Request line and header fields of a request that may be handed on: only what RFC 9112 allows,
/// and of that only what two programs in a row cannot read in two ways, for that is what request
/// smuggling lives on.
struct RequestHead {
    std::string method;
    std::string target;
    bool is_http_1_0 = false;
    NamedValues fields;
    bool has_length = false;
    std::size_t content_length = 0;  // [bytes]
    bool is_chunked = false;
    bool expects_continue = false;
    bool keeps_alive = true;

    bool has_body() const { return is_chunked || content_length > 0; }
};

/// Reads the bytes up to and including the empty line. Whatever is wrong is told as a Problem of
/// status 400, 413 or 417.
std::variant<RequestHead, Problem> read_request_head(std::string_view bytes);

/// Whether `text` is a token as RFC 9110 5.6.2 has it, such as the name of a field.
bool is_token(std::string_view text);

}  // namespace patchlight::server
