#include "raster/colour_map.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace patchlight::raster::colour_map_test {
namespace {

/// CIE 1976 L*a*b* of a linear sRGB colour, seen under D65: an independent measure of what looks
/// alike.
Eigen::Array3d cielab(const Eigen::Array3d& rgb) {
    Eigen::Matrix3d xyz_of_rgb;
    xyz_of_rgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
    const Eigen::Array3d white(0.9505, 1.0, 1.089);
    Eigen::Array3d f = (xyz_of_rgb * rgb.matrix()).array() / white;
    for (double& each : f) each = each > 0.008856 ? std::cbrt(each) : 7.787 * each + 16.0 / 116.0;
    return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

/// As those without one kind of cone see it (projected onto the plane of what they tell apart),
/// linear. Viénot, Brettel & Mollon, "Digital video colourmaps for checking the legibility of
/// displays by dichromats", 1999.
Eigen::Array3d without_green_cones(const Eigen::Array3d& rgb) {
    Eigen::Matrix3d seen;
    seen << 0.29275, 0.70725, 0, 0.29275, 0.70725, 0, -0.02234, 0.02234, 1;
    return (seen * rgb.matrix()).array().max(0.0);
}

constexpr int steps = 64;
double share(int k) { return static_cast<double>(k) / steps; }

TEST(ColourMap, OnlyEverGetsLighter) {
    for (int k = 0; k < 255; ++k) {
        const double before = cielab(mapped_colour(k / 255.0))[0];
        EXPECT_GT(cielab(mapped_colour((k + 1) / 255.0))[0], before) << k;
    }
    EXPECT_LT(cielab(mapped_colour(0))[0], 10.0);
    EXPECT_GT(cielab(mapped_colour(1))[0], 90.0);
}

TEST(ColourMap, StaysWithinWhatAScreenShows) {
    for (int k = 0; k <= steps; ++k) {
        EXPECT_GE(mapped_colour(share(k)).minCoeff(), 0.0) << k;
        EXPECT_LE(mapped_colour(share(k)).maxCoeff(), 1.0) << k;
    }
}

TEST(ColourMap, EqualStepsLookAlike) {
    constexpr double uneven = 2.0;  // CIELAB itself is no more even than that over dark blues
    double least = 1e9, most = 0.0;
    for (int k = 0; k < steps; ++k) {
        const Eigen::Array3d step =
            cielab(mapped_colour(share(k + 1))) - cielab(mapped_colour(share(k)));
        least = std::min(least, step.matrix().norm());
        most = std::max(most, step.matrix().norm());
    }
    EXPECT_LT(most, uneven * least);
}

TEST(ColourMap, IsReadByTheColourBlind) {
    constexpr double distinct = 0.8;  // CIELAB units of lightness: some 1/64 of the range
    for (int k = 0; k < steps; ++k) {
        const double before = cielab(without_green_cones(mapped_colour(share(k))))[0];
        const double after = cielab(without_green_cones(mapped_colour(share(k + 1))))[0];
        EXPECT_GT(after - before, distinct) << k;
    }
}

TEST(ColourMap, BeyondItsEndsItStaysAtThem) {
    EXPECT_TRUE((mapped_colour(-1) == mapped_colour(0)).all());
    EXPECT_TRUE((mapped_colour(7) == mapped_colour(1)).all());
    EXPECT_TRUE((mapped_colour(std::nan("")) == mapped_colour(0)).all());
}

}  // namespace
}  // namespace patchlight::raster::colour_map_test
