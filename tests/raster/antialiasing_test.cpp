#include "raster/render.h"
#include "tests/raster/meshes.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

namespace patchlight::raster::antialiasing_test {
namespace {

using Eigen::Vector3d;

constexpr int size = 15;  // [pixels], one unit of length each, the origin in the middle
constexpr int samples = 16;

Camera one_pixel_a_unit() {
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.projection = Projection::parallel;
    camera.view_height = size;
    camera.width = camera.height = size;
    return camera;
}

/// The half plane to the left of a line: all points with p · outward < reach.
Image half_plane(double angle, double reach) {
    const Vector3d outward(std::cos(angle), std::sin(angle), 0);
    const Vector3d along(-outward.y(), outward.x(), 0);
    Mesh mesh;
    add_wall(mesh, outward * (reach - 60) - 30 * along, 60 * outward, 60 * along, 1,
             Eigen::Array3d::Ones());
    return render(one_pixel_a_unit(), mesh.view());
}

/// Share of the pixel's square in that half plane, by exact integration over thin strips.
double exact_share(int x, int y, double angle, double reach) {
    constexpr int strips = 4000;
    double area = 0.0;
    for (int k = 0; k < strips; ++k) {
        const double px = x - 0.5 * size + (k + 0.5) / strips;
        const double top = (reach - px * std::cos(angle)) / std::sin(angle);
        const double below = std::clamp(top - (0.5 * size - y - 1), 0.0, 1.0);
        area += std::sin(angle) > 0 ? below : 1.0 - below;
    }
    return area / strips;
}

TEST(Antialiasing, UprightAndLevelEdgesAreRightWithinOneSample) {
    const double one_sample = 1.0 / samples;
    for (int step = 0; step < 100; ++step) {
        const double reach = step / 100.0 - 0.5;
        const double share = reach + 0.5;  // of the middle pixel
        const int middle = size / 2;
        const double right_angle = std::numbers::pi / 2;
        for (int turn = 0; turn < 4; ++turn)
            EXPECT_NEAR(value_at(half_plane(turn * right_angle, reach), middle, middle), share,
                        one_sample);
    }
}

TEST(Antialiasing, SlantedEdgesAreRightWithinOneSampleOnAverage) {
    const double one_sample = 1.0 / samples;
    // The largest error any half plane has with this pattern is 2.3 samples, found by trying all
    // lines through pairs of samples; snapping to 1/256 pixel adds up to 0.1.
    const double worst_of_pattern = 2.4 * one_sample;
    for (int turn = 0; turn < 24; ++turn) {
        const double angle = (turn + 0.37) * 2 * std::numbers::pi / 24;
        const double reach = 0.1 * turn - 1.0;
        const Image image = half_plane(angle, reach);
        double squares = 0.0;
        int edge_pixels = 0;
        for (int i = 0; i < size * size; ++i) {
            const double exact = exact_share(i % size, i / size, angle, reach);
            const double error = value_at(image, i % size, i / size) - exact;
            EXPECT_LT(std::abs(error), worst_of_pattern);
            if (exact <= 0.0 || exact >= 1.0) continue;
            squares += error * error;
            ++edge_pixels;
        }
        EXPECT_LT(std::sqrt(squares / edge_pixels), one_sample) << "angle " << angle;
    }
}

TEST(Antialiasing, ThinThingsKeepTheirLight) {
    // A strip a fifth of a pixel wide, at many places: its light is right on average.
    const double width = 0.2;
    double light = 0.0;
    const int places = 80;
    for (int place = 0; place < places; ++place) {
        Mesh mesh;
        add_wall(mesh, {0.1 * place / 8 - 0.5, -2, 0}, {width, 0, 0}, {0.4, 4, 0}, 1,
                 Eigen::Array3d::Ones());
        const Image image = render(one_pixel_a_unit(), mesh.view());
        for (std::size_t i = 0; i < image.rgb.size(); i += 3) light += image.rgb[i];
    }
    const double exact = width * 4;
    const double tolerance = 0.01 * exact;  // errors of 16 samples over 5 pixels, 80 times
    EXPECT_NEAR(light / places, exact, tolerance);
}

}  // namespace
}  // namespace patchlight::raster::antialiasing_test
