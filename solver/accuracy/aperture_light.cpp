#include "solver/accuracy/aperture_light.h"

#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

constexpr std::size_t sampled_points = 16'384;
constexpr double standard_errors = 2.0;

double open_area(const PatchMesh& mesh) {
    double area = 0.0;
    for (const Patch& patch : mesh.patches) area += patch.covered ? 0.0 : patch.area;
    return area;
}

/// Centres of patches, as many of each as its area takes steps.
std::vector<PatchIndex> by_area(const PatchMesh& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<PatchIndex> picked;
    const double step = open_area(mesh) / static_cast<double>(count);
    double goal = unit(seed) * step, passed = 0.0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        if (mesh.patches[i].covered) continue;
        passed += mesh.patches[i].area;
        for (; goal < passed; goal += step) picked.push_back(i);
    }
    return picked;
}

/// Of what comes through apertures, a share p of `whole`: the first samples all miss it with a
/// chance of (1 - p)^n, and where they do not there are more, half as noisy as by chance.
double missed_square(double through, double whole, const DirectEffort& effort) {
    if (!(whole > 0.0)) return 0.0;
    const double share = std::min(1.0, through / whole);
    return through * through * std::pow(1.0 - share, effort.first) +
           0.5 * whole * whole * share * (1.0 - share) / effort.most;
}

}  // namespace

bool apertures_matter(const Scene& scene, const PatchMesh& mesh, const VertexGather& points,
                      const DirectEffort& effort, double noise, std::uint64_t seed) {
    if (mesh.size() <= sampled_points) return true;  // they cost less than to find out
    const std::vector<PatchIndex> at = by_area(mesh, sampled_points, seed);
    std::vector<std::array<double, 2>> squares(at.size());  // that would be missed, and of all
    tbb::parallel_for(std::size_t{0}, at.size(), [&](std::size_t k) {
        const Patch& patch = mesh.patches[at[k]];
        const GatherPoint point = points.point(at[k], patch.centre);
        const std::uint64_t key = mix(seed, k);
        const double y =
            luminance(scene.materials[scene.surfaces[patch.surface].material].reflectance);
        const auto [through, whole] = points.gather().through_apertures(point, effort, key);
        const Rgb all = points.gather().direct(point, effort, key).irradiance;
        squares[k] = {y * y * missed_square(luminance(through), whole, effort),
                      std::pow(y * luminance(all), 2)};
    });
    double missed = 0.0, spread = 0.0, all = 0.0;
    for (const auto& [a, b] : squares) missed += a, spread += a * a, all += b;
    return missed + standard_errors * std::sqrt(spread) > noise * noise * all;
}

double lit_by_apertures(const PatchMesh& mesh, const VertexGather& points, double enough) {
    const ApertureSet& apertures = points.gather().apertures();
    if (apertures.empty() || !(enough > 0.0)) return 1.0;
    constexpr double least_share = 1.0 / 64.0;
    std::vector<double> lit(mesh.size(), 0.0);
    tbb::parallel_for(PatchIndex{0}, static_cast<PatchIndex>(mesh.size()), [&](PatchIndex i) {
        if (mesh.patches[i].covered) return;
        std::vector<float> most(apertures.size());
        const GatherPoint at = points.point(i, mesh.patches[i].centre);
        apertures.most_through(at.origin, at.normal.cast<float>(), most);
        const double sum = std::accumulate(most.begin(), most.end(), 0.0);
        lit[i] = mesh.patches[i].area * std::min(1.0, std::pow(sum / enough, 2));
    });
    return std::clamp(std::accumulate(lit.begin(), lit.end(), 0.0) / open_area(mesh), least_share,
                      1.0);
}

}  // namespace patchlight
