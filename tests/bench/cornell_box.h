#pragma once

#include "solver/solve_scene.h"

#include <Eigen/Core>

#include <vector>

namespace patchlight {

/// The published Cornell box (Cornell University Program of Computer Graphics), the ceiling as
/// eight polygons round the lamp, in metres.
inline Scene cornell_box() {
    Scene scene;
    scene.materials = {{"white", Rgb::Constant(0.73), Rgb::Zero(), false},
                       {"red", Rgb(0.65, 0.05, 0.05), Rgb::Zero(), false},
                       {"green", Rgb(0.12, 0.45, 0.15), Rgb::Zero(), false},
                       {"lamp", Rgb::Constant(0.78), Rgb(53.4, 37.7, 12.6), false}};
    const auto add = [&](const char* name, MaterialIndex material, std::vector<Vec3> corners) {
        for (Vec3& p : corners) p *= 1e-3;
        scene.objects.push_back({name});
        add_polygon(scene, static_cast<ObjectIndex>(scene.objects.size() - 1), material, 0, corners,
                    "");
    };
    add("floor", 0, {{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}});
    const double x[] = {0, 213, 343, 556}, z[] = {0, 227, 332, 559.2}, y = 548.8;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            add("ceiling", i == 1 && j == 1 ? 3 : 0,
                {{x[i + 1], y, z[j]},
                 {x[i + 1], y, z[j + 1]},
                 {x[i], y, z[j + 1]},
                 {x[i], y, z[j]}});
    add("back wall", 0, {{549.6, 0, 559.2}, {0, 0, 559.2}, {0, y, 559.2}, {556, y, 559.2}});
    add("right wall", 2, {{0, 0, 559.2}, {0, 0, 0}, {0, y, 0}, {0, y, 559.2}});
    add("left wall", 1, {{552.8, 0, 0}, {549.6, 0, 559.2}, {556, y, 559.2}, {556, y, 0}});
    const auto block = [&](const char* name, const std::vector<Eigen::Vector2d>& foot,
                           double height) {
        const auto at = [&](std::size_t k, double h) {
            return Vec3(foot[k % 4].x(), h, foot[k % 4].y());
        };
        add(name, 0, {at(0, height), at(1, height), at(2, height), at(3, height)});
        for (std::size_t k = 0; k < 4; ++k)
            add(name, 0, {at(k, 0), at(k, height), at(k + 3, height), at(k + 3, 0)});
    };
    block("short block", {{130, 65}, {82, 225}, {240, 272}, {290, 114}}, 165);
    block("tall block", {{423, 247}, {265, 296}, {314, 456}, {472, 406}}, 330);
    return scene;
}

}  // namespace patchlight
