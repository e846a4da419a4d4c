#include "tests/server/http/raw_client.h"

#include "server/http/socket_address.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace patchlight::server {

std::string RawAnswer::field(const std::string& name) const {
    const auto found = fields.find(name);
    return found == fields.end() ? "" : found->second;
}

RawClient::RawClient(int port) : socket_(connect_to("127.0.0.1", port)) {
    if (socket_ < 0) throw std::runtime_error("no connection");
    const timeval patience{30, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
}

RawClient::~RawClient() {
    if (socket_ >= 0) ::close(socket_);
}

bool RawClient::send(std::string_view bytes) {
    while (!bytes.empty()) {
        const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

bool RawClient::receive() {
    std::array<char, 65536> bytes{};
    const auto count = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (count > 0) received_.append(bytes.data(), static_cast<std::size_t>(count));
    return count > 0;
}

RawAnswer RawClient::answer(bool of_head) {
    RawAnswer answer;
    std::size_t end = 0;
    while ((end = received_.find("\r\n\r\n")) == std::string::npos)
        if (!receive()) return answer;
    std::istringstream head(received_.substr(0, end));
    received_.erase(0, end + 4);
    std::string line;
    std::getline(head, line);
    answer.status = std::atoi(line.c_str() + std::string_view("HTTP/1.1 ").size());
    while (std::getline(head, line)) {
        if (line.ends_with('\r')) line.pop_back();
        const std::size_t colon = line.find(": ");
        std::string name = line.substr(0, colon);
        for (char& letter : name) letter = static_cast<char>(std::tolower(letter));
        answer.fields[name] = line.substr(colon + 2);
    }
    const auto length =
        static_cast<std::size_t>(std::atoll(answer.field("content-length").c_str()));
    while (!of_head && received_.size() < length)
        if (!receive()) break;
    answer.body = received_.substr(0, of_head ? 0 : length);
    received_.erase(0, answer.body.size());
    return answer;
}

bool RawClient::receives_within(std::chrono::milliseconds most) const {
    pollfd polled{socket_, POLLIN, 0};
    return ::poll(&polled, 1, static_cast<int>(most.count())) > 0;
}

bool RawClient::is_closed() { return received_.empty() && !receive(); }

void RawClient::half_close() { ::shutdown(socket_, SHUT_WR); }

void RawClient::reset() {
    const linger at_once{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    ::close(socket_);
    socket_ = -1;
}

RawAnswer ask(int port, std::string_view request) {
    RawClient client(port);
    client.send(request);
    return client.answer(request.starts_with("HEAD "));
}

std::string get(const std::string& path, const std::string& fields) {
    return "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + fields + "\r\n";
}

std::string post(const std::string& path, const std::string& body, const std::string& fields) {
    return "POST " + path + " HTTP/1.1\r\nHost: localhost\r\n" + fields +
           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

}  // namespace patchlight::server
