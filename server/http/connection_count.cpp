#include "server/http/connection_count.h"

namespace patchlight::server {
namespace {

bool is_loopback_name(const std::string& address) {
    return address.starts_with("127.") || address == "::1" || address.starts_with("::ffff:127.");
}

}  // namespace

Lane ConnectionCount::enter(const std::string& address) {
    const std::lock_guard lock(mutex_);
    const auto known = by_address_.find(address);
    const std::size_t of_address = known == by_address_.end() ? 0 : known->second;
    const bool is_greedy =
        !is_loopback_name(address) && of_address >= limits_.connections_per_address;
    if (!is_greedy && normal_ < limits_.connections) {
        ++by_address_[address];
        ++normal_;
        return Lane::normal;
    }
    if (reserve_ >= limits_.reserve) return Lane::refused;
    ++reserve_;
    return Lane::reserve;
}

void ConnectionCount::leave(const std::string& address, Lane lane) {
    if (lane == Lane::refused) return;
    const std::lock_guard lock(mutex_);
    if (lane == Lane::reserve) {
        --reserve_;
    } else {
        --normal_;
        const auto known = by_address_.find(address);
        if (--known->second == 0) by_address_.erase(known);
    }
    left_.notify_all();
}

std::size_t ConnectionCount::open() const {
    const std::lock_guard lock(mutex_);
    return normal_ + reserve_;
}

void ConnectionCount::wait_until_none() const {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [&] { return normal_ + reserve_ == 0; });
}

}  // namespace patchlight::server
