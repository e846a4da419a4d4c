#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace patchlight {

template <std::size_t N>
struct GaussRule {
    std::array<double, N> nodes;    // in (0, 1)
    std::array<double, N> weights;  // sum 1
};

/// Gauss–Legendre nodes on (0, 1) by Newton's method from Tricomi's estimate
/// (Abramowitz & Stegun, 1964, 22.16.6 and 25.4.29).
template <std::size_t N>
GaussRule<N> make_gauss_rule() {
    GaussRule<N> rule{};
    for (std::size_t k = 0; k < N; ++k) {
        double x = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.75) /
                            (static_cast<double>(N) + 0.5));
        double slope = 1.0;
        for (int step = 0; step < 50; ++step) {
            double p = 1.0, before = 0.0;
            for (std::size_t n = 1; n <= N; ++n) {
                const double m = static_cast<double>(n);
                const double next = ((2.0 * m - 1.0) * x * p - (m - 1.0) * before) / m;
                before = p;
                p = next;
            }
            slope = static_cast<double>(N) * (x * p - before) / (x * x - 1.0);
            const double change = p / slope;
            x -= change;
            if (std::abs(change) < 1e-16) break;
        }
        rule.nodes[k] = 0.5 * (1.0 - x);
        rule.weights[k] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

template <std::size_t N>
const GaussRule<N>& gauss_rule() {
    static const GaussRule<N> rule = make_gauss_rule<N>();
    return rule;
}

}  // namespace patchlight
