#pragma once

#include "server/http/http_limits.h"

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace patchlight::server {

/// Where a new connection goes.
enum class Lane : std::uint8_t {
    normal,
    reserve,  // too many are open: health checks alone, and they have to be quick
    refused,  // even the reserve is full
};

/// How many connections are open, in all and from each address.
class ConnectionCount {
  public:
    explicit ConnectionCount(const HttpLimits& limits) : limits_(limits) {}

    /// Counts a connection, unless it is refused. Loopback addresses have no limit of their own,
    /// as a reverse proxy would be one.
    Lane enter(const std::string& address);

    void leave(const std::string& address, Lane lane);

    std::size_t open() const;
    void wait_until_none() const;

  private:
    HttpLimits limits_;
    mutable std::mutex mutex_;
    mutable std::condition_variable left_;
    std::size_t normal_ = 0;
    std::size_t reserve_ = 0;
    std::map<std::string, std::size_t> by_address_;
};

}  // namespace patchlight::server
