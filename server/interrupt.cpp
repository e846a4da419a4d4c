#include "server/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>

namespace patchlight::server {
namespace {

using Clock = std::chrono::steady_clock;

// What is sent to a program and its group at once, as `timeout` does, is one wish to stop, not two.
constexpr Clock::duration same_wish = std::chrono::milliseconds(200);

volatile std::sig_atomic_t interrupted = 0;
std::atomic<Clock::rep> first_heard = 0;
static_assert(std::atomic<Clock::rep>::is_always_lock_free);

/// The first time the work is asked to end; after that the program is ended at once.
void note_interrupt(int signal) {
    const Clock::duration now = Clock::now().time_since_epoch();
    if (interrupted == 0) {
        first_heard = now.count();
        interrupted = 1;
    } else if (now - Clock::duration(first_heard) > same_wish) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, note_interrupt);
    std::signal(SIGTERM, note_interrupt);
}

bool is_interrupted() { return interrupted != 0; }

}  // namespace patchlight::server
