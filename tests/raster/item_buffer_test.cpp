#include "raster/item_buffer.h"

#include "raster/camera.h"
#include "tests/raster/meshes.h"

#include <gtest/gtest.h>
#include <limits>
#include <numeric>

namespace patchlight::raster::item_buffer_test {
namespace {

constexpr int size = 64;  // [pixels]

/// Draws the mesh as `camera` sees it, triangle t as item t.
ItemBuffer drawn(const Mesh& mesh, const Camera& camera) {
    Eigen::AlignedBox3d bounds;
    for (const auto& position : mesh.positions)
        if (position.allFinite()) bounds.extend(position);
    const Eigen::Matrix4d canonical = canonical_from_world(camera, bounds);
    std::vector<Eigen::Vector4d> positions;
    for (const auto& position : mesh.positions)
        positions.emplace_back(canonical * position.homogeneous());
    std::vector<std::uint32_t> items(mesh.triangles.size());
    std::iota(items.begin(), items.end(), 0U);
    ItemBuffer buffer(camera.width, camera.height);
    buffer.draw(positions, mesh.triangles, items);
    return buffer;
}

Camera from_front() {
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.vertical_fov = 90;
    camera.width = camera.height = size;
    return camera;
}

std::uint32_t item_at(const ItemBuffer& buffer, int x, int y) {
    return buffer.items()[static_cast<std::size_t>(y * buffer.viewport().width + x)];
}

TEST(ItemBuffer, ShowsTheNearestAndNothingElsewhere) {
    Mesh mesh;
    add_triangle(mesh, {-4, -4, 1}, {0, -4, 1}, {-4, 0, 1});
    add_triangle(mesh, {-20, -20, -1}, {20, -20, -1}, {0, 0, -1});
    const ItemBuffer buffer = drawn(mesh, from_front());
    EXPECT_EQ(item_at(buffer, 2, size - 3), 0U);
    EXPECT_EQ(item_at(buffer, size - 3, size - 2), 1U);
    EXPECT_EQ(item_at(buffer, size / 2, 2), ItemBuffer::nothing);
}

TEST(ItemBuffer, ShowsBothSides) {
    Mesh mesh;
    add_triangle(mesh, {-9, -9, 0}, {-9, 30, 0}, {30, -9, 0});  // clockwise
    const ItemBuffer buffer = drawn(mesh, from_front());
    for (const std::uint32_t item : buffer.items()) EXPECT_EQ(item, 0U);
}

TEST(ItemBuffer, OfCoplanarTrianglesTheOneDrawnLastIsSeen) {
    for (const double lean : {0.0, 0.3, 3.0, 30.0}) {
        // Two cuts of the same leaning plane that share no corner, so they round differently.
        const auto on_plane = [&](double x, double y) {
            return Eigen::Vector3d(x, y, 0.1 * lean * x - lean * (y + 1.0));
        };
        Mesh mesh;
        add_triangle(mesh, on_plane(-7, -1), on_plane(9, -1), on_plane(1.3, 8));
        add_triangle(mesh, on_plane(-1.1, -0.7), on_plane(2.3, -0.9), on_plane(0.2, 3.7));
        const ItemBuffer both = drawn(mesh, from_front());
        mesh.triangles.erase(mesh.triangles.begin());
        const ItemBuffer alone = drawn(mesh, from_front());
        for (std::size_t pixel = 0; pixel < both.items().size(); ++pixel)
            EXPECT_TRUE(alone.items()[pixel] != 0U || both.items()[pixel] == 1U) << lean;
    }
}

TEST(ItemBuffer, InsideAClosedRoomNoPixelIsEmpty) {
    const ItemBuffer buffer = drawn(room_with_block(7), room_camera(200));
    for (const std::uint32_t item : buffer.items()) EXPECT_NE(item, ItemBuffer::nothing);
}

TEST(ItemBuffer, IsEmptyAgainAfterClear) {
    Mesh mesh;
    add_triangle(mesh, {-9, -9, 0}, {30, -9, 0}, {-9, 30, 0});
    ItemBuffer buffer = drawn(mesh, from_front());
    buffer.clear();
    for (const std::uint32_t item : buffer.items()) EXPECT_EQ(item, ItemBuffer::nothing);
}

TEST(ItemBuffer, LeavesOutTrianglesThatAreNoTriangles) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    Mesh mesh;
    add_triangle(mesh, {nan, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_triangle(mesh, {0, 0, 0}, {infinity, 0, 0}, {0, 1, 0});
    add_triangle(mesh, {0, 0, 0}, {1, 1, 0}, {2, 2, 0});
    add_triangle(mesh, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    add_triangle(mesh, {0, 0, 5}, {0, 1, 5}, {1, 0, 5});  // in the plane of the eye
    const ItemBuffer buffer = drawn(mesh, from_front());
    for (const std::uint32_t item : buffer.items()) EXPECT_EQ(item, ItemBuffer::nothing);
}

TEST(ItemBuffer, RefusesASizeItCannotCountExactly) {
    EXPECT_THROW(ItemBuffer(0, 10), std::invalid_argument);
    EXPECT_THROW(ItemBuffer(10, 16385), std::invalid_argument);
}

}  // namespace
}  // namespace patchlight::raster::item_buffer_test
