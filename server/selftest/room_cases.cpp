#include "server/selftest/cornell_box.h"
#include "server/selftest/known_families.h"
#include "server/selftest/known_scene.h"
#include "server/selftest/known_way.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace patchlight::server {
namespace {

/// Irradiance (luminance of it) by path tracing with next-event estimation in double precision, 3e7
/// paths a point, by a program of a few lines that shares nothing with this one; and its standard
/// error.
struct Traced {
    const char* name;
    Vec3 position, normal;
    double irradiance, standard_error;
};

/// The part of a sensor's stated error that is noise is the difference of two gatherings, which is
/// small by chance now and then: all are held to the largest that is stated, in relation.
void answer_room(AnswerSheet& sheet, const std::string& name, KnownScene built,
                 std::span<const Traced> points, double accuracy) {
    for (const Traced& point : points) built.sensor(point.name, point.position, point.normal);
    const Solution solution = sheet.solve(built.scene, to_accuracy(accuracy));
    double stated = 0.0;
    for (const SensorReport& sensor : solution.sensors)
        stated = std::max(stated, sensor.error / luminance(sensor.irradiance));
    for (std::size_t s = 0; s < points.size(); ++s)
        sheet.add(
            {name, std::string("E, ") + points[s].name, method_text(solution.settings),
             luminance(solution.sensors.at(s).irradiance), points[s].irradiance,
             deviations * std::hypot(stated * points[s].irradiance, points[s].standard_error)});
}

std::vector<Vec3> level(double x0, double x1, double y0, double y1, double z, bool up) {
    std::vector<Vec3> corners{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    if (!up) std::reverse(corners.begin(), corners.end());
    return corners;
}

/// At x, with a doorway from y = 1 to 2 up to z = 2, or without.
std::vector<Vec3> cross_wall(double x, bool faces_low, bool is_open) {
    std::vector<Vec3> corners{{x, 3, 0}, {x, 3, 2.5}, {x, 0, 2.5}, {x, 0, 0}};
    if (is_open) corners.insert(corners.end(), {{x, 1, 0}, {x, 1, 2}, {x, 2, 2}, {x, 2, 0}});
    if (faces_low) std::reverse(corners.begin(), corners.end());
    return corners;
}

constexpr double length = 4.0;  // of a room along x [m]

void add_chamber(KnownScene& built, double x, MaterialIndex floor, MaterialIndex wall,
                 const std::string& name) {
    const double end = x + length;
    built.polygon(name + "/floor", floor, level(x, end, 0, 3, 0, true));
    built.polygon(name + "/ceiling", wall, level(x, end, 0, 3, 2.5, false));
    built.polygon(name + "/side", wall, {{x, 0, 0}, {x, 0, 2.5}, {end, 0, 2.5}, {end, 0, 0}});
    built.polygon(name + "/side", wall, {{x, 3, 0}, {end, 3, 0}, {end, 3, 2.5}, {x, 3, 2.5}});
}

/// Two rooms of 4 m × 3 m × 2.5 m with a wall of some thickness between; a lamp of 1 m² in the
/// ceiling of the first lights the second through a doorway alone, or not at all.
KnownScene two_chambers(double thickness, bool is_open) {
    KnownScene built;
    const MaterialIndex floor = built.material(0.3, 0.0), wall = built.material(0.7, 0.0),
                        lamp = built.material(0.7, 1000.0);
    const double second = length + thickness, end = second + length;
    add_chamber(built, 0.0, floor, wall, "first");
    add_chamber(built, second, floor, wall, "second");
    built.polygon("first/lamp", lamp, level(1.5, 2.5, 1, 2, 2.5, false));
    built.polygon("first/end", wall, {{0, 0, 0}, {0, 3, 0}, {0, 3, 2.5}, {0, 0, 2.5}});
    built.polygon("second/end", wall, {{end, 0, 0}, {end, 0, 2.5}, {end, 3, 2.5}, {end, 3, 0}});
    built.polygon("first/wall", wall, cross_wall(length, true, is_open));
    built.polygon("second/wall", wall, cross_wall(second, false, is_open));
    if (!is_open) return built;
    built.polygon("sill", floor, level(length, second, 1, 2, 0, true));
    built.polygon("lintel", wall, level(length, second, 1, 2, 2, false));
    built.polygon("jamb", wall, {{length, 1, 0}, {length, 1, 2}, {second, 1, 2}, {second, 1, 0}});
    built.polygon("jamb", wall, {{length, 2, 0}, {second, 2, 0}, {second, 2, 2}, {length, 2, 2}});
    return built;
}

/// No light may come into the second room, be the wall as thin as it may.
void answer_leaks(AnswerSheet& sheet) {
    const auto answer = [&](double thickness, const std::string& name,
                            const SolveSettings& settings) {
        const Scene scene = two_chambers(thickness, false).scene;
        const Solution solution = sheet.solve(scene, settings);
        double most = 0.0;
        for (std::size_t o = 0; o < scene.objects.size(); ++o)
            if (scene.objects[o].name.starts_with("second/"))
                most = std::max({most, solution.objects[o].irradiance.maxCoeff(),
                                 solution.objects[o].max.maxCoeff()});
        sheet.add({name, "most light behind", method_text(solution.settings), most, 0.0, 0.0});
    };
    for (const KnownWay& way : every_way())
        answer(0.0, "two rooms, wall of 0 m", settings_of(way, 0.5, 256));
    answer(0.0, "two rooms, wall of 0 m", to_accuracy(0.05));
}

void answer_doorway(AnswerSheet& sheet) {
    const std::array points{
        Traced{"first floor", {2, 0.5, 0}, {0, 0, 1}, 61.858512, 0.0038},
        Traced{"second floor", {5.2, 1.5, 0}, {0, 0, 1}, 10.82937, 0.0019},
        Traced{"beside the door", {5.2, 2.7, 0.8}, {0, 0, 1}, 2.1342793, 0.0015},
        Traced{"far end", {8.2, 1.5, 1.2}, {-1, 0, 0}, 2.1549665, 0.0014},
        Traced{"second ceiling", {6.2, 1.5, 2.5}, {0, 0, -1}, 2.2188154, 0.0014}};
    answer_room(sheet, "two rooms, doorway", two_chambers(0.2, true), points, 0.02);
}

void answer_cornell_box(AnswerSheet& sheet) {
    const std::array points{
        Traced{"floor", {.278, 0, .1}, {0, 1, 0}, 0.048721, 0.000024},
        Traced{"floor, left", {.45, 0, .2}, {0, 1, 0}, 0.491279, 0.000045},
        Traced{"short block", {.186, .165, .169}, {0, 1, 0}, 1.053173, 0.000054},
        Traced{"back", {.278, .45, .5592}, {0, 0, -1}, 0.908591, 0.000089},
        Traced{"ceiling", {.1, .5488, .28}, {0, -1, 0}, 0.315823, 0.000072}};
    answer_room(sheet, "Cornell box", cornell_box(), points, 0.01);
}

}  // namespace

void answer_rooms(AnswerSheet& sheet) {
    answer_leaks(sheet);
    answer_doorway(sheet);
    answer_cornell_box(sheet);
}

}  // namespace patchlight::server
