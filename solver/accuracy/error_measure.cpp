#include "solver/accuracy/error_measure.h"

#include "solver/accuracy/carried_residual.h"
#include "solver/accuracy/energy.h"
#include "solver/rays/low_discrepancy.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr double left_by_correction = 0.3;  // of the correction's size, that is still wrong
constexpr double uncorrected = 2.0;         // times a change that could not be sent on
constexpr double doubtful = 1.4;            // times what was measured: few points count for much
constexpr double promising = 0.9;           // of the target: worth more points
constexpr int most_checks = 8, most_in_a_hurry = 32;
constexpr int fewest_in_a_hurry = 128;  // check points at a time
/// Of the target, that a check point's rays may leave: it evens out over hundreds of them.
constexpr double noise_of_checks = 0.25;
constexpr int fewest_rays_of_checks = 64;
constexpr double rays_at_a_time = 4e6;
constexpr double share_of_rays = 0.06;  // of those gathered with, particles may take
constexpr std::size_t vertices_per_check = 8;
constexpr double propagation_tolerance = 0.01;  // of what a residual comes to

/// Shifts what is missing on patches, in proportion to the light there is, so that it sums to what
/// the energy says is missing, as far as that is the surer number of the two.
void heed_energy(const EnergyReport& energy, const std::vector<Rgb>& weight, const Rgb& variance,
                 std::vector<Rgb>& missing) {
    Rgb sum = Rgb::Zero(), whole = Rgb::Zero();
    for (std::size_t i = 0; i < missing.size(); ++i) {
        sum += missing[i];
        whole += weight[i];
    }
    const Rgb noise = (energy.standard_error * energy.emitted).square();
    const Rgb share =
        (energy.missing() - sum) * variance / (variance + noise).max(1e-300) / whole.max(1e-300);
    for (std::size_t i = 0; i < missing.size(); ++i) missing[i] += share * weight[i];
}

/// Into parts of a fraction of a second each, between which the clock is asked; how many.
int divide(CheckEffort& effort) {
    const double rays = 2.0 * effort.indirect_points * effort.rays;
    const int parts = static_cast<int>(std::ceil(rays / rays_at_a_time));
    effort.indirect_points = (effort.indirect_points + parts - 1) / parts;
    effort.direct_points = (effort.direct_points + parts - 1) / parts;
    return parts;
}

}  // namespace

/// The residual's part that is alike over patches, sent round with the coarse transport. Two
/// estimates of it: their product has no share of their noise, half their difference is it.
std::optional<double> ErrorMeasure::propagated(const CheckReport& checks, double norm) const {
    if (!light.coarse()->goes_round()) return std::nullopt;
    std::vector<Rgb> weight(mesh.size());
    Rgb difference = Rgb::Zero();
    for (std::size_t i = 0; i < weight.size(); ++i) {
        weight[i] = mesh.patches[i].area * light.irradiance()[i];
        difference += checks.missing[0][i] - checks.missing[1][i];
    }
    std::array<std::vector<Rgb>, 2> error;
    for (std::size_t half = 0; half < 2; ++half) {
        std::vector<Rgb> missing = checks.missing[half];
        heed_energy(light.energy(), weight, 0.5 * difference.square(), missing);
        const std::vector<Rgb> once = missing;
        error[half] = *light.coarse()->gone_round(missing, propagation_tolerance);
        for (std::size_t i = 0; i < once.size(); ++i)  // what is missing itself is the residual
            if (mesh.patches[i].area > 0.0)
                error[half][i] -= light.coarse()->reflectance()[i] * once[i] / mesh.patches[i].area;
    }
    double product = 0.0, noise = 0.0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        const double a = luminance(error[0][i]), b = luminance(error[1][i]);
        product += mesh.patches[i].area * a * b;
        noise += mesh.patches[i].area * 0.25 * (a - b) * (a - b);
    }
    return std::sqrt(std::max(0.0, product) + noise) / norm;
}

