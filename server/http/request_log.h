#pragma once

#include "server/http/http_application.h"

#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace patchlight::server {

/// Lines of JSON on standard error, one a request. Nothing a client sends can end a line or leave
/// its text; neither queries nor tokens are written.
class RequestLog {
  public:
    explicit RequestLog(bool is_quiet);

    void request(const HttpRequest& request, const HttpAnswer& answer, const Delivery& delivery);
    void failure(const HttpRequest& request, const std::string& what);
    void event(const std::string& what);

  private:
    std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace patchlight::server
