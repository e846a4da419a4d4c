#pragma once

#include "server/http/http_limits.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace patchlight::server {

/// How reading the head of a request ended.
enum class HeadEnd : std::uint8_t { complete, closed, too_slow, target_too_long, fields_too_long };

/// An accepted TCP connection, with a deadline on everything. Not for several threads, but for
/// peer_gone.
class Connection {
  public:
    /// Takes the socket over. `is_stopping` ends waits between requests.
    Connection(int socket, const HttpLimits& limits, const std::atomic<bool>& is_stopping);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// Waits for the first byte of a request; false if none comes in time.
    bool wait_for_request();

    /// Reads to the end of the empty line after the header fields, into `head`.
    HeadEnd read_head(std::chrono::milliseconds most, std::string& head);

    /// From now on read_body counts anew.
    void begin_body(std::size_t most_bytes_on_the_wire);

    /// As ::recv: bytes of the body that is being read, 0 at the end, -1 after a failure, which
    /// body_failure tells.
    std::ptrdiff_t read_body(char* bytes, std::size_t count);

    /// Status of the answer that body failure deserves: 408 too slow, 413 too large, 0 none.
    int body_failure() const { return body_failure_; }

    /// Bytes of the body that were read.
    std::size_t body_bytes() const { return body_bytes_; }

    /// All of it, or nothing more ever after. False once it failed.
    bool write(std::string_view bytes);

    bool is_stopping() const { return is_stopping_; }
    bool has_failed() const { return has_failed_; }
    std::size_t written() const { return written_; }  // so far, in all [bytes]

    /// Whether the peer has closed its end or reset the connection. Half-closed counts as gone.
    bool peer_gone() const;

    /// Tells the peer that nothing more will come and reads what it is still sending for a moment:
    /// closing at once would reset the connection, and the answer could be lost on its way.
    void linger();

    std::string remote_address() const;

  private:
    using Clock = std::chrono::steady_clock;

    bool wait(short event, std::chrono::milliseconds most) const;
    bool fill(Clock::time_point deadline);
    bool write_some(std::string_view& bytes, Clock::time_point deadline);

    int socket_;
    HttpLimits limits_;
    const std::atomic<bool>& is_stopping_;
    std::array<char, 16384> buffer_{};
    std::size_t begin_ = 0;  // of what is read but not used yet
    std::size_t end_ = 0;
    Clock::time_point body_deadline_;
    std::size_t body_bytes_ = 0;
    std::size_t most_body_bytes_ = 0;
    int body_failure_ = 0;
    bool has_failed_ = false;
    std::size_t written_ = 0;
};

}  // namespace patchlight::server
