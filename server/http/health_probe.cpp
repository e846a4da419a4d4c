#include "server/http/health_probe.h"

#include "server/http/socket_address.h"

#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string_view>

namespace patchlight::server {
namespace {

constexpr std::string_view request =
    "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";

/// The first bytes of the answer; fewer if it ends before.
std::string beginning_of_answer(int socket) {
    constexpr std::size_t enough = 12;  // "HTTP/1.1 200"
    static_cast<void>(::send(socket, request.data(), request.size(), MSG_NOSIGNAL));
    std::string text;
    while (text.size() < enough) {
        std::array<char, 256> bytes{};
        const auto count = ::recv(socket, bytes.data(), bytes.size(), 0);
        if (count <= 0) break;
        text.append(bytes.data(), static_cast<std::size_t>(count));
    }
    return text;
}

}  // namespace

std::string health_problem(const std::string& host, int port) {
    int socket = -1;
    try {
        socket = connect_to(host, port);
    } catch (const std::runtime_error& problem) {
        return problem.what();
    }
    if (socket < 0) return "nothing listens on " + host + " port " + std::to_string(port);
    const timeval patience{3, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    const std::string answer = beginning_of_answer(socket);
    ::close(socket);
    if (answer.starts_with("HTTP/1.1 200")) return "";
    return answer.empty() ? "no answer" : "the answer began with " + answer.substr(0, 12);
}

}  // namespace patchlight::server
