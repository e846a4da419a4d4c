#pragma once

#include <chrono>

namespace patchlight::server {

/// SIGINT and SIGTERM as events that are waited for. They are blocked from construction on, in
/// this thread and in all it makes: construct it first.
class StopSignals {
  public:
    StopSignals();

    /// Whether one came before `most` was over.
    bool wait(std::chrono::milliseconds most) const;

    /// From now on they end the program at once, with exit code 128 + signal.
    void let_through() const;
};

}  // namespace patchlight::server
