#include "tests/solver/form_factors/hemicube_pairs.h"

#include "solver/form_factors/point_factor.h"
#include "tests/solver/form_factors/polygons.h"

namespace patchlight {

namespace {

constexpr double whole = 9.0;  // patch size that cuts nothing

Scene pair_scene(const Polygon& target) {
    return scene_of({rectangle({-0.5, -0.5, 0}, Vec3::UnitX(), Vec3::UnitY()), target});
}

Polygon facing_down(double x, double y, double z, double edge) {
    return rectangle({x - edge / 2, y - edge / 2, z}, edge * Vec3::UnitY(), edge * Vec3::UnitX());
}

}  // namespace

HemicubePair::HemicubePair(std::string name, const Polygon& target)
    : name_(std::move(name)), target_(target), scene_(pair_scene(target), whole) {}

HemicubeEngine HemicubePair::engine(int resolution, int sub_samples, std::uint64_t seed,
                                    bool rotated) const {
    HemicubeSettings settings;
    settings.resolution = resolution;
    settings.sub_samples = sub_samples;
    settings.rotated = rotated;
    settings.seed = seed;
    return {scene_.cut.scene, scene_.cut.mesh, scene_.rays, settings};
}

HemicubePair::Entry HemicubePair::entry(const HemicubeEngine& engine) {
    const FactorRow row = row_of(engine, 0);
    return row.columns.empty() ? Entry{} : Entry{row.factors[0], row.variance[0]};
}

double HemicubePair::at_centres(int k) const {
    double sum = 0.0;
    for (int part = 0; part < k * k; ++part)
        sum += point_factor({(part % k + 0.5) / k - 0.5, (part / k + 0.5) / k - 0.5, 0.0},
                            Vec3::UnitZ(), convex(target_), normal_of(target_));
    return sum / (k * k);
}

HemicubePair parallel_pair(double distance) { return {"parallel", facing_down(0, 0, distance, 1)}; }

HemicubePair perpendicular_pair() {
    return {"perpendicular", rectangle({-0.5, -0.5, 0}, Vec3::UnitY(), Vec3::UnitZ())};
}

HemicubePair small_pair() { return {"small", facing_down(0.3, 0.0, 5.0, 0.1)}; }

}  // namespace patchlight
