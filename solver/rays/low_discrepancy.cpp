#include "solver/rays/low_discrepancy.h"

#include <algorithm>

namespace patchlight {

namespace {

using Directions = std::array<std::uint32_t, 32>;

/// Dimension 0 is van der Corput's; the others from a primitive polynomial of degree s with inner
/// coefficients a, and s first direction numbers m.
Directions directions(unsigned s, unsigned a, std::array<std::uint32_t, 3> m) {
    Directions v{};
    for (unsigned k = 0; k < 32; ++k) {
        if (s == 0) {
            v[k] = 1u << (31 - k);
        } else if (k < s) {
            v[k] = m[k] << (31 - k);
        } else {
            v[k] = v[k - s] ^ (v[k - s] >> s);
            for (unsigned i = 1; i < s; ++i) v[k] ^= ((a >> (s - 1 - i)) & 1u) * v[k - i];
        }
    }
    return v;
}

}  // namespace

SobolPoints::SobolPoints(std::size_t count) : count_(count) {
    const std::array<Directions, dimensions> table{
        directions(0, 0, {}), directions(1, 0, {1, 0, 0}), directions(2, 1, {1, 3, 0}),
        directions(3, 1, {1, 3, 1})};
    for (std::size_t d = 0; d < dimensions; ++d) {
        reversed_[d].resize((count + 15) / 16 * 16);  // whole batches
        // Point k + 2^b, k < 2^b, is point k with direction b added.
        std::vector<std::uint32_t>& points = reversed_[d];
        for (std::size_t half = 1, bit = 0; half < points.size(); half *= 2, ++bit) {
            const std::uint32_t direction = reverse_bits(table[d][bit]);
            for (std::size_t k = 0; k < std::min(half, points.size() - half); ++k)
                points[half + k] = points[k] ^ direction;
        }
    }
}

}  // namespace patchlight
