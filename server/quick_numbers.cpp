#include "server/quick_numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace patchlight::server {
namespace {

constexpr int largest_power = 99;

/// powers[k] is 10 to the power of k - largest_power.
std::array<double, 2 * largest_power + 1> powers_of_ten() {
    std::array<double, 2 * largest_power + 1> powers{};
    for (int k = -largest_power; k <= largest_power; ++k)
        powers[static_cast<std::size_t>(k + largest_power)] = std::pow(10.0, k);
    return powers;
}

double power_of_ten(int exponent) {
    static const auto powers = powers_of_ten();
    return powers[static_cast<std::size_t>(exponent + largest_power)];
}

}  // namespace

char* put_float(char* place, float number) {
    return std::to_chars(place, place + longest_number, number).ptr;
}

char* put_index(char* place, std::uint32_t number) {
    return std::to_chars(place, place + longest_number, number).ptr;
}

char* put_estimate(char* place, double number) {
    constexpr double decades_per_octave = 0.30102999566398120;  // log10 2
    constexpr double least = 1e-90, most = 1e90;
    if (!(number >= least && number <= most)) {
        *place++ = '0';
        return place;
    }
    int exponent = static_cast<int>(std::floor(std::ilogb(number) * decades_per_octave));
    if (number >= power_of_ten(exponent + 1)) ++exponent;  // an octave spans a power of ten
    auto digits = static_cast<int>(number * power_of_ten(2 - exponent) + 0.5);
    if (digits >= 1000) digits /= 10, ++exponent;
    *place++ = static_cast<char>('0' + digits / 100);
    *place++ = '.';
    *place++ = static_cast<char>('0' + digits / 10 % 10);
    *place++ = static_cast<char>('0' + digits % 10);
    *place++ = 'e';
    *place++ = exponent < 0 ? '-' : '+';
    const int size = exponent < 0 ? -exponent : exponent;
    *place++ = static_cast<char>('0' + size / 10);
    *place++ = static_cast<char>('0' + size % 10);
    return place;
}

}  // namespace patchlight::server
