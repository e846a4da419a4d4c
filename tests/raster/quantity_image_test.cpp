#include "raster/quantity_image.h"

#include "raster/colour_map.h"
#include "raster/colour_scale.h"

#include <gtest/gtest.h>
#include <vector>

namespace patchlight::raster::quantity_image_test {
namespace {

/// A square from (-1, -1) to (1, 1) at z = 0, seen from above in parallel so that it takes the
/// middle half of the picture each way. Its quantity is 100 (x + 1).
struct Sheet {
    std::vector<Eigen::Vector3d> positions{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    std::vector<double> quantity{0, 200, 200, 0};
    std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
    Camera camera;

    explicit Sheet(int size) {
        camera.projection = Projection::parallel;
        camera.eye = {0, 0, 5};
        camera.look_at = {0, 0, 0};
        camera.view_height = 4;
        camera.width = camera.height = size;
    }
    QuantityImage seen() const { return render_quantity(camera, positions, quantity, triangles); }
};

std::size_t pixel(int size, int x, int y) { return static_cast<std::size_t>(y * size + x); }

TEST(QuantityImage, HoldsTheQuantityWhereASurfaceIsSeen) {
    const QuantityImage seen = Sheet(16).seen();
    EXPECT_EQ(seen.coverage[pixel(16, 0, 0)], 0.0F);
    EXPECT_EQ(seen.quantity[pixel(16, 0, 0)], 0.0F);
    EXPECT_EQ(seen.coverage[pixel(16, 8, 8)], 1.0F);
    EXPECT_NEAR(seen.quantity[pixel(16, 4, 8)], 12.5, 0.1);  // x = -0.875
    EXPECT_NEAR(seen.quantity[pixel(16, 11, 8)], 187.5, 0.1);
}

TEST(QuantityImage, AtItsOutlineItIsNotDarkened) {
    const QuantityImage seen = Sheet(10).seen();  // the outline runs through the middle of pixels
    EXPECT_NEAR(seen.coverage[pixel(10, 7, 5)], 0.5F, 0.01);
    EXPECT_GT(seen.quantity[pixel(10, 7, 5)], 185.0F);
}

TEST(QuantityImage, PinholesBetweenSurfacesAreClosed) {
    Sheet sheet(16);
    sheet.positions = {{-1, -1, 0}, {1, -1, 0},    {1, 1, 0},
                       {-1, 1, 0},  {0.005, 0, 0}, {-0.005, 0, 0}};
    sheet.quantity.assign(6, 7.0);
    sheet.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 5}, {0, 4, 5}, {3, 5, 4}};
    sheet.triangles.pop_back();  // a sliver is missing, from the middle to a corner
    const QuantityImage seen = sheet.seen();
    for (int y = 5; y < 11; ++y)
        for (int x = 5; x < 11; ++x) EXPECT_EQ(seen.coverage[pixel(16, x, y)], 1.0F) << x << y;
    EXPECT_LT(seen.coverage[pixel(16, 3, 8)], 1.0F);
}

TEST(QuantityImage, GreyImagesAreTheQuantityItself) {
    const QuantityImage seen{2, 1, {3.5F, 0.0F}, {1.0F, 0.0F}};
    EXPECT_EQ(grey_image(seen).rgb, (std::vector<float>{3.5F, 3.5F, 3.5F, 0, 0, 0}));
}

TEST(QuantityImage, ColoursStandForPlacesInTheRange) {
    const QuantityImage seen{4, 1, {10, 20, 99, 0}, {1, 1, 1, 0}};
    const Image image = false_colour_image(seen, {10, 30});
    const auto expect_colour = [&](std::size_t k, const Eigen::Array3d& colour) {
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_FLOAT_EQ(image.rgb[3 * k + c],
                            static_cast<float>(colour[static_cast<Eigen::Index>(c)]));
    };
    expect_colour(0, mapped_colour(0));
    expect_colour(1, mapped_colour(0.5));
    expect_colour(2, mapped_colour(1));
    expect_colour(3, Eigen::Array3d::Constant(background_grey));
}

TEST(ColourScale, StandsBesideThePictureAndLeavesItAlone) {
    const Image picture = false_colour_image(Sheet(200).seen(), {0, 200});
    const Image image = with_colour_scale(picture, {{0, 200}, {"illuminance", "lx"}});
    EXPECT_EQ(image.height, 200);
    ASSERT_GT(image.width, 230);
    EXPECT_LT(image.width, 320);
    ASSERT_EQ(image.rgb.size(), static_cast<std::size_t>(3 * image.width * image.height));
    for (int y = 0; y < 200; ++y)
        for (int i = 0; i < 600; ++i)
            ASSERT_EQ(image.rgb[static_cast<std::size_t>(y * image.width * 3 + i)],
                      picture.rgb[static_cast<std::size_t>(y * 600 + i)]);
}

TEST(ColourScale, ItsBarRunsThroughAllColours) {
    const Image picture{100, 300, std::vector<float>(90000, 0.0F)};
    const Image image = with_colour_scale(picture, {{0, 1}, {"lx"}});
    const int column = 100 + 7 * 3 / 2 + 4;  // inside the bar
    float least = 2.0F, most = 0.0F;
    for (int y = 60; y < 285; ++y) {
        const float red = image.rgb[static_cast<std::size_t>(3 * (y * image.width + column))];
        least = std::min(least, red);
        most = std::max(most, red);
    }
    EXPECT_NEAR(least, mapped_colour(0)[0], 0.02);
    EXPECT_NEAR(most, mapped_colour(1)[0], 0.06);
}

TEST(ColourScale, TheSmallestPictureHasRoom) {
    for (const int size : {1, 9, 25, 40}) {
        const Image picture{size, size,
                            std::vector<float>(static_cast<std::size_t>(3 * size * size))};
        const Image image = with_colour_scale(picture, {{0, 1e6}, {"irradiance", "W/m²"}});
        EXPECT_EQ(image.height, size);
        EXPECT_GT(image.width, size);
    }
}

}  // namespace
}  // namespace patchlight::raster::quantity_image_test
