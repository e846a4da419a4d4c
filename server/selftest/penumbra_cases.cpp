#include "server/selftest/exact_factors.h"
#include "server/selftest/known_families.h"
#include "server/selftest/known_scene.h"
#include "server/selftest/known_way.h"
#include "server/solve_json.h"
#include "server/wording.h"

#include <algorithm>
#include <iterator>

namespace patchlight::server {
namespace {

// A lamp of 1 m × 1 m at height 2 above a floor, half way an opaque square of 0.5 m × 0.5 m.

std::vector<Vec3> facing_down(Interval x, Interval y, double z) {
    return {{x[0], y[0], z}, {x[0], y[1], z}, {x[1], y[1], z}, {x[1], y[0], z}};
}

/// Seen from (x, 0, 0), 0 <= x <= 1, the square hides all of the lamp up to 0.5 − x along x, and
/// its whole width; the rest is a rectangle.
double visible_factor(double x) {
    return element_to_polygon({x, 0, 0}, Vec3::UnitZ(),
                              facing_down({0.5 - x, 0.5}, {-0.5, 0.5}, 2.0));
}

/// Means over squares of 0.125 m along the x axis from 0: Gauss quadrature of the clipped lamp, to
/// about 1e-7.
constexpr double square_means[] = {0.006499241780103312, 0.015716624419469177, 0.025122508239124142,
                                   0.033755522219370206, 0.040804269535599555, 0.04580007172010561,
                                   0.04865753769341939,  0.04958718546742839};
constexpr double square_edge = 0.125;

std::vector<Vec3> lamp() { return facing_down({-0.5, 0.5}, {-0.5, 0.5}, 2.0); }
std::vector<Vec3> square() { return facing_down({-0.25, 0.25}, {-0.25, 0.25}, 1.0); }

/// A sensor of a solve by hand states what its rays may err. To an accuracy, it states the
/// difference of two gatherings, which is small by chance now and then: all are held to the
/// largest.
void answer_penumbra(AnswerSheet& sheet, const SolveSettings& settings) {
    KnownScene built;
    built.polygon("lamp", built.material(0.0, 1.0), lamp());
    built.polygon("square", built.material(0.0, 0.0), square());
    constexpr int points = 11;
    for (int k = 0; k < points; ++k) built.sensor("x", {0.1 * k, 0, 0}, Vec3::UnitZ());
    const Solution solution = sheet.solve(built.scene, settings);
    double most = 0.0;
    for (const SensorReport& sensor : solution.sensors) most = std::max(most, sensor.error);
    for (std::size_t s = 0; s < points; ++s) {
        const double exact = visible_factor(0.1 * static_cast<double>(s));
        sheet.add({"penumbra", "E at x = " + number_text(static_cast<double>(s) / 10.0),
                   method_text(solution.settings), solution.sensors.at(s).irradiance[0], exact,
                   deviations * (settings.accuracy ? most : solution.sensors.at(s).error) +
                       quadrature * exact});
    }
}

void answer_squares(AnswerSheet& sheet) {
    KnownScene built;
    const MaterialIndex black = built.material(0.0, 0.0);
    constexpr std::uint32_t squares = std::size(square_means);
    for (std::uint32_t k = 0; k < squares; ++k) {
        const double x = square_edge * k, half = 0.5 * square_edge;
        built.polygon(
            "floor", black,
            {{x, -half, 0}, {x + square_edge, -half, 0}, {x + square_edge, half, 0}, {x, half, 0}});
    }
    built.polygon("lamp", black, lamp());
    built.polygon("square", black, square());
    SolveSettings settings;
    settings.engine = Engine::analytic;
    settings.patch_size = square_edge / 2;
    const AnswerSheet::Factors found = sheet.view_factors(built.scene, settings);
    for (std::uint32_t from = 0; from < squares; ++from) {
        const GroupFactors& row = found.rows.at(from);
        KnownAnswer answer{"penumbra", "F, square " + std::to_string(from + 1) + " to lamp",
                           name_of(Engine::analytic), 0.0, square_means[from]};
        for (std::size_t k = 0; k < row.to.size(); ++k)
            if (row.to[k] == squares) {
                answer.result = row.factors[k];
                answer.bound = deviations * row.errors[k];
            }
        sheet.add(answer);
    }
}

}  // namespace

void answer_penumbrae(AnswerSheet& sheet) {
    answer_penumbra(sheet, to_accuracy(0.01));
    answer_penumbra(sheet, settings_of({}, 0.5, 1024));
    answer_squares(sheet);
}

}  // namespace patchlight::server
