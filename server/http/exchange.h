#pragma once

#include "server/http/chunk_check.h"
#include "server/http/connection.h"
#include "server/http/http_message.h"
#include "server/http/request_head.h"

#include <utility>

namespace patchlight::server {

/// One request on its way to its answer.
struct Exchange {
    Connection& connection;
    RequestHead head;
    HttpRequest request;
    HttpAnswer answer;
    ChunkCheck chunks;  // of its body
    bool is_answered = false;
    bool must_close = false;  // whatever the answer says

    /// What is left of a body would be taken for the next request: this is how requests are
    /// smuggled. A body in chunks counts as unread, as its end is not for us to tell.
    bool has_unread_body() const {
        return head.is_chunked || connection.body_bytes() < head.content_length;
    }

    bool closes() const {
        return must_close || answer.closes || !head.keeps_alive || has_unread_body() ||
               connection.has_failed();
    }

    void set_answer(HttpAnswer its_answer) {
        answer = std::move(its_answer);
        add_common_fields(request.id, answer);
        is_answered = true;
    }
};

/// What may go wrong before the application is reached.
Problem head_problem(HeadEnd end, bool in_reserve);
Problem body_problem(const Exchange& exchange, bool is_over_limit);
Problem bodies_problem();
Problem unreadable_request();
Problem failure_here();

}  // namespace patchlight::server
