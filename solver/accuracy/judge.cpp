#include "solver/accuracy/judge.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace patchlight {

namespace {

constexpr int fewest_points = 12;  // on an object that is judged by itself

}  // namespace

ReflectedLight measure_reflected(const Scene& scene, const PatchMesh& mesh,
                                 const std::vector<Rgb>& reflected, const std::vector<Rgb>& once) {
    ReflectedLight light;
    light.norm_of_object.assign(scene.objects.size(), 0.0);
    double all = 0.0, at_once = 0.0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        const Surface& surface = scene.surfaces[patch.surface];
        const double y = luminance(reflected[i]);
        light.area += patch.area;
        light.norm_of_object[surface.object] += patch.area * y * y;
        all += patch.area * y;
        at_once += patch.area * luminance(scene.materials[surface.material].reflectance * once[i]);
    }
    for (double& norm : light.norm_of_object) {
        light.norm += norm;
        norm = std::sqrt(norm);
    }
    light.norm = std::sqrt(light.norm);
    if (at_once > 0.0) light.bounces = std::max(1.0, all / at_once);
    return light;
}

std::vector<double> displayed_norms(const Scene& scene, const PatchMesh& mesh,
                                    const TreeDisplay& shown) {
    std::vector<double> norms(scene.objects.size(), 0.0);
    const DisplayMesh& display = shown.display;
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const Surface& surface = scene.surfaces[mesh.patches[display.patch[t]].surface];
        const Rgb& reflectance = scene.materials[surface.material].reflectance;
        const auto& [a, b, c] = display.triangles[t];
        std::array<double, 3> y{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = display.triangles[t][k];
            Rgb arriving = shown.arriving.indirect[v];
            if (!shown.arriving.direct.empty()) arriving += shown.arriving.direct[v];
            y[k] = luminance(reflectance * arriving);
        }
        const auto& p = display.positions;
        const double area = 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm(), sum = y[0] + y[1] + y[2],
                     squares = y[0] * y[0] + y[1] * y[1] + y[2] * y[2];
        norms[surface.object] += area * (sum * sum + squares) / 12.0;  // of a linear function
    }
    for (double& norm : norms) norm = std::sqrt(norm);
    return norms;
}

namespace {

void judge_objects(const Evidence& evidence, ErrorReport& error) {
    const CheckReport& checks = *evidence.checks;
    error.of_object.resize(checks.of_object.size());
    for (ObjectIndex o = 0; o < checks.of_object.size(); ++o) {
        const auto& object = checks.of_object[o];
        const double norm = evidence.light.norm_of_object[o];
        if (object.points < fewest_points || !(norm > 0.0)) continue;
        const double estimate =
            passed_on * std::sqrt(std::max(0.0, object.square + std::sqrt(object.variance))) / norm;
        error.of_object[o] = estimate;
        if (!error.worst || estimate > error.worst->estimate) error.worst = {o, estimate};
    }
}

/// What particles say beyond what is expected: with doubt, where they contradict it.
double said_by_particles(const TransportCheck& check, double expected) {
    const double certain = std::max(0.0, check.difference - sure * check.standard_error);
    const double whole = certain > expected ? check.difference + check.standard_error : 0.0;
    return std::hypot(std::max(check.proven, whole), check.doubt);
}

}  // namespace

double beyond_residual(const Evidence& evidence, double standard_errors) {
    if (!evidence.carried) return 0.0;
    const CheckReport& checks = *evidence.checks;
    const double variance = checks.direct.variance + evidence.carried->variance,
                 square = flattened * flattened *
                          (checks.direct.square + evidence.carried->square +
                           standard_errors * std::sqrt(variance)),
                 counted = std::pow(passed_on * checks.at_most(standard_errors), 2);
    return std::sqrt(std::max(0.0, square - counted)) / evidence.light.norm;
}

ErrorReport judge(const Evidence& evidence, double standard_errors) {
    ErrorReport error;
    error.target = evidence.target;
    error.algebraic_bound = evidence.algebraic_bound;
    error.transport = evidence.transport;
    error.unbalanced =
        std::max(0.0, evidence.energy.defect - sure * evidence.energy.standard_error);
    const ReflectedLight& light = evidence.light;
    if (!evidence.checks || !(light.norm > 0.0)) return error;
    const CheckReport& checks = *evidence.checks;
    const double alike = std::abs(checks.mean()) / std::sqrt(light.area) / light.norm;
    const double round_and_round = evidence.propagated.value_or((light.bounces - 1.0) * alike);
    error.mesh = passed_on * checks.at_most(standard_errors) / light.norm;
    error.form_factors = std::max(std::hypot(evidence.coarse, round_and_round),
                                  beyond_residual(evidence, standard_errors));
    const double measured =
        evidence.algebraic_bound.value_or(0.0) + std::hypot(*error.form_factors, *error.mesh);
    error.estimate = std::max(measured, evidence.proven_by_energy);
    if (evidence.transport)
        error.estimate =
            std::max(*error.estimate, said_by_particles(*evidence.transport, measured));
    judge_objects(evidence, error);
    return error;
}

}  // namespace patchlight
