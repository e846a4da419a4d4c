#include "solver/rays/low_discrepancy.h"

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
        for (std::size_t k = 0; k < reversed_[d].size(); ++k) {
            std::uint32_t x = 0;
            for (unsigned bit = 0; bit < 32; ++bit)
                if ((k >> bit) & 1u) x ^= table[d][bit];
            reversed_[d][k] = reverse_bits(x);
        }
    }
}

}  // namespace patchlight
