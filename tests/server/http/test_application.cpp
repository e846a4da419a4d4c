#include "tests/server/http/test_application.h"

#include "server/http/problem.h"
#include "server/http/socket_address.h"

#include <stdexcept>

namespace patchlight::server {

std::optional<HttpAnswer> TestApplication::admit(const HttpRequest& request) {
    if (request.path == "/refused") return answer_of({401, "unauthorized", "No", "never", {}});
    if (request.in_reserve && request.path != "/healthz")
        return answer_of({503, "too-many-connections", "No", "full", {}});
    if (request.method == "FOO") return answer_of({405, "method-not-allowed", "No", "never", {}});
    return std::nullopt;
}

HttpAnswer TestApplication::answer(HttpRequest& request) {
    ++answered;
    if (request.path == "/throw") throw std::runtime_error("secret of /srv/path");
    if (request.path == "/throw-number") throw 7;
    if (request.path == "/wait") {
        ++waiting;
        while (!request.peer_gone()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        --waiting;
    }
    HttpAnswer answer;
    answer.content_type = "text/plain";
    answer.body = request.path == "/remote"  ? request.remote
                  : request.path == "/large" ? std::string(8 << 20, 'x')
                                             : request.body;
    return answer;
}

void TestApplication::note(const HttpRequest&, const HttpAnswer& answer, const Delivery&) {
    const std::lock_guard lock(mutex_);
    statuses_.push_back(answer.status);
}

void TestApplication::failed(const HttpRequest&, const std::string& what) {
    const std::lock_guard lock(mutex_);
    failures_.push_back(what);
}

std::vector<int> TestApplication::noted_statuses() const {
    const std::lock_guard lock(mutex_);
    return statuses_;
}

std::vector<std::string> TestApplication::failures() const {
    const std::lock_guard lock(mutex_);
    return failures_;
}

TestServer::TestServer(const HttpLimits& limits) : server_(application_, limits) {
    const Listener listener = listen_on("127.0.0.1", 0);
    port_ = listener.port;
    thread_ = std::thread([this, socket = listener.socket] { server_.run(socket); });
}

TestServer::~TestServer() {
    server_.stop();
    thread_.join();
}

HttpLimits quick_limits() {
    using std::chrono::milliseconds;
    HttpLimits limits;
    limits.head_time = milliseconds(300);
    limits.idle_time = milliseconds(300);
    limits.body_time = milliseconds(600);
    limits.reserve_time = milliseconds(100);
    limits.body_bytes = 1 << 20;
    return limits;
}

}  // namespace patchlight::server
