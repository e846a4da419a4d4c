#include "solver/accuracy/next_aim.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patchlight {

namespace {

constexpr double planned = 0.8;      // of the target: all causes together, measured
constexpr double joinable = 0.25;    // of the target: a change that rays need not read
constexpr double unexplained = 2.0;  // times noise and bends: what rays read is wrong
constexpr double improving = 0.7;    // of the error before: rounds alone bring it down
constexpr int most_first = 512;      // samples of each lamp

}  // namespace

double NextAim::tighten(const RoundErrors& errors, GatherAim& aim) {
    const double whole = planned * target_;
    const auto beside = [&](double other) {
        return std::sqrt(whole * whole - std::min(other * other, 0.5 * whole * whole));
    };
    const auto closer = [](double missed, double allowed) {
        return std::clamp(0.8 * allowed / missed, 0.3, 0.8);
    };
    const double for_direct = beside(errors.indirect), for_indirect = beside(errors.direct);
    if (errors.direct > for_direct || errors.direct > errors.indirect) {
        aim.direct *= closer(errors.direct, for_direct);
        aim.effort.first = std::min(2 * aim.effort.first, most_first);
    }
    if (errors.indirect <= for_indirect && errors.indirect < errors.direct) {
        aim.gathered = GatherAim::Indirect::kept;
        return 1.0;
    }
    const bool explained = errors.indirect < unexplained * std::hypot(errors.noise, errors.bent);
    const bool may_join = explained && errors.correction < joinable * target_ &&
                          aim.gathered != GatherAim::Indirect::joined;
    aim.gathered = may_join ? GatherAim::Indirect::joined : GatherAim::Indirect::anew;
    const double before = std::exchange(last_indirect_, errors.indirect);
    is_settling_ = !explained && errors.indirect < improving * before;
    if (is_settling_) return 1.0;
    const double scale = closer(errors.indirect, for_indirect);
    if (errors.noise > 0.5 * errors.indirect) return scale;
    aim.indirect *= scale;
    return std::sqrt(scale);  // noise may be more than halves tell
}

}  // namespace patchlight
