#include "raster/render.h"

#include "tests/raster/meshes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <limits>
#include <random>
#include <stdexcept>

namespace patchlight::raster::render_test {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

const Array3d white = Array3d::Ones();
const RenderSettings at_centres{.samples_per_axis = 1};

Camera from_front(int size) {
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.vertical_fov = 90;
    camera.width = camera.height = size;
    return camera;
}

/// Direction of the ray through the centre of a pixel of a camera that looks along -z, 90 degrees.
Vector3d ray_through(const Camera& camera, int x, int y) {
    return {(2.0 * x + 1.0) / camera.width - 1.0, 1.0 - (2.0 * y + 1.0) / camera.height, -1.0};
}

TEST(Render, ColoursAreInterpolatedWithPerspective) {
    // Colours are a linear function of place, so the exact one is known where the ray meets the
    // plane.
    const auto colour_at = [](const Vector3d& p) {
        return Array3d(10 + p.x(), 10 + 0.5 * p.y() - p.z(), 12 - p.x() + p.y());
    };
    const Vector3d a(-4, -3, 4);
    const Vector3d b(6, -2, -3);
    const Vector3d c(-2, 5, -6);
    Mesh mesh;
    add_triangle(mesh, a, b, c, white);
    for (std::size_t i = 0; i < 3; ++i) mesh.colours[i] = colour_at(mesh.positions[i]);
    const Camera camera = from_front(97);
    const Image image = render(camera, mesh.view(), at_centres);
    const Vector3d normal = (b - a).cross(c - a);
    const double single_precision = 2e-6;  // some roundings of 6e-8
    int seen = 0;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            if (value_at(image, x, y) == 0.0F) continue;
            ++seen;
            const Vector3d ray = ray_through(camera, x, y);
            const Vector3d hit = camera.eye + ray * normal.dot(a - camera.eye) / normal.dot(ray);
            for (int channel = 0; channel < 3; ++channel) {
                const double exact = colour_at(hit)[channel];
                ASSERT_NEAR(value_at(image, x, y, channel), exact, single_precision * exact);
            }
        }
    }
    EXPECT_GT(seen, 1000);
}

TEST(Render, AConstantColourStaysExactlyThatColour) {
    Mesh mesh;
    add_box(mesh, Vector3d::Zero(), Vector3d::Ones(), 9, false);
    std::fill(mesh.colours.begin(), mesh.colours.end(), Array3d(0.1, 0.7, 1e4));
    for (const int samples_per_axis : {1, 2, 4, 8}) {
        const Image image = render(room_camera(64), mesh.view(), {samples_per_axis});
        for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
            ASSERT_EQ(image.rgb[i], 0.1F);
            ASSERT_EQ(image.rgb[i + 1], 0.7F);
            ASSERT_EQ(image.rgb[i + 2], 1e4F);
        }
    }
}

TEST(Render, ACameraInsideARoomSeesNoHole) {
    std::mt19937 chance(5);
    std::uniform_real_distribution<double> anywhere(0.001, 0.999);
    for (int trial = 0; trial < 40; ++trial) {
        Mesh mesh;
        add_box(mesh, Vector3d::Zero(), Vector3d::Ones(), 1 + trial % 5, false);
        std::fill(mesh.colours.begin(), mesh.colours.end(), white);
        Camera camera;
        camera.eye = {anywhere(chance), anywhere(chance), anywhere(chance)};
        camera.look_at = {anywhere(chance), anywhere(chance), anywhere(chance)};
        camera.vertical_fov = 20.0 + 3.0 * trial;
        camera.width = 90;
        camera.height = 70;
        const Image image = render(camera, mesh.view());
        for (const float value : image.rgb) ASSERT_EQ(value, 1.0F) << "trial " << trial;
    }
}

TEST(Render, BackFacesAreNotDrawn) {
    Mesh mesh;
    add_triangle(mesh, {-9, -9, 0}, {-9, 30, 0}, {30, -9, 0}, white);  // clockwise, near
    add_triangle(mesh, {-9, -9, -1}, {30, -9, -1}, {-9, 30, -1}, {2, 2, 2});
    const Image image = render(from_front(16), mesh.view());
    for (const float value : image.rgb) EXPECT_EQ(value, 2.0F);
}

TEST(Render, AClosedRoomIsLookedIntoFromOutside) {
    Mesh mesh;
    add_box(mesh, Vector3d::Constant(-1), Vector3d::Constant(2), 3, false);
    const Image image = render(from_front(65), mesh.view());
    EXPECT_EQ(value_at(image, 32, 32, 2), 0.9F);  // the far wall z = -1
    EXPECT_EQ(value_at(image, 0, 0), 0.0F);
}

