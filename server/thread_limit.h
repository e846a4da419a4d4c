#pragma once

#include <tbb/global_control.h>

#include <optional>

namespace patchlight::server {

/// While it lives, no more than `threads` threads work; 0 leaves it at all cores.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads) {
        if (threads > 0)
            control_.emplace(tbb::global_control::max_allowed_parallelism,
                             static_cast<std::size_t>(threads));
    }

  private:
    std::optional<tbb::global_control> control_;
};

}  // namespace patchlight::server
