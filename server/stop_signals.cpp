#include "server/stop_signals.h"

#include <csignal>
#include <cstdlib>
#include <ctime>

namespace patchlight::server {
namespace {

sigset_t stop_signals() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    return set;
}

/// The program may be the first one of a container, where signals do nothing by themselves.
void end_at_once(int signal) {
    constexpr int ended_by_signal = 128;  // as shells say it
    std::_Exit(ended_by_signal + signal);
}

}  // namespace

StopSignals::StopSignals() {
    const sigset_t set = stop_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

bool StopSignals::wait(std::chrono::milliseconds most) const {
    const sigset_t set = stop_signals();
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(most);
    const std::chrono::nanoseconds rest = most - seconds;
    const std::timespec timeout{static_cast<std::time_t>(seconds.count()),
                                static_cast<long>(rest.count())};
    return sigtimedwait(&set, nullptr, &timeout) > 0;
}

void StopSignals::let_through() const {
    const sigset_t set = stop_signals();
    std::signal(SIGINT, end_at_once);
    std::signal(SIGTERM, end_at_once);
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace patchlight::server
