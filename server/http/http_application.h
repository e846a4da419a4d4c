#pragma once

#include "server/http/http_message.h"

#include <cstddef>
#include <optional>
#include <string>

namespace patchlight::server {

/// How an answer went out.
struct Delivery {
    double seconds = 0.0;   // from the request's head to the end of the answer
    std::size_t bytes = 0;  // on the wire
    bool is_whole = true;   // the peer took all of it
};

/// What the server serves. Called from as many threads as there are connections.
class HttpApplication {
  public:
    virtual ~HttpApplication() = default;

    /// Before any of the body is read: an answer ends the matter.
    virtual std::optional<HttpAnswer> admit(const HttpRequest& request) = 0;

    /// With the body. What it throws is answered by 500, and told to `failed` alone.
    virtual HttpAnswer answer(HttpRequest& request) = 0;

    /// After each answer, those that the server gave by itself included.
    virtual void note(const HttpRequest& request, const HttpAnswer& answer,
                      const Delivery& delivery) = 0;

    /// What no client is told.
    virtual void failed(const HttpRequest& request, const std::string& what) = 0;
};

}  // namespace patchlight::server
