#include "solver/accuracy/energy.h"
#include "solver/accuracy/error_measure.h"
#include "solver/accuracy/next_aim.h"
#include "solver/accuracy/sensor_light.h"
#include "solver/display/vertex_radiosity.h"
#include "solver/prepare_transport.h"
#include "solver/solve_stage.h"
#include "solver/transport/patch_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace patchlight {

namespace {

constexpr double coarser = 2.0;  // times the target, in rounds that tell what the last ones need
constexpr double settled = 0.5;  // of the target: changes that need no further round
constexpr double one_round = 0.015;     // targets from here on need no rounds before
constexpr double still_settling = 0.7;  // of the error before: rounds still bring it down
constexpr double direct_noise = 0.25;   // of the target, that samples of lamps leave
constexpr double for_tolerance = 0.4;   // of the target, that the coarse solution may leave
constexpr int most_contradictions = 1;  // of particles, that rounds are to mend
constexpr int most_rounds = 12;
constexpr int rounds_between = 2;  // that cost little, where what rays read is wrong
/// Of a time limit: what is left when gathering ends is for check points, particles, and the rest.
constexpr double for_searching = 0.4, for_gathering = 0.85, for_checking = 0.91,
                 for_particles = 0.96, for_sensors = 0.98;
constexpr double shows_to_come = 5.0;  // times as long as showing the field takes
/// Of the target: light that comes between one plane and another tilted against it is (1 - cosine)
/// / 2 of what is alike all round.
constexpr double tilt_of_target = 0.5;
constexpr int fewest_rays = 96, most_rays = 1 << 15;  // multiples of 32

class AccuracySolve {
  public:
    AccuracySolve(const SolveStage& stage, const MeshLines& lines)
        : stage_(stage),
          solution_(stage.solution),
          target_(*stage.solution.settings.accuracy),
          light_(stage.scene, solution_.mesh, stage.rays, lines, seed(0x76657274),
                 {[this] { return go_on(); }, [&stage] { return search_on(stage); }}),
          next_aim_(target_) {
        is_made_ = true;
    }

    void run();

  private:
    static bool search_on(const SolveStage& stage) {
        return stage.watch.step({Stage::form_factors}, for_searching) == StopReason::tolerance;
    }
    std::uint64_t seed(std::uint64_t stream) const { return mix(solution_.settings.seed, stream); }
    bool go_on() {
        if (is_made_) stage_.watch.reserve(shows_to_come * light_.seconds_to_show(), for_gathering);
        if (stopped_ == StopReason::tolerance)
            stopped_ = stage_.watch.step({Stage::display}, for_gathering);
        return stopped_ == StopReason::tolerance;
    }
    /// After the limit of gathering there is a little time for a coarse solution that is shown.
    StopReason observe(int iteration, double residual) {
        const Progress progress{Stage::solve, 0.0, iteration, residual};
        if (stopped_ == StopReason::time_limit) return stage_.watch.step(progress, for_checking);
        if (stopped_ == StopReason::tolerance)
            stopped_ = stage_.watch.step(progress, for_gathering);
        return stopped_;
    }
    CoarseTransport::Observe observer() {
        return [this](int iteration, double residual) { return observe(iteration, residual); };
    }
    bool carries_on_clusters() const { return solution_.settings.method == Method::hierarchical; }
    /// Of the coarse solution: what was set, but no more than leaves the target within reach.
    double tolerance() const {
        return std::min(*solution_.settings.tolerance, for_tolerance * target_);
    }
    bool prepare();
    bool gather(double coarseness);
    ErrorMeasure error_measure() const {
        return {stage_.scene,      solution_.mesh, light_, prepared_.backs,
                prepared_.escaped, stage_.rays,    target_};
    }
    void measure();
    void check_from_lamps();
    void aim_closer();
    bool is_settling();
    bool settle();
    void refine(bool gathered);
    void account();
    void finish();
    void light_sensors();

