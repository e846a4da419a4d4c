#include "server/selftest/cornell_box.h"

#include <array>
#include <numbers>

namespace patchlight::server {
namespace {

using Corners = std::vector<Vec3>;

/// Top and sides of a block whose top has these corners in order; the bottom rests on the floor.
void add_block(KnownScene& built, const std::string& name, MaterialIndex white,
               const Corners& top) {
    built.polygon(name + "/top", white, top);
    for (std::size_t k = 0; k < top.size(); ++k) {
        const Vec3 &a = top[k], &b = top[(k + 1) % top.size()];
        built.polygon(name + "/side", white, {b, a, {a.x(), 0, a.z()}, {b.x(), 0, b.z()}});
    }
}

}  // namespace

KnownScene cornell_box() {
    KnownScene built;
    const MaterialIndex white = built.material(0.73, 0.0),
                        red = built.material(Rgb(0.65, 0.05, 0.05), Rgb::Zero()),
                        green = built.material(Rgb(0.12, 0.45, 0.15), Rgb::Zero()),
                        lamp = built.material(Rgb::Constant(0.78),
                                              std::numbers::pi * Rgb(17.0, 12.0, 4.0));
    built.polygon("floor", white, {{.5528, 0, 0}, {0, 0, 0}, {0, 0, .5592}, {.5496, 0, .5592}});
    built.polygon("ceiling", white,
                  {{.556, .5488, 0}, {.556, .5488, .5592}, {0, .5488, .5592}, {0, .5488, 0}});
    built.polygon("back", white,
                  {{.5496, 0, .5592}, {0, 0, .5592}, {0, .5488, .5592}, {.556, .5488, .5592}});
    built.polygon("right", green, {{0, 0, .5592}, {0, 0, 0}, {0, .5488, 0}, {0, .5488, .5592}});
    built.polygon("left", red,
                  {{.5528, 0, 0}, {.5496, 0, .5592}, {.556, .5488, .5592}, {.556, .5488, 0}});
    built.polygon(
        "lamp", lamp,
        {{.343, .5488, .227}, {.343, .5488, .332}, {.213, .5488, .332}, {.213, .5488, .227}});
    add_block(built, "short", white,
              {{.130, .165, .065}, {.082, .165, .225}, {.240, .165, .272}, {.290, .165, .114}});
    add_block(built, "tall", white,
              {{.423, .330, .247}, {.265, .330, .296}, {.314, .330, .456}, {.472, .330, .406}});
    return built;
}

}  // namespace patchlight::server
