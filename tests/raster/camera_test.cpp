#include "raster/camera.h"

#include "raster/screen.h"

#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>

namespace patchlight::raster::camera_test {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double rounding = 1e-9;  // double arithmetic over a handful of operations

const AlignedBox3d unit_room(Vector3d::Zero(), Vector3d::Ones());

Camera from_front(Projection projection) {
    Camera camera;
    camera.eye = {0.0, 0.0, 5.0};
    camera.projection = projection;
    camera.vertical_fov = 90.0;  // 5 to either side at the origin
    camera.view_height = 10.0;   // the same
    camera.width = 200;
    camera.height = 100;
    return camera;
}

void expect_pixel(const Camera& camera, const Vector3d& point, double x, double y) {
    const AlignedBox3d bounds(Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
    const Vector4d canonical = canonical_from_world(camera, bounds) * point.homogeneous();
    const auto screen = screen_vertex(canonical, {camera.width, camera.height});
    ASSERT_TRUE(screen);
    EXPECT_NEAR(screen->x, x, rounding * camera.width);
    EXPECT_NEAR(screen->y, y, rounding * camera.height);
}

TEST(Camera, BothProjectionsPutKnownPointsOnKnownPixels) {
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        const Camera camera = from_front(projection);
        expect_pixel(camera, {0, 0, 0}, 100, 50);
        expect_pixel(camera, {0, 5, 0}, 100, 0);
        expect_pixel(camera, {10, 0, 0}, 200, 50);
        expect_pixel(camera, {-4, -3, 0}, 60, 80);
    }
}

TEST(Camera, PerspectiveShrinksWithDepthAndParallelDoesNot) {
    expect_pixel(from_front(Projection::perspective), {1, 1, -1}, 100 + 50.0 / 6, 50 - 50.0 / 6);
    expect_pixel(from_front(Projection::parallel), {1, 1, -1}, 110, 40);
}

TEST(Camera, ImageXRunsAlongViewCrossUp) {
    Camera camera;  // looks along +z, so that world x runs to the left
    camera.eye = {278, 273, -800};
    camera.look_at = {278, 273, 0};
    const Vector4d left = view_from_world(camera) * Vector3d(300, 273, 0).homogeneous();
    EXPECT_NEAR(left.x(), -22.0, rounding * 800);
    EXPECT_NEAR(left.y(), 0.0, rounding * 800);
    EXPECT_NEAR(left.z(), -800.0, rounding * 800);
}

TEST(Camera, UpNeedNotBeAtRightAnglesToTheView) {
    Camera camera;
    camera.eye = {0, 3, 4};
    camera.up = {0, 10, 0};
    const Eigen::Matrix3d axes = view_from_world(camera).block<3, 3>(0, 0);
    EXPECT_TRUE((axes * axes.transpose()).isIdentity(rounding));
    EXPECT_NEAR(axes.determinant(), 1.0, rounding);
    EXPECT_NEAR((axes * camera.up).x(), 0.0, rounding);
}

TEST(Camera, NearDepthIsOnTheFrontPlaneAndFarDepthOnTheBackPlane) {
    for (const Projection projection : {Projection::perspective, Projection::parallel}) {
        const Eigen::Matrix4d canonical =
            canonical_from_view(from_front(projection), {0.25, 1000.0});
        const Vector4d front = canonical * Vector4d(0, 0, -0.25, 1);
        const Vector4d back = canonical * Vector4d(0, 0, -1000.0, 1);
        EXPECT_NEAR(front.z(), front.w(), rounding);
        EXPECT_NEAR(back.z(), 0.0, rounding);
        EXPECT_NEAR(back.w(), 1.0, rounding);
    }
}

TEST(Camera, DepthsFromTheBoundsHoldAllInFrontOfTheEye) {
    Camera outside = from_front(Projection::perspective);
    const DepthRange range =
        depth_range(outside, AlignedBox3d(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)));
    EXPECT_LT(range.near_depth, 4.0);
    EXPECT_GT(range.near_depth, 3.9);
    EXPECT_GT(range.far_depth, 6.0);

