#pragma once

#include <string>
#include <vector>

namespace patchlight::raster {

struct Tick {
    double place = 0.0;
    std::string label;
};

/// Round numbers (1, 2, 2.5 or 5 times a power of ten apart) from `least` to `most`, as many as
/// there are without being more than `most_ticks`; at least 2 are allowed.
std::vector<Tick> scale_ticks(double least, double most, int most_ticks);

/// The smallest round number that is not below: 1, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of
/// ten. `number` is above 0.
double round_number_above(double number);

}  // namespace patchlight::raster
