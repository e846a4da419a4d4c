#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace patchlight::server {

/// Names and values, such as header fields or query parameters, in the order they were sent.
using NamedValues = std::vector<std::pair<std::string, std::string>>;

/// What a client asks.
struct HttpRequest {
    std::string id;           // goes into the answer and into the log
    std::string method;       // as it was sent: "GET"
    std::string path;         // percent-decoded, without the query
    NamedValues query;        // percent-decoded
    NamedValues fields;       // of the header, as they were sent
    std::string remote;       // address of the peer
    bool in_reserve = false;  // on a connection beyond the limit: for health checks alone
    bool has_body = false;
    std::size_t announced_length = 0;  // of the body; 0 if it comes in chunks [bytes]
    std::string body;
    std::function<bool()> peer_gone;  // whether nobody waits for the answer any more

    /// The first field of that name, in small letters or capitals.
    std::optional<std::string_view> field(std::string_view name) const;
};

/// What it gets.
struct HttpAnswer {
    int status = 200;
    std::string content_type;
    std::string body;
    NamedValues fields;       // beside those that every answer has
    bool closes = false;      // the connection ends with it
    std::string route = "-";  // its pattern, for the log
};

/// Whether two names of fields are the same: small letters and capitals are.
bool same_field(std::string_view one, std::string_view other);

/// Adds the fields that every answer carries: its request's id, the date, and what keeps browsers
/// from guessing a type or keeping a copy.
void add_common_fields(const std::string& request_id, HttpAnswer& answer);

/// The whole answer as bytes of HTTP/1.1, ending the connection; for what goes wrong where no
/// library has been reached yet.
std::string closing_answer_text(const HttpAnswer& answer, bool without_body = false);

/// Such as "Not Found".
std::string_view reason_phrase(int status);

}  // namespace patchlight::server
