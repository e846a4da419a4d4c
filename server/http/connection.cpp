#include "server/http/connection.h"

#include "server/http/socket_address.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace patchlight::server {
namespace {

using std::chrono::milliseconds;

milliseconds until(std::chrono::steady_clock::time_point deadline) {
    return std::chrono::duration_cast<milliseconds>(deadline - std::chrono::steady_clock::now());
}

}  // namespace

Connection::Connection(int socket, const HttpLimits& limits, const std::atomic<bool>& is_stopping)
    : socket_(socket), limits_(limits), is_stopping_(is_stopping) {
    const int yes = 1;  // answers go out in one or two pieces; waiting for more would only delay
    ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
}

Connection::~Connection() { ::close(socket_); }

bool Connection::wait(short event, milliseconds most) const {
    const Clock::time_point deadline = Clock::now() + most;
    pollfd polled{socket_, event, 0};
    for (;;) {
        const auto left = std::max(until(deadline), milliseconds(0));
        const int ready = ::poll(&polled, 1, static_cast<int>(left.count()));
        if (ready >= 0 || errno != EINTR) return ready > 0;
    }
}

bool Connection::wait_for_request() {
    constexpr milliseconds slice{100};  // after which the server's end is noticed
    const Clock::time_point deadline = Clock::now() + limits_.idle_time;
    while (begin_ == end_) {
        if (is_stopping_ || Clock::now() >= deadline) return false;
        if (wait(POLLIN, slice)) return fill(deadline);
    }
    return true;
}

/// Reads what there is, or waits for the first byte; false at the end, failing or too late.
bool Connection::fill(Clock::time_point deadline) {
    for (;;) {
        const milliseconds left = until(deadline);
        if (left <= milliseconds(0) || !wait(POLLIN, left)) return false;
        const auto count = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
        if (count < 0 && (errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK)) continue;
        has_failed_ = count <= 0;
        begin_ = 0;
        end_ = has_failed_ ? 0 : static_cast<std::size_t>(count);
        return !has_failed_;
    }
}

HeadEnd Connection::read_head(milliseconds most, std::string& head) {
    const Clock::time_point deadline = Clock::now() + most;
    std::size_t line = 0;  // where the current one begins
    std::size_t lines = 0;
    head.clear();
    for (;;) {
        if (begin_ == end_ && !fill(deadline))
            return has_failed_ ? HeadEnd::closed : HeadEnd::too_slow;
        const char byte = buffer_[begin_++];
        head += byte;
        if (head == "\r\n") head.clear();  // some clients end a body with it: RFC 9112 2.2
        if (head.size() - line > limits_.line_bytes)
            return lines == 0 ? HeadEnd::target_too_long : HeadEnd::fields_too_long;
        if (head.size() > limits_.head_bytes) return HeadEnd::fields_too_long;
        if (byte != '\n') continue;
        const std::size_t length = head.size() - line;
        if (lines > 0 && length <= 2) return HeadEnd::complete;
        if (++lines > limits_.fields + 1) return HeadEnd::fields_too_long;
        line = head.size();
    }
}

void Connection::begin_body(std::size_t most_bytes_on_the_wire) {
    body_bytes_ = 0;
    most_body_bytes_ = most_bytes_on_the_wire;
    body_failure_ = 0;
    body_deadline_ = Clock::now() + limits_.body_time;
}

std::ptrdiff_t Connection::read_body(char* bytes, std::size_t count) {
    if (has_failed_ || body_failure_ != 0) return -1;
    if (body_bytes_ >= most_body_bytes_) {
        body_failure_ = 413;
        return -1;
    }
    if (begin_ == end_ && !fill(std::min(body_deadline_, Clock::now() + limits_.idle_time))) {
        if (!has_failed_) body_failure_ = 408;
        return has_failed_ ? 0 : -1;
    }
    const std::size_t taken = std::min(count, end_ - begin_);
    std::memcpy(bytes, buffer_.data() + begin_, taken);
    begin_ += taken;
    body_bytes_ += taken;
    return static_cast<std::ptrdiff_t>(taken);
}

bool Connection::write(std::string_view bytes) {
    const Clock::time_point deadline = Clock::now() + limits_.write_time;
    while (!has_failed_ && !bytes.empty()) has_failed_ = !write_some(bytes, deadline);
    return !has_failed_;
}

bool Connection::write_some(std::string_view& bytes, Clock::time_point deadline) {
    const milliseconds left = std::min(until(deadline), limits_.write_idle_time);
    if (left <= milliseconds(0) || !wait(POLLOUT, left)) return false;
    const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0) return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
    written_ += static_cast<std::size_t>(sent);
    return true;
}

bool Connection::peer_gone() const {
    pollfd polled{socket_, POLLRDHUP, 0};
    if (::poll(&polled, 1, 0) > 0 && (polled.revents & (POLLRDHUP | POLLHUP | POLLERR)) != 0)
        return true;
    char byte = 0;
    const auto count = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

void Connection::linger() {
    constexpr std::size_t most_bytes = std::size_t{1} << 20;
    constexpr milliseconds longest{500};
    const Clock::time_point deadline = Clock::now() + longest;
    ::shutdown(socket_, SHUT_WR);
    begin_ = end_ = 0;
    std::size_t dropped = 0;
    while (dropped < most_bytes && fill(deadline)) dropped += end_;
}

std::string Connection::remote_address() const { return peer_address(socket_); }

}  // namespace patchlight::server
