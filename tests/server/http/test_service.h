#pragma once

#include "server/http/service.h"

#include <string>
#include <thread>

namespace patchlight::server {

/// The service on a free port of 127.0.0.1 for as long as it lives; its log is silent.
class TestService {
  public:
    explicit TestService(const ServiceSettings& settings = {});
    ~TestService();

    int port() const { return port_; }
    Service& service() { return service_; }

  private:
    RequestLog log_{true};
    Service service_;
    int port_ = 0;
    std::thread thread_;
};

/// A scene that is solved in some ms: a lamp over a floor, seen by the cameras "above" and "aside".
std::string quick_scene();

/// One that would take minutes.
std::string slow_scene();

}  // namespace patchlight::server
