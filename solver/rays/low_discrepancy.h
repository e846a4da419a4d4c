#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

/// Mixes the bits of a and b so that near inputs give unrelated outputs.
inline std::uint64_t mix(std::uint64_t a, std::uint64_t b) {
    std::uint64_t x = a * 0x9e3779b97f4a7c15u + b + 0x632be59bd9b4e019u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// A number in [0, 1) out of mixed bits.
inline double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// Nested uniform scramble of a number whose bits are in reverse order
/// (Laine & Karras 2011; constants of Burley, "Practical Hash-based Owen Scrambling", 2020).
/// Also for vectors of such numbers.
template <typename Word>
inline Word scramble_reversed(Word x, Word seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

template <typename Word>
inline Word reverse_bits(Word x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/// The first points of the four-dimensional Sobol sequence, bits reversed so that a scramble is a
/// few operations (direction numbers of Joe & Kuo, 2008).
class SobolPoints {
  public:
    static constexpr std::size_t dimensions = 4;
    explicit SobolPoints(std::size_t count);
    std::size_t size() const { return count_; }
    /// Readable up to the next multiple of 16.
    const std::uint32_t* reversed(std::size_t dimension) const {
        return reversed_[dimension].data();
    }

    /// Coordinate of point k under the scramble `seed`, in [0, 1).
    float at(std::size_t dimension, std::size_t k, std::uint32_t seed) const {
        const std::uint32_t x = reverse_bits(scramble_reversed(reversed_[dimension][k], seed));
        return static_cast<float>(x >> 8) * 0x1p-24f;
    }

  private:
    std::size_t count_;
    std::array<std::vector<std::uint32_t>, dimensions> reversed_;
};

}  // namespace patchlight