    Camera inside;
    inside.eye = {0.5, 0.5, 0.9};
    inside.look_at = {0.5, 0.5, 0.0};
    const DepthRange room = depth_range(inside, unit_room);
    EXPECT_GT(room.near_depth, 0.0);
    EXPECT_LT(room.near_depth, 1e-4);
    EXPECT_GT(room.far_depth, 0.9);
}

TEST(Camera, DepthsMakeAVolumeWhateverTheBoundsAre) {
    const Camera camera = from_front(Projection::perspective);
    const Vector3d point(1, 2, 3);
    for (const AlignedBox3d& bounds : {AlignedBox3d(), AlignedBox3d(point, point),
                                       AlignedBox3d(Vector3d(0, 0, 9), Vector3d(1, 1, 10))}) {
        const DepthRange range = depth_range(camera, bounds);
        EXPECT_GT(range.near_depth, 0.0);
        EXPECT_GT(range.far_depth, range.near_depth);
    }
}

TEST(Camera, DepthsThatAreAskedForWinOverThoseFromTheBounds) {
    Camera camera = from_front(Projection::perspective);
    camera.near_depth = 20.0;  // beyond the bounds
    const Vector4d front = canonical_from_world(camera, unit_room) * Vector4d(0, 0, -15, 1);
    EXPECT_NEAR(front.z(), front.w(), rounding);
    camera.near_depth.reset();
    camera.far_depth = 2.0;  // before the bounds
    const Vector4d back = canonical_from_world(camera, unit_room) * Vector4d(0, 0, 3, 1);
    EXPECT_NEAR(back.z(), 0.0, rounding);
}

TEST(Camera, ThatSeesNoVolumeIsRefused) {
    const auto expect_refused = [](const Camera& camera) {
        EXPECT_THROW(canonical_from_world(camera, unit_room), std::invalid_argument);
    };
    Camera camera;
    camera.look_at = camera.eye;
    expect_refused(camera);
    camera = {};
    camera.up = {0, 0, -2};
    expect_refused(camera);
    camera = {};
    camera.eye.x() = std::numeric_limits<double>::quiet_NaN();
    expect_refused(camera);
    camera = {};
    camera.vertical_fov = 180.0;
    expect_refused(camera);
    camera = {};
    camera.projection = Projection::parallel;
    camera.view_height = 0.0;
    expect_refused(camera);
    camera = {};
    camera.width = 0;
    expect_refused(camera);
    camera = {};
    camera.near_depth = 2.0;
    camera.far_depth = 1.0;
    expect_refused(camera);
}

TEST(Framing, ShowsTheWholeBox) {
    for (const Vector3d& size : {Vector3d(1, 1, 1), Vector3d(100, 0, 3), Vector3d(0, 1e-3, 0)}) {
        for (const int width : {64, 512, 2048}) {
            const AlignedBox3d box(Vector3d(7, -2, 1), Vector3d(7, -2, 1) + size);
            const Eigen::Matrix4d canonical = canonical_from_world(framing(box, width, 512), box);
            for (int i = 0; i < 8; ++i) {
                const auto corner = box.corner(static_cast<AlignedBox3d::CornerType>(i));
                const Vector4d seen = canonical * corner.homogeneous();
                EXPECT_GT(seen.z(), 0.0);
                EXPECT_LT(seen.z(), seen.w());
                EXPECT_LT(std::abs(seen.x()), seen.w());
                EXPECT_LT(std::abs(seen.y()), seen.w());
            }
        }
    }
}

TEST(Framing, FillsMostOfThePicture) {
    const Eigen::Matrix4d canonical = canonical_from_world(framing(unit_room, 512, 512), unit_room);
    double farthest_out = 0.0;
    for (int i = 0; i < 8; ++i) {
        const Vector4d seen =
            canonical * unit_room.corner(static_cast<AlignedBox3d::CornerType>(i)).homogeneous();
        farthest_out = std::max(farthest_out, seen.head<2>().cwiseAbs().maxCoeff() / seen.w());
    }
    EXPECT_GT(farthest_out, 0.9);
}

}  // namespace
}  // namespace patchlight::raster::camera_test
