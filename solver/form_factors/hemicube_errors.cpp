#include "solver/form_factors/hemicube_errors.h"

#include "solver/form_factors/analytic_engine.h"
#include "solver/form_factors/point_factor.h"
#include "solver/mesh/make_patches.h"
#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t most_patches = 24;  // in the sample
constexpr int reference_rays = 4096;      // per patch

std::vector<double> dense(const FactorRow& row, std::size_t n) {
    std::vector<double> factors(n, 0.0);
    for (std::size_t k = 0; k < row.columns.size(); ++k) factors[row.columns[k]] = row.factors[k];
    return factors;
}

/// Sums over patches of what one row is off by, and why.
struct Parts {
    double aliasing = 0.0, proximity = 0.0, total = 0.0;
    void add(const Parts& other) {
        aliasing += other.aliasing;
        proximity += other.proximity;
        total += other.total;
    }
    double rest() const {
        return std::sqrt(
            std::max(0.0, total * total - aliasing * aliasing - proximity * proximity));
    }
};

struct Bench {  // what the sample is measured with
    const Scene& scene;
    const PatchMesh& mesh;
    const HemicubeEngine& engine;
    const HemicubeEngine& turned;
    const AnalyticEngine& analytic;

    /// Mean of the exact factors of the parts' centres, nothing between.
    std::vector<double> centre_factors(PatchIndex i) const {
        std::vector<double> factors(mesh.size(), 0.0);
        const std::vector<Vec3> centres = engine.part_centres(i, engine.sub_samples(i));
        const Vec3& normal = scene.surfaces[mesh.patches[i].surface].normal;
        for (PatchIndex j = 0; j < mesh.size(); ++j) {
            if (mesh.patches[j].surface == mesh.patches[i].surface || mesh.patches[j].covered)
                continue;
            ConvexPolygon polygon;
            for (const Vec3& p : patch_corners(mesh, j)) polygon.add(p);
            for (const Vec3& centre : centres)
                factors[j] += point_factor(centre, normal, polygon,
                                           scene.surfaces[mesh.patches[j].surface].normal) /
                              static_cast<double>(centres.size());
        }
        return factors;
    }

    HemicubeErrors at(PatchIndex i) const {
        FactorRow seen, otherwise, reference;
        engine.row(i, seen);
        turned.row(i, otherwise);
        analytic.whole_row(i, reference);
        const std::size_t n = mesh.size();
        const std::vector<double> a = dense(seen, n), b = dense(otherwise, n),
                                  exact = dense(reference, n), centre = centre_factors(i);
        std::vector<double> whole(n, 0.0);  // with nothing between
        std::vector<bool> open(n, false);   // nothing is between
        for (std::size_t k = 0; k < reference.columns.size(); ++k) {
            whole[reference.columns[k]] = reference.ceiling[k];
            open[reference.columns[k]] = reference.factors[k] == reference.ceiling[k];
        }
        Parts all, hidden;  // of all patches, and of those that something hides in part or whole
        for (std::size_t j = 0; j < n; ++j) {
            const double visible = whole[j] > 0.0 ? exact[j] / whole[j] : 0.0;
            const Parts part{std::abs(a[j] - b[j]) / std::sqrt(2.0),
                             visible * std::abs(centre[j] - whole[j]), std::abs(a[j] - exact[j])};
            all.add(part);
            if (!open[j]) hidden.add(part);
        }
        return {0.5 * all.proximity, 0.5 * hidden.rest(), 0.5 * all.aliasing};
    }
};

}  // namespace

std::optional<HemicubeErrors> estimate_hemicube_errors(const Scene& scene, const PatchMesh& mesh,
                                                       const RayScene& ray_scene,
                                                       const HemicubeSettings& settings,
                                                       const std::function<bool()>& in_time) {
    HemicubeSettings turned = settings;
    turned.seed = mix(settings.seed, 0x7475726e);
    AnalyticSettings exact;
    exact.rays = reference_rays;
    exact.seed = settings.seed;
    HemicubeEngine engine(scene, mesh, ray_scene, settings), other(scene, mesh, ray_scene, turned);
    AnalyticEngine analytic(scene, mesh, ray_scene, exact, in_time);
    for (FormFactorEngine* each :
         {static_cast<FormFactorEngine*>(&engine), static_cast<FormFactorEngine*>(&other),
          static_cast<FormFactorEngine*>(&analytic)})
        each->give_up_unless(in_time);
    std::vector<PatchIndex> sample;
    const std::size_t count = std::min(most_patches, mesh.size());
    for (std::size_t k = 0; k < count; ++k) {
        const auto i = static_cast<PatchIndex>((2 * k + 1) * mesh.size() / (2 * count));
        if (!mesh.patches[i].covered) sample.push_back(i);
    }
    const Bench bench{scene, mesh, engine, other, analytic};
    std::vector<HemicubeErrors> errors(sample.size());
    try {
        tbb::parallel_for(std::size_t{0}, sample.size(),
                          [&](std::size_t k) { errors[k] = bench.at(sample[k]); });
    } catch (const OutOfTime&) {
        return std::nullopt;
    }
    HemicubeErrors mean;
    for (const HemicubeErrors& e : errors) {
        const double n = static_cast<double>(errors.size());
        mean.proximity += e.proximity / n;
        mean.visibility += e.visibility / n;
        mean.aliasing += e.aliasing / n;
    }
    return mean;
}

}  // namespace patchlight
