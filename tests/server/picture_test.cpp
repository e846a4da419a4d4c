#include "server/picture.h"

#include "tests/server/small_solution.h"

#include <gtest/gtest.h>

#include <numbers>

namespace patchlight::server::picture_test {
namespace {

TEST(Picture, TheFormatIsToldByTheEndOfTheName) {
    EXPECT_EQ(format_of_file("a/b.png"), ImageFormat::png);
    EXPECT_EQ(format_of_file("b.EXR"), ImageFormat::exr);
    EXPECT_EQ(format_of_file("b.c.pfm"), ImageFormat::pfm);
    EXPECT_EQ(format_of_file("b.jpg"), std::nullopt);
    EXPECT_EQ(format_of_file("png"), std::nullopt);
    EXPECT_EQ(format_of_file(""), std::nullopt);
}

TEST(Picture, RadianceIsRadiosityOverPi) {
    Solution solution = small_solution();
    solution.display.radiosity.assign(3, Rgb(3, 2, 1));
    raster::Camera camera;
    camera.eye = Vec3(0.75, 0.25, 1);
    camera.look_at = Vec3(0.75, 0.25, 0);  // inside the triangle
    camera.width = camera.height = 1;
    camera.vertical_fov = 5;
    const raster::Image image = take_picture(solution, camera);
    ASSERT_EQ(image.rgb.size(), 3u);
    for (std::size_t channel = 0; channel < 3; ++channel)
        EXPECT_FLOAT_EQ(image.rgb[channel],
                        static_cast<float>(static_cast<double>(3 - channel) / std::numbers::pi));
}

TEST(Picture, PfmNeedsNoCodec) {
    EXPECT_FALSE(needs_codec(ImageFormat::pfm));
    const raster::Image image{1, 1, {1.0f, 2.0f, 3.0f}};
    EXPECT_EQ(encode(image, ImageFormat::pfm, 0.0).substr(0, 2), "PF");
}

}  // namespace
}  // namespace patchlight::server::picture_test
