#include "server/http/conversation.h"

#include "server/http/request_id.h"

#include <chrono>

namespace patchlight::server {

Conversation::Conversation(HttpApplication& application, const HttpLimits& limits,
                           AnswerRequest answer)
    : application_(application), limits_(limits), answer_(std::move(answer)) {}

void Conversation::hold(Connection& connection, Lane lane) const {
    const std::string remote = connection.remote_address();
    const std::size_t most = lane == Lane::normal ? limits_.requests : 1;
    for (std::size_t count = 1; count <= most; ++count) {
        if (lane == Lane::normal && !connection.wait_for_request()) break;
        Exchange next{connection, {}, {}, {}, {}};
        next.request.id = new_request_id();
        next.request.remote = remote;
        next.request.in_reserve = lane == Lane::reserve;
        next.must_close = count == most || connection.is_stopping();
        if (!exchange(next)) break;
    }
    if (!connection.has_failed()) connection.linger();
}

/// Whether another request may follow.
bool Conversation::exchange(Exchange& exchange) const {
    const std::size_t written = exchange.connection.written();
    std::string text;
    const HeadEnd end = exchange.connection.read_head(
        exchange.request.in_reserve ? limits_.reserve_time : limits_.head_time, text);
    if (end == HeadEnd::closed) return false;
    const auto start = std::chrono::steady_clock::now();
    if (end != HeadEnd::complete)
        answer_directly(head_problem(end, exchange.request.in_reserve), exchange);
    else if (take_head(exchange, text))
        answer_(exchange);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    application_.note(exchange.request, exchange.answer,
                      {seconds.count(), exchange.connection.written() - written,
                       !exchange.connection.has_failed()});
    return !exchange.closes();
}

/// False if it is answered already, as it is not in order.
bool Conversation::take_head(Exchange& exchange, const std::string& text) const {
    auto read = read_request_head(text);
    if (const auto* const problem = std::get_if<Problem>(&read)) {
        answer_directly(*problem, exchange);
        return false;
    }
    exchange.head = std::get<RequestHead>(std::move(read));
    HttpRequest& request = exchange.request;
    request.method = exchange.head.method;
    request.fields = exchange.head.fields;
    request.has_body = exchange.head.has_body();
    request.announced_length = exchange.head.content_length;
    request.peer_gone = [&connection = exchange.connection] { return connection.peer_gone(); };
    if (const auto asked = request.field("X-Request-Id"); asked && is_request_id(*asked))
        request.id = *asked;
    constexpr std::size_t sizes_of_chunks = 64 << 10;  // about what they may take [bytes]
    exchange.connection.begin_body(exchange.head.is_chunked
                                       ? 2 * limits_.body_bytes + sizes_of_chunks
                                       : exchange.head.content_length);
    return true;
}

void Conversation::answer_directly(const Problem& problem, Exchange& exchange) const {
    exchange.must_close = true;
    exchange.set_answer(problem.status == 503 ? try_again_later(problem, 1.0) : answer_of(problem));
    exchange.connection.write(closing_answer_text(exchange.answer));
}

}  // namespace patchlight::server
