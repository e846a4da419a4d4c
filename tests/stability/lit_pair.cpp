#include "tests/stability/lit_pair.h"

#include <cmath>

namespace patchlight::stability {

Corners parallelogram(const Vec3& origin, const Vec3& u, const Vec3& v) {
    return {origin, origin + u, origin + u + v, origin + v};
}

LitPair facing_squares(double low, double high, double distance) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
    return {parallelogram(-0.5 * low * (x + y), low * x, low * y),
            parallelogram(-0.5 * high * (x + y) + distance * Vec3::UnitZ(), high * y, high * x)};
}

Scene scene_of(const LitPair& pair, double reflectance) {
    SceneBuilder builder;
    const MaterialIndex black = builder.material(0.0, 0.0);
    builder.polygon("receiver", builder.material(reflectance, 0.0), pair.receiver);
    builder.polygon("lamp", builder.material(0.0, 1.0), pair.lamp);
    for (const Corners& blocker : pair.blockers) builder.polygon("blocker", black, blocker);
    return builder.scene;
}

double factor(const LitPair& pair, const Column& column, const HandSet& by_hand,
              std::uint64_t seed) {
    const double reflectance = column.to_accuracy ? 0.5 : 0.0;
    const ObjectReport receiver =
        solve(scene_of(pair, reflectance), column, by_hand, seed).objects[0];
    return column.to_accuracy ? receiver.radiosity[0] / reflectance : receiver.irradiance[0];
}

double relative_error(const LitPair& pair, double exact, const Column& column,
                      const HandSet& by_hand, int seeds) {
    if (!column.counts() && pair.blockers.empty()) seeds = 1;
    double squared = 0.0;
    for (int seed = 1; seed <= seeds; ++seed)
        squared += std::pow(
            factor(pair, column, by_hand, static_cast<std::uint64_t>(seed)) / exact - 1.0, 2);
    return std::sqrt(squared / seeds);
}

double binomial(double factor, int n) { return std::sqrt((1.0 - factor) / (factor * n)); }

}  // namespace patchlight::stability
