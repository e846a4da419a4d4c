#include "server/selftest/exact_factors.h"
#include "server/selftest/known_families.h"
#include "server/selftest/known_scene.h"
#include "server/selftest/known_way.h"
#include "server/solve_json.h"
#include "server/wording.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight::server {
namespace {

using Corners = std::vector<Vec3>;

struct Pair {
    std::string name;
    Corners from, to;
    double exact = 0.0;
    Corners between = {};  // an obstacle
    std::optional<double> published = {};
};

Corners floor_of(Interval x, Interval y) {
    return {{x[0], y[0], 0}, {x[1], y[0], 0}, {x[1], y[1], 0}, {x[0], y[1], 0}};
}

/// Facing down.
Corners lid(Interval x, Interval y, double z) {
    return {{x[0], y[0], z}, {x[0], y[1], z}, {x[1], y[1], z}, {x[1], y[0], z}};
}

/// At x = 0, facing +x.
Corners wall(Interval y, Interval z) {
    return {{0, y[0], z[0]}, {0, y[1], z[0]}, {0, y[1], z[1]}, {0, y[0], z[1]}};
}

/// A regular polygon in a circle about the z axis, facing up, or down.
Corners regular(int corners, double radius, double z, bool down) {
    Corners polygon;
    for (int k = 0; k < corners; ++k) {
        const double angle = (down ? -2.0 : 2.0) * std::numbers::pi * k / corners;
        polygon.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
    return polygon;
}

Pair parallel(const std::string& name, Interval x, Interval y, Interval to_x, Interval to_y,
              double z) {
    return {name, floor_of(x, y), lid(to_x, to_y, z), parallel_rectangles(x, y, to_x, to_y, z)};
}

Pair perpendicular(const std::string& name, Interval x, Interval y, Interval to_y, Interval to_z) {
    return {name, floor_of(x, y), wall(to_y, to_z), perpendicular_rectangles(x, y, to_y, to_z)};
}

/// Double contour integral (Sparrow, "A New and Simpler Formulation for Radiative Angle Factors",
/// 1963), the inner in closed form, the outer by quadrature to 30 digits.
constexpr double coaxial_64_gons = 0.763657311094458151;

std::vector<Pair> pairs() {
    std::vector<Pair> all{
        parallel("facing squares", {0, 1}, {0, 1}, {0, 1}, {0, 1}, 1.0),
        parallel("facing 2 x 3, close", {0, 2}, {0, 3}, {0, 2}, {0, 3}, 0.5),
        parallel("parallel, shifted", {0, 2}, {0, 1}, {1.5, 4}, {-1, 0.5}, 1.25),
        perpendicular("squares at an edge", {0, 1}, {0, 1}, {0, 1}, {0, 1}),
        perpendicular("3 wide, 0.5 high at an edge", {0, 3}, {0, 2}, {0, 2}, {0, 0.5}),
        perpendicular("perpendicular, apart", {0.5, 2}, {0, 1}, {-0.5, 0.75}, {0.25, 1.5})};
    all.push_back({"coaxial 64-gons", regular(64, 1.0, 0.0, false), regular(64, 2.0, 1.0, true),
                   coaxial_64_gons});
    // Three faces alike share all of the light.
    all.push_back({"in a tetrahedron",
                   {{-1, 1, -1}, {1, -1, -1}, {1, 1, 1}},
                   {{1, -1, -1}, {-1, -1, 1}, {1, 1, 1}},
                   1.0 / 3.0});
    // The example `square-obstruction` of View3D (Walton, "Calculation of Obstructed View Factors
    // by Adaptive Integration", 2002). Of points p and q on the squares those are hidden for which
    // p + q is in the unit square: as the kernel depends on p − q alone, just a quarter.
    Pair hidden = all.front();
    hidden.name = "facing squares, obstructed";
    hidden.exact *= 0.75;
    hidden.between = {{0, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0.5}, {0, 0.5, 0.5}};
    all.push_back(hidden);
    return all;
}

/// Targets of the verification of OpenViewFactor, as it prints them.
std::vector<Pair> published_pairs() {
    struct Printed {
        double size, parallel, perpendicular;
    };
    constexpr Printed table[] = {{0.1, 0.003162056838754, 0.281887806787901},
                                 {0.4, 0.046137416744875, 0.250319555056282},
                                 {1.0, 0.199824895698387, 0.200043776075403},
                                 {4.0, 0.632036430013860, 0.101358700221681},
                                 {10.0, 0.826994522397256, 0.055023979528411}};
    std::vector<Pair> all;
    for (const Printed& row : table) {
        const Interval size{0, row.size}, edge{0, 1};
        const std::string x = number_text(row.size);
        all.push_back(parallel("plates " + x + " x " + x + " at 1", size, size, size, size, 1.0));
        all.back().published = row.parallel;
        all.push_back(perpendicular("plates 1 x " + x + " at an edge", size, edge, edge, size));
        all.back().published = row.perpendicular;
    }
    return all;
}

/// Standard errors as they are told with the factors; of hemicubes, the errors they report.
void answer_pair(AnswerSheet& sheet, const Pair& pair, Engine engine) {
    KnownScene built;
    const MaterialIndex black = built.material(0.0, 0.0);
    built.polygon("from", black, pair.from);
    built.polygon("to", black, pair.to);
    if (!pair.between.empty()) built.polygon("between", black, pair.between);
    constexpr double patches = 500.0;
    SolveSettings settings;
    settings.engine = engine;
    settings.patch_size = patch_size_for(built.scene, patches);
    if (engine == Engine::hemicube)
        settings.hemicube_resolution = 64;
    else
        settings.rays = 1024;
    const AnswerSheet::Factors found = sheet.view_factors(built.scene, settings);
    KnownAnswer answer{pair.name, "F", name_of(engine), 0.0, pair.exact};
    answer.published = pair.published;
    const GroupFactors& row = found.rows.front();
    for (std::size_t k = 0; k < row.to.size(); ++k)
        if (row.to[k] == 1) {
            answer.result = row.factors[k];
            answer.bound = deviations * row.errors[k];
        }
    if (engine == Engine::hemicube) {
        const HemicubeErrors& errors = *found.report.form_factors.hemicube;
        answer.bound =
            2.0 * errors.proximity + deviations * (errors.aliasing + errors.visibility) /
                                         std::sqrt(static_cast<double>(found.patches_of_first));
    }
    sheet.add(answer);
}

struct Element {
    std::string name;
    Vec3 point, normal;
    Corners to;
    std::optional<double> published = {};
};

/// Triangles that light the origin in the test suite of the renderer Nori: twice the radiance that
/// a reflectance of one half sends back there, as printed.
std::vector<Element> nori_luminaires() {
    const Vec3 origin = Vec3::Zero(), up = Vec3::UnitY();
    return {{"Nori luminaire 1",
             origin,
             up,
             {{-0.443432, 0.596366, 0.495985},
              {-0.320397, 0.0677699, -0.229359},
              {0.0341197, 0.11415, -0.343049}},
             2 * 0.0898394},
            {"Nori luminaire 2",
             origin,
             up,
             {{0.461963, 0.397843, 0.412747},
              {-0.0381582, 0.851323, -0.156872},
              {0.195443, 0.891957, -0.260672}},
             2 * 0.02292},
            {"Nori luminaire 3",
             origin,
             up,
             {{0.100871, 0.289075, -0.422609},
              {-0.308386, 0.629587, 0.423966},
              {-0.373132, 0.237287, 0.351592}},
             2 * 0.0534198},
            {"Nori luminaire 4",
             origin,
             up,
             {{-0.17575, 0.639397, 0.151268},
              {0.318604, 0.732996, 0.459771},
              {0.139095, 0.294498, 0.478556}},
             2 * 0.0205314},
            {"Nori luminaire 5",
             origin,
             up,
             {{-0.17487, 0.447916, 0.367201},
              {-0.405259, 0.249607, -0.354079},
              {0.356029, 0.0918984, -0.132271}},
             2 * 0.26174}};
}

std::vector<Element> elements() {
    const Vec3 origin = Vec3::Zero(), up = Vec3::UnitZ();
    std::vector<Element> all{{"element under a corner", origin, up, lid({0, 1}, {0, 1}, 1.0)},
                             {"element under the centre", origin, up, lid({-1, 1}, {-1, 1}, 1.0)},
                             {"element before a wall", {1, 0, 0}, up, wall({0, 1}, {0, 2})},
                             {"element under a 64-gon", origin, up, regular(64, 1.0, 1.0, true)},
                             {"element, oblique triangle",
                              origin,
                              Vec3(0.3, -0.2, 0.9).normalized(),
                              {{0.2, 0.6, 2.1}, {-0.7, 0.9, 0.5}, {1.2, -0.4, 0.3}}}};
    for (Element& luminaire : nori_luminaires()) all.push_back(std::move(luminaire));
    return all;
}

void answer_element(AnswerSheet& sheet, Element element) {
    double exact = element_to_polygon(element.point, element.normal, element.to);
    if (exact < 0.0) {  // the corners are listed as seen from behind
        std::reverse(element.to.begin(), element.to.end());
        exact = -exact;
    }
    KnownScene built;
    built.polygon("to", built.material(0.0, 1.0), element.to);
    built.sensor("element", element.point, element.normal);
    constexpr double patches = 50.0;
    const Solution solution =
        sheet.solve(built.scene, settings_of({}, patch_size_for(built.scene, patches), 64));
    sheet.add({element.name, "F", "sensor", solution.sensors.at(0).irradiance[0], exact,
               quadrature * exact, element.published});
}

}  // namespace

void answer_view_factors(AnswerSheet& sheet) {
    for (const Pair& pair : pairs())
        for (const Engine engine : {Engine::analytic, Engine::ray_cast, Engine::hemicube})
            answer_pair(sheet, pair, engine);
    for (const Pair& pair : published_pairs()) answer_pair(sheet, pair, Engine::analytic);
    for (const Element& element : elements()) answer_element(sheet, element);
}

}  // namespace patchlight::server
