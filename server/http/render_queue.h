#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>

namespace patchlight::server {

/// A few solves at a time, in the order they came, with a short queue behind them: a long one
/// would only hold answers that nobody waits for any more.
class RenderQueue {
  public:
    RenderQueue(int at_once, int waiting);

    /// A place in the queue, then a turn; given back at the end.
    class Place {
      public:
        explicit Place(RenderQueue& queue);
        ~Place();
        Place(const Place&) = delete;
        Place& operator=(const Place&) = delete;

        /// Whether the queue had room.
        bool is_taken() const { return number_ != none; }

        /// Waits for the turn. False if `gives_up`, which is asked every few ms, said so first.
        bool wait(const std::function<bool()>& gives_up);

      private:
        static constexpr std::uint64_t none = 0;
        RenderQueue& queue_;
        std::uint64_t number_ = none;
        bool is_running_ = false;
        double started_ = 0.0;  // [s]
    };

    bool is_full() const;
    int running() const;
    int waiting() const;

    /// After how long it is worth trying again when it is full [s].
    double seconds_until_room() const;

  private:
    bool has_room() const;

    const std::size_t at_once_;
    const std::size_t most_waiting_;
    mutable std::mutex mutex_;
    std::condition_variable moved_;
    std::deque<std::uint64_t> waiting_;
    std::size_t running_ = 0;
    std::uint64_t last_number_ = 0;
    double usual_seconds_ = 1.0;  // that a turn takes, the last ones counting most
};

}  // namespace patchlight::server
