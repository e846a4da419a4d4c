#pragma once

#include "server/http/hardened_server.h"

#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace patchlight::server {

/// Says what it was asked: POST /echo gives the body back, /throw throws, /wait waits until the
/// peer has gone.
class TestApplication final : public HttpApplication {
  public:
    std::optional<HttpAnswer> admit(const HttpRequest& request) override;
    HttpAnswer answer(HttpRequest& request) override;
    void note(const HttpRequest& request, const HttpAnswer& answer,
              const Delivery& delivery) override;
    void failed(const HttpRequest& request, const std::string& what) override;

    std::vector<int> noted_statuses() const;
    std::vector<std::string> failures() const;
    std::atomic<int> waiting = 0;   // requests to /wait that are being answered
    std::atomic<int> answered = 0;  // requests that reached answer()

  private:
    mutable std::mutex mutex_;
    std::vector<int> statuses_;
    std::vector<std::string> failures_;
};

/// A server on a free port of 127.0.0.1 for as long as it lives.
class TestServer {
  public:
    explicit TestServer(const HttpLimits& limits = {});
    ~TestServer();

    int port() const { return port_; }
    TestApplication& application() { return application_; }
    HardenedServer& server() { return server_; }

  private:
    TestApplication application_;
    HardenedServer server_;
    int port_ = 0;
    std::thread thread_;
};

/// Limits so short that a test need not wait.
HttpLimits quick_limits();

/// Whether `holds` becomes true within some seconds.
template <typename Condition>
bool eventually(const Condition& holds) {
    for (int tries = 0; tries < 1000; ++tries) {
        if (holds()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return holds();
}

}  // namespace patchlight::server
