#pragma once

#include <chrono>
#include <cstddef>

namespace patchlight::server {

/// What a client may ask of a connection. All deadlines are totals: a byte now and then does not
/// extend them.
struct HttpLimits {
    std::size_t line_bytes = 8000;              // of the request line or of one field [bytes]
    std::size_t head_bytes = 32 << 10;          // of request line and fields together [bytes]
    std::size_t fields = 100;                   // in one request
    std::size_t body_bytes = 64 << 20;          // of one body [bytes]
    std::size_t all_body_bytes = 256 << 20;     // of all bodies being held at one time [bytes]
    std::size_t requests = 1000;                // on one connection
    std::size_t connections = 64;               // at one time
    std::size_t connections_per_address = 32;   // the same, from one address that is not loopback
    std::size_t reserve = 16;                   // connections beyond those, for health checks alone
    std::chrono::milliseconds head_time{5000};  // from the first byte of a request to its body
    std::chrono::milliseconds reserve_time{250};   // the same, for the reserve
    std::chrono::milliseconds idle_time{5000};     // between requests, or between bytes of a body
    std::chrono::milliseconds body_time{120'000};  // for a whole body
    std::chrono::milliseconds write_time{60'000};  // for a whole answer
    std::chrono::milliseconds write_idle_time{10'000};  // for the peer to take any of it
};

}  // namespace patchlight::server