TEST(Render, TheFirstPixelIsTopLeftInBothProjections) {
    Mesh mesh;
    add_triangle(mesh, {-5, 5, 0}, {-5, 4, 0}, {-4, 5, 0}, {1, 0, 0});  // left above
    add_triangle(mesh, {5, -5, 0}, {5, -4, 0}, {4, -5, 0}, {0, 1, 0});  // right below
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        Camera camera = from_front(10);
        camera.projection = projection;
        camera.view_height = 10;
        const Image image = render(camera, mesh.view());
        EXPECT_GT(value_at(image, 0, 0, 0), 0.4F);
        EXPECT_GT(value_at(image, 9, 9, 1), 0.4F);
        EXPECT_EQ(value_at(image, 9, 0, 0), 0.0F);
        EXPECT_EQ(value_at(image, 0, 9, 1), 0.0F);
    }
}

TEST(Render, WhatIsBehindTheEyeIsNotDrawn) {
    Mesh mesh;
    add_triangle(mesh, {-99, -99, 6}, {99, -99, 6}, {0, 99, 6}, white);
    add_triangle(mesh, {-99, -99, 6}, {0, 99, 6}, {99, -99, 6}, white);
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        Camera camera = from_front(16);
        camera.projection = projection;
        for (const float value : render(camera, mesh.view()).rgb) EXPECT_EQ(value, 0.0F);
    }
}

TEST(Render, TheNearerSurfaceIsSeenWhateverTheOrder) {
    Mesh mesh;
    for (const double z : {-3.0, 2.0, 0.0, 1.999, -1.0})
        add_triangle(mesh, {-20, -20, z}, {40, -20, z}, {-20, 40, z}, white * (z + 10));
    for (const float value : render(from_front(16), mesh.view()).rgb) EXPECT_EQ(value, 12.0F);
}

TEST(Render, OfCoplanarSurfacesTheLaterOneIsSeen) {
    // A rug on a floor seen at a grazing angle from inside a room, where the floor passes below the
    // eye; the rug is cut in other places than the floor.
    Mesh mesh;
    add_wall(mesh, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 3, {0, 1, 0});
    const std::size_t floor = mesh.triangles.size();
    add_wall(mesh, {0.21, 0, 0.13}, {0.03, 0, 0.6}, {0.5, 0, 0.01}, 7, {1, 0, 0});
    Camera camera = room_camera(128);
    for (const double height : {0.5, 0.05, 0.003}) {
        camera.eye.y() = height;
        camera.look_at = {0.5, 0.0, 0.3};
        const Image both = render(camera, mesh.view(), at_centres);
        const TriangleView rug{mesh.positions, mesh.colours,
                               std::span(mesh.triangles).subspan(floor)};
        const Image alone = render(camera, rug, at_centres);
        for (std::size_t i = 0; i < alone.rgb.size(); i += 3)
            ASSERT_EQ(both.rgb[i], alone.rgb[i]) << "height " << height;
    }
}

TEST(Render, IsTheSameWithAnyNumberOfThreads) {
    const Mesh mesh = room_with_block(11);
    const auto picture = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return render(room_camera(300), mesh.view()).rgb;
    };
    const std::vector<float> alone = picture(1);
    EXPECT_EQ(picture(2), alone);
    EXPECT_EQ(picture(3), alone);
}

TEST(Render, OfNothingIsBlack) {
    const Image image = render(from_front(8), {});
    EXPECT_EQ(image.rgb, std::vector<float>(8 * 8 * 3, 0.0F));
}

TEST(Render, ASceneIsDrawnTheSameInAnyUnit) {
    // Powers of two scale without rounding.
    const Mesh mesh = room_with_block(5);
    const Image metres = render(room_camera(60), mesh.view());
    Mesh large = mesh;
    for (Vector3d& position : large.positions) position *= 1024;
    Camera camera = room_camera(60);
    camera.eye *= 1024;
    camera.look_at *= 1024;
    EXPECT_EQ(render(camera, large.view()).rgb, metres.rgb);
}

TEST(Render, LeavesOutCornersThatAreNoNumbers) {
    Mesh mesh;
    add_triangle(mesh, {-9, -9, 0}, {30, -9, 0}, {-9, 30, 0}, white);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Camera camera = from_front(8);
    camera.near_depth = 1;
    camera.far_depth = 10;
    add_triangle(mesh, {nan, 0, 1}, {1, 0, 1}, {0, 1, nan}, {2, 2, 2});
    for (const float value : render(camera, mesh.view()).rgb) EXPECT_EQ(value, 1.0F);
}

TEST(Render, RefusesAPictureItCannotDrawExactly) {
    Camera camera = from_front(8);
    camera.width = 16385;
    EXPECT_THROW(render(camera, {}), std::invalid_argument);
    camera.width = -1;
    EXPECT_THROW(render(camera, {}), std::invalid_argument);
    EXPECT_THROW(render(from_front(8), {}, {0}), std::invalid_argument);
    EXPECT_THROW(render(from_front(8), {}, {9}), std::invalid_argument);
}

}  // namespace
}  // namespace patchlight::raster::render_test
