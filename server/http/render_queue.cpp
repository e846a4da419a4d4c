#include "server/http/render_queue.h"

#include <algorithm>
#include <chrono>

namespace patchlight::server {
namespace {

double now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count();
}

}  // namespace

RenderQueue::RenderQueue(int at_once, int waiting)
    : at_once_(static_cast<std::size_t>(at_once)),
      most_waiting_(static_cast<std::size_t>(waiting)) {}

RenderQueue::Place::Place(RenderQueue& queue) : queue_(queue) {
    const std::lock_guard lock(queue_.mutex_);
    if (!queue_.has_room()) return;
    number_ = ++queue_.last_number_;
    queue_.waiting_.push_back(number_);
}

RenderQueue::Place::~Place() {
    const std::lock_guard lock(queue_.mutex_);
    std::erase(queue_.waiting_, number_);
    if (is_running_) {
        constexpr double weight_of_last = 0.3;
        queue_.usual_seconds_ += weight_of_last * (now() - started_ - queue_.usual_seconds_);
        --queue_.running_;
    }
    queue_.moved_.notify_all();
}

bool RenderQueue::Place::wait(const std::function<bool()>& gives_up) {
    constexpr std::chrono::milliseconds slice{50};
    std::unique_lock lock(queue_.mutex_);
    while (queue_.running_ >= queue_.at_once_ || queue_.waiting_.front() != number_) {
        lock.unlock();
        if (gives_up()) return false;
        lock.lock();
        queue_.moved_.wait_for(lock, slice, [&] {
            return queue_.running_ < queue_.at_once_ && queue_.waiting_.front() == number_;
        });
    }
    queue_.waiting_.pop_front();
    ++queue_.running_;
    is_running_ = true;
    started_ = now();
    return true;
}

bool RenderQueue::has_room() const { return running_ + waiting_.size() < at_once_ + most_waiting_; }

bool RenderQueue::is_full() const {
    const std::lock_guard lock(mutex_);
    return !has_room();
}

int RenderQueue::running() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(running_);
}

int RenderQueue::waiting() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(waiting_.size());
}

double RenderQueue::seconds_until_room() const {
    const std::lock_guard lock(mutex_);
    return usual_seconds_ * static_cast<double>(1 + waiting_.size()) /
           static_cast<double>(at_once_);
}

}  // namespace patchlight::server
