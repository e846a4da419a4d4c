#pragma once

#include "server/http/hardened_server.h"
#include "server/http/host_check.h"
#include "server/http/http_application.h"
#include "server/http/render_route.h"
#include "server/http/request_log.h"
#include "server/http/service_settings.h"

#include <atomic>
#include <optional>
#include <string>

namespace patchlight::server {

/// What `patchlight serve` serves.
class Service final : public HttpApplication {
  public:
    /// The log has to outlive it.
    Service(const ServiceSettings& settings, RequestLog& log);

    /// Serves until stop(). Takes the listening socket over.
    void run(int listening_socket) { server_.run(listening_socket); }

    /// Nothing new is begun; what runs may end. Then it is not ready, but alive.
    void drain() { is_draining_ = true; }
    bool is_busy() const;

    /// What still runs is stopped, and answered with what there is.
    void cancel() { render_.cancel(); }

    /// Ends run(), and all connections after `patience`.
    void stop(std::chrono::milliseconds patience);

    std::optional<HttpAnswer> admit(const HttpRequest& request) override;
    HttpAnswer answer(HttpRequest& request) override;
    void note(const HttpRequest& request, const HttpAnswer& answer,
              const Delivery& delivery) override;
    void failed(const HttpRequest& request, const std::string& what) override;

  private:
    std::optional<HttpAnswer> refusal(const HttpRequest& request) const;
    std::optional<HttpAnswer> foreign(const HttpRequest& request) const;
    HttpAnswer readiness() const;

    ServiceSettings settings_;
    RequestLog& log_;
    HostCheck hosts_;
    RenderRoute render_;
    std::atomic<bool> is_draining_ = false;
    HardenedServer server_;  // last: its threads use all the others
};

}  // namespace patchlight::server
