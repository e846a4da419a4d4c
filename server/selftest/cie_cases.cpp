#include "server/selftest/exact_factors.h"
#include "server/selftest/known_families.h"
#include "server/selftest/known_scene.h"
#include "server/selftest/known_way.h"
#include "server/wording.h"

#include <numbers>

namespace patchlight::server {
namespace {

// CIE 171:2006, "Test Cases to Assess the Accuracy of Lighting Computer Programs". Its tables are
// printed to a few digits; the exact column is that of the formula the case rests on.

/// Test case 5.6, scenario 2, table 17: light that a diffuse floor of 4 m × 4 m sends to a wall
/// (points B to F) and to a ceiling at 3 m (G to N), in per cent of the floor's exitance.
void answer_reflected_floor(AnswerSheet& sheet) {
    struct Point {
        const char* name;
        Vec3 position, normal;
        double published;
    };
    const Vec3 from_wall = Vec3::UnitY(), down = -Vec3::UnitZ();
    const std::vector<Point> points{
        {"B", {2, 0, 0.75}, from_wall, 35.901}, {"C", {2, 0, 1.25}, from_wall, 27.992},
        {"D", {2, 0, 1.75}, from_wall, 21.639}, {"E", {2, 0, 2.25}, from_wall, 16.716},
        {"F", {2, 0, 2.75}, from_wall, 12.967}, {"G", {2, 0.25, 3}, down, 26.80},
        {"H", {2, 0.75, 3}, down, 30.94},       {"I", {2, 1.25, 3}, down, 33.98},
        {"J", {2, 1.75, 3}, down, 35.57},       {"K", {2, 2.25, 3}, down, 35.57},
        {"L", {2, 2.75, 3}, down, 33.98},       {"M", {2, 3.25, 3}, down, 30.94},
        {"N", {2, 3.75, 3}, down, 26.80}};
    const std::vector<Vec3> floor{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    KnownScene built;
    built.polygon("S2", built.material(0.0, 1.0), floor);
    for (const Point& point : points) built.sensor(point.name, point.position, point.normal);
    const Solution solution = sheet.solve(built.scene, {});
    for (std::size_t k = 0; k < points.size(); ++k) {
        // The wall's points see the whole floor, for they are above it and it is before them.
        const double exact =
            100.0 * element_to_polygon(points[k].position, points[k].normal, floor);
        sheet.add({"CIE 171 5.6, floor", std::string("E at ") + points[k].name + ", %", "sensor",
                   100.0 * solution.sensors.at(k).irradiance[0], exact, quadrature * exact,
                   points[k].published});
    }
}

constexpr double edge = 4.0;      // of the cube [m]
constexpr double flux = 10000.0;  // of the point source at its centre [lm]
constexpr std::size_t parts = 4;  // of a wall along an edge

/// Every part of the walls gives off what it sends back of the point source's light: the mean of I
/// cosθ / r² over an area is I times its solid angle over the area.
Scene lit_by_a_point(double reflectance) {
    KnownScene built;
    const double intensity = flux / (4.0 * std::numbers::pi), step = 1.0 / parts;
    const double area = edge * edge / (parts * parts);
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t i = 0; i < parts; ++i)
            for (std::size_t j = 0; j < parts; ++j) {
                const double u = static_cast<double>(i) * step, v = static_cast<double>(j) * step;
                std::vector<Vec3> corners = cube_face(face, u, u + step, v, v + step);
                for (Vec3& corner : corners) corner *= edge;
                const double illuminance =
                    intensity * solid_angle(Vec3::Constant(0.5 * edge), corners) / area;
                built.polygon(cube_face_names[face],
                              built.material(reflectance, reflectance * illuminance), corners);
            }
    return built.scene;
}

void answer_reflected(AnswerSheet& sheet, double reflectance, double published,
                      const KnownWay& way) {
    const Solution solution =
        sheet.solve(lit_by_a_point(reflectance), settings_of(way, edge / parts, 1024));
    double power = 0.0, area = 0.0;
    for (const ObjectReport& object : solution.objects) {
        power += object.area * object.irradiance[0];
        area += object.area;
    }
    const double exact = flux * reflectance / (6.0 * edge * edge * (1.0 - reflectance));
    constexpr double float_rounding = 6e-8;
    const double defect =
        float_rounding + solution.form_factors.repaired.closure_max + *solution.settings.tolerance;
    sheet.add({"CIE 171 5.8, reflectance " + number_text(reflectance), "mean E, lx",
               method_text(solution.settings), power / area, exact,
               exact * defect / (1.0 - reflectance), published});
}

/// Test case 5.8, table 20: mean indirect illuminance of the walls of a closed cube of 4 m with a
/// point source of 10 000 lm at its centre: Φ ρ / (A (1 − ρ)).
void answer_closed_cube(AnswerSheet& sheet) {
    struct Row {
        double reflectance, published;  // [1], [lx]
    };
    constexpr Row table[] = {{0.0, 0.0},   {0.05, 5.48}, {0.1, 11.6},  {0.2, 26.0},
                             {0.3, 44.6},  {0.4, 69.4},  {0.5, 104.0}, {0.6, 156.0},
                             {0.7, 243.0}, {0.8, 417.0}, {0.9, 937.0}, {0.95, 1979.0}};
    for (const Row& row : table) answer_reflected(sheet, row.reflectance, row.published, {});
    for (const KnownWay& way : every_way()) answer_reflected(sheet, 0.8, 417.0, way);
}

}  // namespace

void answer_cie_cases(AnswerSheet& sheet) {
    answer_reflected_floor(sheet);
    answer_closed_cube(sheet);
}

}  // namespace patchlight::server
