#pragma once

#include "server/http/accept_loop.h"
#include "server/http/exchange.h"
#include "server/http/http_application.h"

#include <functional>
#include <string>

namespace patchlight::server {

/// What goes on over one connection: request after request, each read, checked, answered and
/// noted, until somebody wants to end it.
class Conversation {
  public:
    /// Answers a request whose head is in order.
    using AnswerRequest = std::function<void(Exchange&)>;

    /// All have to outlive it.
    Conversation(HttpApplication& application, const HttpLimits& limits, AnswerRequest answer);

    void hold(Connection& connection, Lane lane) const;

  private:
    bool exchange(Exchange& exchange) const;
    bool take_head(Exchange& exchange, const std::string& text) const;
    void answer_directly(const Problem& problem, Exchange& exchange) const;

    HttpApplication& application_;
    HttpLimits limits_;
    AnswerRequest answer_;
};

}  // namespace patchlight::server