void ErrorMeasure::judge_round(const ReflectedLight& reflected, MeasuredRound& round) const {
    Evidence& evidence = round.evidence;
    evidence.target = target;
    evidence.checks = &round.checks;
    evidence.algebraic_bound = light.coarse()->transported().algebraic_bound;
    evidence.light = reflected;
    evidence.coarse =
        (light.coarse()->goes_round() ? left_by_correction : uncorrected) * light.correction();
    evidence.propagated = propagated(round.checks, reflected.norm);
    evidence.carried.reset();
    evidence.energy = light.energy();
    evidence.proven_by_energy =
        error_proven_by_energy(scene, mesh, light.energy(), light.irradiance(), backs, escaped);
    round.error = judge(evidence);
}

void ErrorMeasure::carry_residual(std::uint64_t seed, MeasuredRound& round) const {
    if (round.evidence.carried || !round.error.estimate) return;
    round.evidence.carried =
        carried_residual(scene, rays, round.checks, round.evidence.energy, mix(seed, 0x63617272));
    round.error = judge(round.evidence);
    round.beyond_residual = beyond_residual(round.evidence, 1.0);
}

MeasuredRound ErrorMeasure::at(const GatherAim& aim, std::uint64_t seed, bool is_hurried,
                               const std::function<bool()>& go_on) const {
    CheckEffort effort;
    effort.direct = aim.effort;
    effort.direct.first = std::max(64, 2 * aim.effort.first);
    effort.direct.most = 2 * aim.effort.most;
    effort.direct.enough = 0.5 * aim.effort.enough;
    effort.direct.alike = 0.5 * aim.effort.alike;
    effort.rays = std::clamp(aim.rays / 64 * 32, 256, 4096);
    if (light.known_noise())
        effort.rays = light.known_noise()->rays_for(noise_of_checks * target * light.norm(),
                                                    fewest_rays_of_checks, effort.rays);
    effort.indirect_points = static_cast<int>(std::clamp<std::size_t>(
        light.pass().indirect().gathered() / vertices_per_check, 384, 4096));
    if (is_hurried) {
        effort.direct_points = fewest_in_a_hurry;
        effort.indirect_points = fewest_in_a_hurry;
    }
    const int parts = divide(effort);
    const ReflectedLight reflected = light.reflected();
    MeasuredRound round;
    int done = 0;
    for (int times = 1; times <= (is_hurried ? most_in_a_hurry : most_checks); times *= 2) {
        for (; done < times * parts && (done < 1 || go_on()); ++done) {
            CheckReport more = light.check(effort, mix(seed, static_cast<std::uint64_t>(done)));
            round.checks = done > 0 ? joined(round.checks, more) : std::move(more);
        }
        judge_round(reflected, round);
        if (round.error.met()) carry_residual(seed, round);
        if (!round.error.estimate) break;
        const double without_doubt = *judge(round.evidence, 0.0).estimate;
        const bool worth_it = is_hurried || without_doubt < promising * target ||
                              (times == 1 && *round.error.estimate > doubtful * without_doubt);
        if (round.error.met() || !worth_it || !go_on()) break;
    }
    carry_residual(seed, round);
    return round;
}

void ErrorMeasure::check_from_lamps(const GatherAim& aim, std::uint64_t seed, double seconds,
                                    MeasuredRound& round) const {
    if (!round.error.estimate) return;
    const ReflectedLight& reflected = round.evidence.light;
    ParticleEffort effort;
    effort.target = target;
    effort.rays = static_cast<std::uint64_t>(share_of_rays * light.rays_taken(aim));
    effort.seconds = seconds;
    effort.norm = reflected.norm;
    effort.area = reflected.area;
    ParticleEvidence found =
        check_transport(scene, mesh, rays, light.pass().points().gather().gaps(), *light.shown(),
                        light.places(), effort, seed);
    round.evidence.checks = &round.checks;
    round.evidence.transport = found.check;
    round.error = judge(round.evidence);
    round.regions = std::move(found.regions);
}

}  // namespace patchlight
