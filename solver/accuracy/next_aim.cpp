#include "solver/accuracy/next_aim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace patchlight {

namespace {

constexpr double planned = 0.75;      // of the target: all causes together, measured
constexpr double a_little = 0.8;      // of what was missed, where it was within that
constexpr double joinable = 0.10;     // of the target: a change that rays need not read
constexpr double bearable = 0.75;     // the same, where gathering all anew costs most
constexpr double unexplained = 2.0;   // times noise and bends: what rays read is wrong
constexpr double improving = 0.7;     // of the error before: rounds alone bring it down
constexpr double smoothed = 0.85;     // of the noise, what smoothing leaves [1]
constexpr double most_sampled = 0.7;  // of what is planned, that vertices cannot bring down [1]
constexpr double at_once = 0.5;       // of a cause, what one round brings it down to at most
constexpr double in_vain = 0.25;      // the same, where the round before did not help
constexpr int most_first = 512, times_first = 4;  // samples of each lamp
constexpr int most_most = 8192, times_most = 4;   // of one seen in part
/// Samples of each lamp, times the target, and of one seen in part at a target: its noise falls
/// with the power 0.75 of their number. Measured on random rooms.
constexpr double first_for = 0.5, samples_at = 384.0, samples_for = 0.01, samples_power = 1.4;

/// The squares of direct light's errors, noise and bends that the least work leaves, of their sum:
/// in proportion to the share of the work times the power of the error it grows with, about 0.2 x
/// 1, 0.8 x 1.4 and 0.8 x 0.6.
constexpr std::array<double, 3> least_work{0.11, 0.62, 0.27};

enum Cause : std::size_t { direct_light, noise_of_rays, bends_between };

/// Of the target, what a cause is planned to miss. What is measured later counts `passed_on` times.
double share_of(Cause cause) { return planned * std::sqrt(least_work[cause]) / passed_on; }

/// What each may be, so that their squares sum to that of the whole: what is less than its share
/// stays, and leaves the rest to the others.
std::array<double, 3> shares_of(double whole, const std::array<double, 3>& missed) {
    std::array<double, 3> allowed = missed;
    std::array<bool, 3> stays{};
    for (std::size_t round = 0; round < 3; ++round) {
        double left = whole * whole, weights = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            if (stays[k])
                left -= missed[k] * missed[k];
            else
                weights += least_work[k];
        }
        for (std::size_t k = 0; k < 3; ++k)
            if (!stays[k]) allowed[k] = std::sqrt(std::max(0.0, left) * least_work[k] / weights);
        for (std::size_t k = 0; k < 3; ++k) stays[k] = stays[k] || missed[k] <= allowed[k];
    }
    for (std::size_t k = 0; k < 3; ++k) allowed[k] = std::min(allowed[k], missed[k]);
    return allowed;
}

}  // namespace

GatherAim first_aim(double target, double first_target, int rays) {
    GatherAim aim;
    aim.direct = share_of(direct_light) * first_target;
    aim.indirect = share_of(bends_between) * first_target;
    const double first = std::clamp(first_for / target / 16.0, 1.0, most_first / 16.0);
    const double most = samples_at * std::pow(samples_for / target, samples_power);
    aim.effort = {16 * static_cast<int>(first), static_cast<int>(std::clamp(most, 64.0, 8192.0))};
    aim.rays = rays;
    return aim;
}

double first_noise(double first_target) { return share_of(noise_of_rays) * first_target; }

double NextAim::tighten(const RoundErrors& errors, GatherAim& aim) {
    const double noise = std::min(smoothed * errors.noise, errors.indirect),
                 bends = std::sqrt(std::max(std::pow(errors.indirect, 2) - std::pow(noise, 2),
                                            std::pow(errors.bent, 2)));
    const double sampled = std::min(errors.direct_noise, most_sampled * planned * target_),
                 direct = std::sqrt(std::max(std::pow(errors.direct, 2) - sampled * sampled, 0.0));
    const std::array<double, 3> missed{direct, noise, bends};
    const double all = std::sqrt(direct * direct + noise * noise + bends * bends);
    // What goes to and fro is larger than what is missed at once: once rays read what is right.
    const bool explained =
        errors.amplified * errors.indirect < unexplained * std::hypot(errors.noise, errors.bent);
    const double beside = std::sqrt(std::pow(planned * target_, 2) - sampled * sampled) /
                          (explained ? errors.amplified : 1.0);
    const std::array<double, 3> allowed = shares_of(std::min(beside, a_little * all), missed);
    const auto scale = [&](std::size_t k) {
        return missed[k] > allowed[k] ? allowed[k] / missed[k] : 1.0;
    };
    const auto cut = [&](double& finer, std::size_t k) {
        const double before = std::exchange(missed_before_[k], missed[k]);
        finer *= std::max(missed[k] < improving * before ? at_once : in_vain, scale(k));
    };
    aim.direct_anew = false;
    if (errors.direct_noise > planned * target_ && aim.effort.most < most_most) {
        aim.effort.most = std::min(times_most * aim.effort.most, most_most);
        aim.direct_anew = true;
    } else if (scale(0) < 1.0) {
        // Samples may agree by chance where something small shades, and vertices do not find it.
        // Beside gaps every other time.
        const bool by_samples =
            errors.direct > target_ && errors.direct_noise > errors.direct_bent &&
            errors.direct > unexplained * std::hypot(errors.direct_noise, errors.direct_bent);
        const bool may_be = errors.has_gaps && std::exchange(direct_missed_, !direct_missed_);
        aim.direct_anew = (may_be || by_samples) && aim.effort.first < most_first;
        if (aim.direct_anew)
            aim.effort.first = std::min(times_first * aim.effort.first, most_first);
        else
            cut(aim.direct, direct_light);
    }
    if (scale(1) == 1.0 && scale(2) == 1.0) {
        aim.gathered = GatherAim::Indirect::kept;
        return 1.0;
    }
    const bool reads_right =
                   explained && !errors.read_coarse && errors.correction < joinable * target_,
               nearly_right = errors.coarse_is_fine && errors.correction < bearable * target_;
    const bool may_join =
        (reads_right || nearly_right) && aim.gathered != GatherAim::Indirect::joined;
    aim.gathered = may_join ? GatherAim::Indirect::joined : GatherAim::Indirect::anew;
    const double before = std::exchange(last_indirect_, errors.amplified * errors.indirect);
    is_settling_ = !explained && last_indirect_ < improving * before;
    if (is_settling_) return 1.0;
    if (scale(2) < 1.0) cut(aim.indirect, bends_between);
    return std::max(at_once, scale(1));
}

}  // namespace patchlight
