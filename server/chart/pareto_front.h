#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace patchlight::server {

struct SpeedAndError {
    double seconds = 0.0;
    double error = 0.0;  // [1]
};

/// Which points no other beats, quickest first: none is as quick or quicker and has less error, nor
/// is any quicker with as much. Of equal points the first counts.
std::vector<std::size_t> pareto_front(std::span<const SpeedAndError> points);

}  // namespace patchlight::server
