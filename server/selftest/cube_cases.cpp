#include "server/selftest/exact_factors.h"
#include "server/selftest/face_means.h"
#include "server/selftest/known_families.h"
#include "server/selftest/known_scene.h"
#include "server/selftest/known_way.h"
#include "server/selftest/worst_of.h"

#include <Eigen/LU>

#include <cmath>

namespace patchlight::server {
namespace {

using Six = Eigen::Array<double, 6, 1>;

double beside() { return perpendicular_rectangles({0, 1}, {0, 1}, {0, 1}, {0, 1}); }
double opposite() { return parallel_rectangles({0, 1}, {0, 1}, {0, 1}, {0, 1}, 1.0); }

/// B of the system of six patches, E + ρ F B, by elimination.
Six exact_radiosity(const Six& exitance, const Six& reflectance) {
    Eigen::Matrix<double, 6, 6> system;
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j) {
            const double factor = i == j ? 0.0 : i / 2 == j / 2 ? opposite() : beside();
            system(i, j) = (i == j ? 1.0 : 0.0) - reflectance[i] * factor;
        }
    return system.partialPivLu().solve(exitance.matrix()).array();
}

/// One patch a face: the answer is that of linear algebra, not of a cube whose faces are lit
/// unevenly.
void answer_six_patches(AnswerSheet& sheet, const std::string& name, const Six& exitance,
                        const Six& reflectance) {
    KnownScene built;
    std::vector<MaterialIndex> materials;
    for (Eigen::Index f = 0; f < 6; ++f)
        materials.push_back(built.material(reflectance[f], exitance[f]));
    built.room(materials, {1, 1, 1});
    const Solution solution = sheet.solve(built.scene, settings_of({}, 1.0, 1024));
    const Six exact = exact_radiosity(exitance, reflectance);
    constexpr double float_rounding = 6e-8;
    const double defect =
        (float_rounding + *solution.settings.tolerance) / (1.0 - reflectance.maxCoeff());
    std::vector<KnownAnswer> answers;
    for (std::size_t f = 0; f < 6; ++f) {
        const double b = exact[static_cast<Eigen::Index>(f)];
        answers.push_back({name, std::string("B of ") + cube_face_names[f],
                           method_text(solution.settings), solution.radiosity.at(f)[0], b,
                           b * std::max(defect, quadrature)});
    }
    sheet.add(worst_of(answers));
}

/// A cube that reflects alike everywhere, with means of B over its faces: of the continuous
/// solution, and of piecewise constant radiosity on a grid of n × n patches a face as perfect
/// factors would have it. The numbers come of such grids up to n = 128 with factors of closed form
/// (Howell C-13, C-15) and of their limit (Richardson), which is good to 1e-7.
struct LitCube {
    std::string name;
    Scene scene;
    double reflectance = 0.0;
    SixMeans exitance{};  // mean of each face [W/m²]
    std::size_t n = 0;
    SixMeans on_grid, in_the_limit;
};

SixMeans means(double walls, double floor, double ceiling) {
    return {walls, walls, walls, walls, floor, ceiling};
}

LitCube lit_floor() {
    KnownScene built;
    const MaterialIndex wall = built.material(0.5, 0.0), lit = built.material(0.5, 1.0);
    built.room({wall, wall, wall, wall, lit, wall}, {1, 1, 1});
    return {"cube, lit floor",
            built.scene,
            0.5,
            means(0.0, 1.0, 0.0),
            8,
            means(0.1811955237, 1.1038446817, 0.1713732235),
            means(0.181105586, 1.104361621, 0.171216034)};
}

LitCube ceiling_light() {
    KnownScene built;
    const MaterialIndex wall = built.material(0.7, 0.0);
    built.room(std::vector<MaterialIndex>(6, wall), {1, 1, 1});
    built.polygon("z1 light", built.material(0.7, 1.0), cube_face(5, 0.25, 0.75, 0.25, 0.75));
    return {"cube, ceiling light",
            built.scene,
            0.7,
            means(0.0, 0.0, 0.25),
            16,
            means(0.1013472595, 0.1049119529, 0.3230323423),
            means(0.101352741, 0.104918282, 0.323004089)};
}

void answer_by_hand(AnswerSheet& sheet, const LitCube& cube, const KnownWay& way) {
    const double edge = 1.0 / static_cast<double>(cube.n);
    const int cells = cube.n < 16 ? 64 * 64 : 32 * 32;
    const Solution solution = sheet.solve(
        cube.scene, settings_of(way, edge, way.engine == Engine::hemicube ? cells : 1024));
    double squared = 0.0;
    for (const double b : cube.on_grid) squared += b * b;
    // A factor that is off by δ brings a face ρ δ B of light too much, and that goes round.
    const double passed_on = cube.reflectance / (1.0 - cube.reflectance) * std::sqrt(squared);
    const double patches = static_cast<double>(cube.n * cube.n);
    const double bound = passed_on * factor_bound(solution, 0.2, patches);
    const SixMeans found = patch_means(cube.scene, solution);
    std::vector<KnownAnswer> answers;
    for (std::size_t f = 0; f < 6; ++f)
        answers.push_back({cube.name, std::string("mean B of ") + cube_face_names[f],
                           method_text(solution.settings), found[f], cube.on_grid[f], bound});
    sheet.add(worst_of(answers));
}

/// The means of six faces show no more of the field's error than there is, for √Σ A (mean of the
/// error)² <= √∫ error². What they reflect is no more than its norm, either, but near to it.
void answer_to_accuracy(AnswerSheet& sheet, const LitCube& cube, double accuracy) {
    const Solution solution = sheet.solve(cube.scene, to_accuracy(accuracy));
    const SixMeans found = display_means(cube.scene, solution);
    double wrong = 0.0, reflected = 0.0;
    for (std::size_t f = 0; f < 6; ++f) {
        wrong += std::pow(found[f] - cube.in_the_limit[f], 2);
        reflected += std::pow(cube.in_the_limit[f] - cube.exitance[f], 2);
    }
    sheet.add_field_error(cube.name, "error of face means", solution, std::sqrt(wrong / reflected));
}

}  // namespace

void answer_cubes(AnswerSheet& sheet) {
    const auto six = [](double a, double b, double c, double d, double e, double f) {
        return Six{a, b, c, d, e, f};
    };
    answer_six_patches(sheet, "six patches, 0.5", six(0, 0, 0, 0, 1, 0), Six::Constant(0.5));
    answer_six_patches(sheet, "six patches, mixed", six(0, 0, 0, 0, 0, 1),
                       six(0.6, 0.2, 0.7, 0.7, 0.3, 0.8));
    answer_six_patches(sheet, "six patches, 0.99", six(0, 0, 0, 0, 1, 0), Six::Constant(0.99));
    for (const LitCube& cube : {lit_floor(), ceiling_light()}) {
        for (const KnownWay& way : every_way()) answer_by_hand(sheet, cube, way);
        for (const double accuracy : {0.02, 0.005}) answer_to_accuracy(sheet, cube, accuracy);
    }
}

}  // namespace patchlight::server
