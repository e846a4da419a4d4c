#pragma once

#include "server/selftest/known_answer.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace patchlight::server {

/// Of several answers of one solve the one that is nearest to its bound, or farthest beyond; its
/// quantity says of how many. `answers` must not be empty.
inline KnownAnswer worst_of(std::span<const KnownAnswer> answers) {
    const auto share = [](const KnownAnswer& answer) {
        return answer.is_within() && answer.bound > 0.0 ? std::abs(answer.error()) / answer.bound
               : answer.is_within()                     ? 0.0
                                                        : INFINITY;
    };
    KnownAnswer worst = *std::max_element(
        answers.begin(), answers.end(),
        [&](const KnownAnswer& a, const KnownAnswer& b) { return share(a) < share(b); });
    worst.quantity += ", worst of " + std::to_string(answers.size());
    return worst;
}

}  // namespace patchlight::server
