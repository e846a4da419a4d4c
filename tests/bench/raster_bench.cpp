// Time of one picture of a box room, as CSV. The room is seen from inside, so every pixel is
// covered; a block in the middle hides some of it.

#include "raster/item_buffer.h"
#include "raster/render.h"
#include "tests/raster/meshes.h"

#include <tbb/global_control.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <vector>

namespace {

using namespace patchlight::raster;

/// Least time of several runs [ms].
double least_time(const std::function<void()>& work) {
    double least = 1e9;
    for (int run = 0; run < 15; ++run) {
        const auto start = std::chrono::steady_clock::now();
        work();
        const std::chrono::duration<double, std::milli> taken =
            std::chrono::steady_clock::now() - start;
        least = std::min(least, taken.count());
    }
    return least;
}

void time_item_buffer(const Mesh& mesh, const Camera& camera) {
    Eigen::AlignedBox3d bounds;
    for (const auto& position : mesh.positions) bounds.extend(position);
    const Eigen::Matrix4d canonical = canonical_from_world(camera, bounds);
    std::vector<Eigen::Vector4d> positions;
    for (const auto& position : mesh.positions)
        positions.emplace_back(canonical * position.homogeneous());
    std::vector<std::uint32_t> items(mesh.triangles.size());
    for (std::size_t t = 0; t < items.size(); ++t) items[t] = static_cast<std::uint32_t>(t);
    ItemBuffer buffer(camera.width, camera.height);
    const double time = least_time([&] {
        buffer.clear();
        buffer.draw(positions, mesh.triangles, items);
    });
    std::printf("items,%zu,%d,1,1,%.2f\n", mesh.triangles.size(), camera.width, time);
}

}  // namespace

int main() {
    std::printf("what,triangles,pixels,samples,threads,ms\n");
    for (const int cuts : {4, 23, 92}) {
        const Mesh mesh = room_with_block(cuts);
        const Camera camera = room_camera(512);
        for (const int samples_per_axis : {1, 2, 4, 8}) {
            for (const std::size_t threads : {1U, 2U}) {
                const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                                threads);
                const double time =
                    least_time([&] { render(camera, mesh.view(), {samples_per_axis}); });
                std::printf("render,%zu,%d,%d,%zu,%.2f\n", mesh.triangles.size(), camera.width,
                            samples_per_axis * samples_per_axis, threads, time);
            }
        }
        time_item_buffer(mesh, room_camera(256));
    }
}
