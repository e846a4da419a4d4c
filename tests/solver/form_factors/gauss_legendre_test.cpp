#include "solver/form_factors/gauss_legendre.h"

#include <gtest/gtest.h>

namespace patchlight::gauss_legendre_test {
namespace {

constexpr double rounding = 1e-14;

template <std::size_t N>
void expect_exact() {
    const GaussRule<N>& rule = gauss_rule<N>();
    for (std::size_t degree = 0; degree < 2 * N; ++degree) {
        double sum = 0.0;
        for (std::size_t k = 0; k < N; ++k)
            sum += rule.weights[k] * std::pow(rule.nodes[k], static_cast<double>(degree));
        EXPECT_NEAR(sum, 1.0 / static_cast<double>(degree + 1), rounding) << N << ' ' << degree;
    }
}

TEST(GaussLegendre, IntegratesPolynomialsUpToDegreeTwiceNMinusOneExactly) {
    expect_exact<1>();
    expect_exact<2>();
    expect_exact<3>();
    expect_exact<4>();
    expect_exact<6>();
    expect_exact<10>();
    expect_exact<16>();
}

}  // namespace
}  // namespace patchlight::gauss_legendre_test
