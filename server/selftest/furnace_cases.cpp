#include "server/selftest/known_families.h"
#include "server/selftest/known_scene.h"
#include "server/selftest/known_way.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight::server {
namespace {

// Where all surfaces of a closed scene reflect ρ and give off E, B = E / (1 − ρ) everywhere.

constexpr double exitance = 1.0;  // [W/m²]
constexpr double patch_size = 0.34;
constexpr int rays = 256;

struct Furnace {
    std::string name;
    double reflectance = 0.0;
    Scene scene;
    double exact() const { return exitance / (1.0 - reflectance); }
};

Furnace cube(double reflectance, const std::string& name) {
    KnownScene built;
    built.room(std::vector<MaterialIndex>(6, built.material(reflectance, exitance)), {1, 1, 1});
    return {name, reflectance, built.scene};
}

Furnace round_a_block() {
    KnownScene built;
    const MaterialIndex grey = built.material(0.8, exitance);
    built.room(std::vector<MaterialIndex>(6, grey), {1, 1, 1});
    built.block("block", grey, {0.3, 0.45, 0.4}, {0.7, 0.75, 0.6}, 0.7);
    return {"round a floating block, 0.8", 0.8, built.scene};
}

Furnace l_shaped_room() {
    KnownScene built;
    const MaterialIndex grey = built.material(0.8, exitance);
    const Eigen::AngleAxisd turn(0.9, Vec3(1, 2, 3).normalized());
    const std::vector<Vec3> outline{{0, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                    {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    const Vec3 up = Vec3::UnitZ();
    std::vector<Vec3> floor, ceiling;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec3 a = outline[k], b = outline[(k + 1) % outline.size()];
        floor.push_back(turn * a);
        ceiling.insert(ceiling.begin(), turn * Vec3(a + up));
        built.polygon("wall", grey, {turn * a, turn * Vec3(a + up), turn * Vec3(b + up), turn * b});
    }
    built.polygon("floor", grey, floor);
    built.polygon("ceiling", grey, ceiling);
    return {"L-shaped room, turned, 0.8", 0.8, built.scene};
}

/// Shots and sweeps over closed rows keep all light, so the mean over all area is exact but for the
/// light that is still under way and what is left of a row's defect of closure.
void answer_mean(AnswerSheet& sheet, const Furnace& furnace, const Solution& solution) {
    double area = 0.0, power = 0.0;
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        area += solution.mesh.patches[i].area;
        power += solution.mesh.patches[i].area * solution.radiosity[i][0];
    }
    constexpr double float_rounding = 6e-8;
    const double defect =
        float_rounding + solution.form_factors.repaired.closure_max + *solution.settings.tolerance;
    sheet.add({furnace.name, "mean B", method_text(solution.settings), power / area,
               furnace.exact(), furnace.exact() * defect / (1.0 - furnace.reflectance)});
}

/// On rows that sum to 1 within `closure` sweeps end within closure · ρ / (1 − ρ) on every patch.
void answer_worst(AnswerSheet& sheet, const Furnace& furnace, const Solution& solution) {
    double worst = furnace.exact();
    for (const Rgb& radiosity : solution.radiosity)
        if (!(std::abs(radiosity[0] - furnace.exact()) <= std::abs(worst - furnace.exact())))
            worst = radiosity[0];
    constexpr double float_rounding = 6e-8;
    const double defect =
        float_rounding + solution.form_factors.repaired.closure_max + *solution.settings.tolerance;
    sheet.add({furnace.name, "B, worst patch", method_text(solution.settings), worst,
               furnace.exact(), furnace.exact() * defect / (1.0 - furnace.reflectance)});
}

/// √∫(B̃ − B)² over √∫(B − E)² of a linear field over the display's triangles; the former integral
/// of the squares of a linear function by the midpoints of edges, exactly.
double field_error(const Furnace& furnace, const DisplayMesh& display) {
    double squared = 0.0, area = 0.0;
    for (const auto& corners : display.triangles) {
        const Vec3 &a = display.positions[corners[0]], &b = display.positions[corners[1]],
                   &c = display.positions[corners[2]];
        const double size = 0.5 * Vec3(b - a).cross(c - a).norm();
        area += size;
        for (std::size_t k = 0; k < 3; ++k) {
            const double middle = 0.5 * (display.radiosity[corners[k]][0] +
                                         display.radiosity[corners[(k + 1) % 3]][0]);
            squared += size / 3.0 * std::pow(middle - furnace.exact(), 2);
        }
    }
    return std::sqrt(squared / area) / (furnace.exact() - exitance);
}

}  // namespace

void answer_furnaces(AnswerSheet& sheet) {
    for (const Furnace& furnace :
         {cube(0.5, "cube, 0.5"), cube(0.99, "cube, 0.99"), round_a_block(), l_shaped_room()}) {
        for (const KnownWay& way : every_way()) {
            const Solution solution =
                sheet.solve(furnace.scene, settings_of(way, patch_size, rays));
            answer_mean(sheet, furnace, solution);
            if (way.method == Method::gauss_seidel) answer_worst(sheet, furnace, solution);
        }
        const Solution solution = sheet.solve(furnace.scene, to_accuracy(0.01));
        sheet.add_field_error(furnace.name, "error of the field", solution,
                              field_error(furnace, solution.display));
    }
}

}  // namespace patchlight::server
