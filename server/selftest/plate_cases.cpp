#include "server/selftest/exact_factors.h"
#include "server/selftest/face_means.h"
#include "server/selftest/known_families.h"
#include "server/selftest/known_way.h"
#include "server/selftest/worst_of.h"

#include <array>
#include <cmath>

namespace patchlight::server {
namespace {

constexpr std::array<double, 2> exitances{1.0, 0.0}, reflectances{0.5, 0.8};
constexpr std::array<std::size_t, 2> faces{4, 5};  // z0 and z1 of the unit cube

/// Two facing unit squares at distance 1, open all round.
Scene two_plates() {
    KnownScene built;
    for (std::size_t k = 0; k < 2; ++k)
        built.polygon(cube_face_names[faces[k]], built.material(reflectances[k], exitances[k]),
                      cube_face(faces[k], 0, 1, 0, 1));
    return built.scene;
}

double factor() { return parallel_rectangles({0, 1}, {0, 1}, {0, 1}, {0, 1}, 1.0); }

/// Light that goes there and back again and again: B0 = (E0 + ρ0 F E1) / (1 − ρ0 ρ1 F²).
std::array<double, 2> on_one_patch_each() {
    const double returned = 1.0 - reflectances[0] * reflectances[1] * factor() * factor();
    return {(exitances[0] + reflectances[0] * factor() * exitances[1]) / returned,
            (exitances[1] + reflectances[1] * factor() * exitances[0]) / returned};
}

/// On 16 × 16 patches each, with factors of closed form, and in the limit of many, good to 1e-9.
constexpr std::array<double, 2> on_256_patches_each{1.0164472497, 0.1625241436};
constexpr std::array<double, 2> in_the_limit{1.01645116, 0.162525426};

void answer_plates_by_hand(AnswerSheet& sheet, const std::string& name, const KnownWay& way,
                           double patch_size, const std::array<double, 2>& exact) {
    const Scene scene = two_plates();
    const Solution solution = sheet.solve(
        scene, settings_of(way, patch_size, way.engine == Engine::hemicube ? 48 * 48 : 4096));
    const SixMeans found = patch_means(scene, solution);
    // A factor that is off by δ brings a plate ρ δ B of light too much, and that goes to and fro.
    const double passed_on = reflectances[1] / (1.0 - reflectances[1] * factor());
    const double bound = passed_on * std::hypot(exact[0], exact[1]) *
                         factor_bound(solution, factor(), 1.0 / (patch_size * patch_size));
    std::vector<KnownAnswer> answers;
    for (std::size_t k = 0; k < 2; ++k)
        answers.push_back({name, std::string("mean B of ") + cube_face_names[faces[k]],
                           method_text(solution.settings), found[faces[k]], exact[k], bound});
    sheet.add(worst_of(answers));
}

}  // namespace

void answer_plates(AnswerSheet& sheet) {
    answer_plates_by_hand(sheet, "plates, one patch each", {}, 1.0, on_one_patch_each());
    for (const KnownWay& way : every_way())
        answer_plates_by_hand(sheet, "plates, 256 patches each", way, 1.0 / 16,
                              on_256_patches_each);
    const Scene scene = two_plates();
    const Solution solution = sheet.solve(scene, to_accuracy(0.01));
    const SixMeans found = display_means(scene, solution);
    double wrong = 0.0, reflected = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
        wrong += std::pow(found[faces[k]] - in_the_limit[k], 2);
        reflected += std::pow(in_the_limit[k] - exitances[k], 2);
    }
    sheet.add_field_error("plates", "error of means", solution, std::sqrt(wrong / reflected));
}

}  // namespace patchlight::server