    const SolveStage& stage_;
    Solution& solution_;
    double target_;
    StopReason stopped_ = StopReason::tolerance;
    bool is_made_ = false;  // the light, which asks for time while it is
    GatheredLight light_;
    PreparedTransport prepared_;
    GatherAim aim_;
    NextAim next_aim_;
    double last_correction_ = std::numeric_limits<double>::infinity();
    std::optional<MeasuredRound> measured_;
};

/// False if the work was stopped.
bool AccuracySolve::prepare() {
    prepared_ = prepare_transport(stage_, solution_.settings.seed, [this] { return go_on(); });
    if (!prepared_.transport) return false;
    solution_.form_factors.open = std::ranges::max(prepared_.escaped) > 0.0;
    solution_.seconds.form_factors = stage_.watch.lap();
    return true;
}

bool AccuracySolve::gather(double coarseness) {
    if (light_.shown() && !go_on()) return false;
    GatherAim aim = aim_;
    aim.direct *= coarseness;
    aim.indirect *= coarseness;
    if (coarseness > 1.0)
        aim.rays = light_.noise().rays_for(coarseness * light_.noise().absolute(aim_.rays),
                                           fewest_rays, aim_.rays);
    aim.direct_anew = aim.direct_anew && coarseness == 1.0;
    return light_.gather(aim, tolerance(), observer());
}

void AccuracySolve::measure() {
    const bool is_hurried = stopped_ != StopReason::tolerance;
    measured_ = error_measure().at(aim_, seed(0x636865636b), is_hurried, [&] {
        return is_hurried ? stage_.watch.seconds_left(for_checking) > 0.0 : go_on();
    });
    if (measured_->error.met()) check_from_lamps();
    solution_.error = measured_->error;
}

void AccuracySolve::check_from_lamps() {
    const double seconds = stopped_ == StopReason::tolerance
                               ? std::numeric_limits<double>::infinity()
                               : stage_.watch.seconds_left(for_particles);
    error_measure().check_from_lamps(aim_, seed(0x6c616d70), seconds, *measured_);
    solution_.error = measured_->error;
}

void AccuracySolve::aim_closer() {
    const DisplayPass& pass = light_.pass();
    const double over_norm = passed_on / light_.norm();
    const RoundErrors errors{over_norm * measured_->checks.direct.at_most(1.0),
                             over_norm * measured_->checks.indirect.at_most(1.0),
                             over_norm * pass.indirect_noise(),
                             over_norm * pass.indirect().expected_miss(),
                             over_norm * pass.direct_noise(),
                             over_norm * pass.direct().expected_miss(),
                             light_.correction(),
                             light_.read_coarsely(),
                             light_.has_gaps() && aim_.effort.by_apertures,
                             measured_->amplified(),
                             carries_on_clusters()};
    light_.look_closer(measured_->checks.missed);
    const auto rays_for = [&, &noise = light_.noise()](double less) {
        return noise.rays_for(less * noise.absolute(aim_.rays), fewest_rays, most_rays);
    };
    if (!next_aim_.after(errors, rays_for, aim_)) return;
    const bool is_cheaper = !carries_on_clusters() || !light_.pass().is_coarsest();
    for (int round = 0; is_cheaper && round < rounds_between && gather(coarser);) ++round;
}

/// Whether what rays read still changes, so that one more round alone brings the error down.
bool AccuracySolve::is_settling() {
    const double before = std::exchange(last_correction_, light_.correction());
    return last_correction_ > settled * target_ && last_correction_ < still_settling * before;
}

/// Rounds until they change little. False if the work was stopped.
bool AccuracySolve::settle() {
    for (int round = 0; round < most_rounds; ++round) {
        if (!gather(1.0)) return false;
        if (!is_settling()) break;
    }
    return true;
}

/// Rounds, until what is measured is within the target.
void AccuracySolve::refine(bool gathered) {
    int contradicted = 0;
    for (int round = 0; gathered && round < most_rounds; ++round) {
        measure();
        if (solution_.error.met()) {
            solution_.status = Status::converged;
            break;
        }
        if (measured_->error.transport && ++contradicted > most_contradictions) break;
        aim_closer();
        gathered = gather(1.0);
    }
}

void AccuracySolve::run() {
    solution_.error.target = target_;
    solution_.status = Status::limit;
    if (carries_on_clusters()) light_.share_rays(1.0 - tilt_of_target * target_);
    const double first_target = target_ < one_round ? coarser * target_ : target_;
    aim_ = first_aim(target_, first_target, fewest_rays);
    if (prepare() && light_.start(*prepared_.transport, prepared_.backs,
                                  energy_aim_for(target_, solution_.form_factors.open,
                                                 std::ranges::max(prepared_.backs) > 0.0),
                                  aim_.effort, direct_noise * target_, tolerance(), observer())) {
        aim_.rays = light_.noise().rays_for(
            first_noise(first_target) * std::sqrt(2.0) * light_.norm(), fewest_rays, most_rays);
        solution_.seconds.solve = stage_.watch.lap();
        if (light_.reflects())
            refine(first_target > target_ ? settle() : gather(1.0));
        else if (gather(1.0))  // nothing is sent back, so nothing can be wrong
            solution_.status = Status::converged;
    }
    if (stopped_ != StopReason::cancelled && light_.shown() && light_.reflects()) {
        if (!measured_) measure();
        if (!measured_->error.transport) check_from_lamps();
    }
    if (stopped_ == StopReason::cancelled) solution_.status = Status::cancelled;
    finish();
}

/// Each is gathered as finely as the target asks; without anything that reflects they are all the
/// target refers to.
void AccuracySolve::light_sensors() {
    if (stage_.scene.sensors.empty() || !light_.field()) return;
    const SensorEffort effort =
        sensor_effort(aim_, light_.rays_taken(aim_), stage_.scene.sensors.size(), seed(0x73656e73));
    solution_.sensors =
        light_at_sensors(stage_.scene, stage_.rays, light_.pass().points().gather(),
                         *light_.field(), effort, [&](double fraction) {
                             return stage_.watch.step({Stage::display, fraction}, for_sensors) ==
                                    StopReason::tolerance;
                         });
    if (light_.reflects()) return;
    double most = 0.0, worst = 0.0;
    for (const SensorReport& sensor : solution_.sensors)
        most = std::max(most, luminance(sensor.irradiance)), worst = std::max(worst, sensor.error);
    if (!(most > 0.0)) return;
    solution_.error.estimate = worst / most;
    if (!solution_.error.met() && solution_.status == Status::converged)
        solution_.status = Status::limit;
}

/// Where the light went, of fields that are filled in.
void AccuracySolve::account() {
    solution_.radiosity = exitances(stage_.scene, solution_.mesh);
    for (PatchIndex i = 0; i < solution_.mesh.size(); ++i)
        solution_.radiosity[i] += light_.coarse()->reflectance()[i] * solution_.irradiance[i];
    solution_.energy = measure_energy(stage_.scene, solution_.mesh, prepared_.backs,
                                      prepared_.escaped, solution_.radiosity, solution_.irradiance);
}

void AccuracySolve::finish() {
    light_sensors();
    if (const CoarseSolution* coarse = light_.coarse(); coarse && !coarse->reflected().empty()) {
        solution_.error.algebraic_bound = coarse->transported().algebraic_bound;
        solution_.convergence = coarse->transported().convergence;
        solution_.within_tolerance = coarse->transported().stopped_by == StopReason::tolerance;
        if (light_.shown()) {
            solution_.irradiance = light_.irradiance();
        } else {  // the work ended before a round of gathering did
            for (PatchIndex i = 0; i < solution_.mesh.size(); ++i)
                solution_.irradiance[i] = light_.direct_means()[i] + coarse->irradiance()[i];
        }
        account();
        if (light_.shown()) solution_.energy = light_.energy();
    }
    solution_.display = light_.shown()
                            ? light_.shown()->display
                            : make_display(stage_.scene, solution_.mesh, solution_.radiosity,
                                           std::vector<double>(solution_.mesh.size(), 0.0));
    solution_.seconds.display = stage_.watch.lap();
}

}  // namespace

void solve_to_accuracy(const SolveStage& stage, const MeshLines& lines) {
    AccuracySolve(stage, lines).run();
}

}  // namespace patchlight
