#include "server/quick_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

namespace patchlight::server::quick_numbers_test {
namespace {

std::string estimate(double number) {
    char text[longest_number];
    return {text, put_estimate(text, number)};
}

TEST(QuickNumbers, EstimatesHaveThreeDigits) {
    EXPECT_EQ(estimate(0.0), "0");
    EXPECT_EQ(estimate(1.0), "1.00e+00");
    EXPECT_EQ(estimate(0.000123456), "1.23e-04");
    EXPECT_EQ(estimate(98765.0), "9.88e+04");
    EXPECT_EQ(estimate(0.1), "1.00e-01");
    EXPECT_EQ(estimate(9.996), "1.00e+01");
    EXPECT_EQ(estimate(0.09996), "1.00e-01");
    EXPECT_EQ(estimate(1e-300), "0");
}

TEST(QuickNumbers, EstimatesAreWithinHalfADigit) {
    std::mt19937 chance(1);
    std::uniform_real_distribution<double> exponent(-60.0, 60.0);
    for (int k = 0; k < 20'000; ++k) {
        const double number = std::pow(10.0, exponent(chance));
        const double read = std::strtod(estimate(number).c_str(), nullptr);
        ASSERT_NEAR(read, number, 0.00501 * number) << estimate(number);
    }
}

TEST(QuickNumbers, FloatsReadBackAsTheSame) {
    std::mt19937 chance(1);
    std::uniform_real_distribution<float> exponent(-30.0F, 0.0F);
    for (int k = 0; k < 1000; ++k) {
        const float number = std::exp(exponent(chance));
        char text[longest_number];
        const std::string written(text, put_float(text, number));
        EXPECT_EQ(std::strtof(written.c_str(), nullptr), number) << written;
    }
    char text[longest_number];
    EXPECT_EQ(std::string(text, put_index(text, 4'294'967'295u)), "4294967295");
}

}  // namespace
}  // namespace patchlight::server::quick_numbers_test
