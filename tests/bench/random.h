#pragma once

#include <cstdint>

namespace patchlight {

/// Chances of the light tracer's own: SplitMix64 (Steele, Lea & Flood, "Fast splittable
/// pseudorandom number generators", 2014), from (seed, stream).
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream)
        : state_(scatter(seed + 0x9e3779b97f4a7c15u) ^ scatter(~stream)) {}

    std::uint64_t bits() { return scatter(state_ += 0x9e3779b97f4a7c15u); }
    /// In [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    /// In 0 … count - 1.
    int below(int count) { return static_cast<int>(unit() * count); }
    bool chance(double share) { return unit() < share; }

  private:
    static std::uint64_t scatter(std::uint64_t x) {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }
    std::uint64_t state_;
};

}  // namespace patchlight
