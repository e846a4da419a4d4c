// View factors of the closed Cornell box (front wall added): time, closure, and accuracy against
// 10^7 rays a row and against the contour integral. Prints CSV: quantity,value,unit.
// Usage: patchlight_view_factor_bench [patch_size [rays_of_the_reference [seed]]]

#include "solver/form_factors/contour_exchange.h"
#include "solver/form_factors/ray_cast_engine.h"
#include "solver/mesh/make_patches.h"
#include "solver/view_factors.h"
#include "tests/bench/cornell_box.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>

namespace patchlight {

namespace {

constexpr std::size_t reference_rows = 30;
constexpr int decades = 3;  // of factors: from 1e-2 down
constexpr std::size_t pairs_per_decade = 100;

struct Entry {
    double factor = 0.0, error = 0.0;
};

struct Sampled {
    std::vector<PatchIndex> rows;  // chosen at random
    std::vector<std::map<PatchIndex, Entry>> factors;
    double largest = 0.0, smallest = 1.0;  // of all factors
    std::size_t count = 0;
};

ConvexPolygon polygon_of(const PatchMesh& mesh, PatchIndex i) {
    ConvexPolygon polygon;
    for (const Vec3& p : patch_corners(mesh, i)) polygon.add(p);
    return polygon;
}

/// Sums by object of each sampled row against counted rays.
void compare_with_rays(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene,
                       const Sampled& sampled, int rays) {
    const RayCastEngine reference(scene, mesh, ray_scene, rays, 4711);
    double worst = 0.0, squared = 0.0;
    int compared = 0;
    for (std::size_t r = 0; r < sampled.rows.size(); ++r) {
        FactorRow row;
        reference.row(sampled.rows[r], row);
        std::vector<double> counted(scene.objects.size(), 0.0), found = counted;
        const auto object = [&](PatchIndex j) {
            return scene.surfaces[mesh.patches[j].surface].object;
        };
        for (std::size_t k = 0; k < row.columns.size(); ++k)
            counted[object(row.columns[k])] += row.factors[k];
        for (const auto& [j, entry] : sampled.factors[r]) found[object(j)] += entry.factor;
        for (std::size_t o = 0; o < counted.size(); ++o) {
            if (counted[o] < 0.01) continue;  // less is known to no half percent from the rays
            const double error = std::abs(found[o] / counted[o] - 1.0);
            worst = std::max(worst, error);
            squared += error * error;
            ++compared;
        }
    }
    std::printf("sums by object above 0.01 compared,%d,1\n", compared);
    std::printf("largest difference from rays,%.3g,1\n", worst);
    std::printf("root mean square difference,%.3g,1\n", std::sqrt(squared / compared));
}

/// Entries that no ray was cast for, against the contour integral.
void compare_with_contours(const Scene& scene, const PatchMesh& mesh, const Sampled& sampled) {
    std::array<std::size_t, decades> compared{};
    std::array<double, decades> worst{};
    for (std::size_t r = 0; r < sampled.rows.size(); ++r) {
        const PatchIndex i = sampled.rows[r];
        const Surface& own = scene.surfaces[mesh.patches[i].surface];
        for (const auto& [j, entry] : sampled.factors[r]) {
            if (entry.error > 1e-5 * entry.factor) continue;
            const int decade = static_cast<int>(std::floor(-std::log10(entry.factor))) - 2;
            if (decade < 0 || decade >= decades) continue;
            const auto d = static_cast<std::size_t>(decade);
            if (compared[d] >= pairs_per_decade * reference_rows) continue;
            const Surface& other = scene.surfaces[mesh.patches[j].surface];
            const ConvexPolygon p = clip_to_front(polygon_of(mesh, i), other.corners[0],
                                                  other.normal),
                                q = clip_to_front(polygon_of(mesh, j), own.corners[0], own.normal);
            const double exact = contour_exchange(p, q) / mesh.patches[i].area;
            worst[d] = std::max(worst[d], std::abs(entry.factor / exact - 1.0));
            ++compared[d];
        }
    }
    for (std::size_t d = 0; d < decades; ++d)
        std::printf("unblocked pairs from 1e-%zu to 1e-%zu,%zu,1\nlargest error there,%.3g,1\n",
                    d + 3, d + 2, compared[d], worst[d]);
}

void run(double patch_size, int rays, unsigned seed) {
    Scene scene = cornell_box();
    scene.objects.push_back({"front wall"});
    add_polygon(scene, static_cast<ObjectIndex>(scene.objects.size() - 1), 0, 0,
                std::vector<Vec3>{{0.5528, 0, 0}, {0.556, 0.5488, 0}, {0, 0.5488, 0}, {0, 0, 0}},
                "");
    SolveSettings settings;
    settings.patch_size = patch_size;
    const auto start = std::chrono::steady_clock::now();
    const ViewFactorSolver solver(scene, settings, Grouping::patch);
    const MeshLines lines = find_mesh_lines(scene);
    const PatchMesh mesh = make_patches(scene, lines, patch_size);
    Sampled sampled;
    std::mt19937 chance(seed);
    while (sampled.rows.size() < reference_rows) {
        const auto i = static_cast<PatchIndex>(chance() % mesh.size());
        if (!mesh.patches[i].covered) sampled.rows.push_back(i);
    }
    std::sort(sampled.rows.begin(), sampled.rows.end());
    sampled.factors.resize(reference_rows);
    const ViewFactorReport report = solver.find(
        [&](const GroupFactors& row) {
            for (const double factor : row.factors) {
                sampled.largest = std::max(sampled.largest, factor);
                sampled.smallest = std::min(sampled.smallest, factor);
            }
            sampled.count += row.to.size();
            for (std::size_t r = 0; r < reference_rows; ++r)
                if (sampled.rows[r] == row.from)
                    for (std::size_t k = 0; k < row.to.size(); ++k)
                        sampled.factors[r][row.to[k]] = {row.factors[k], row.errors[k]};
        },
        {});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("patches,%zu,1\nfactors,%zu,1\n", report.patches, sampled.count);
    std::printf("time,%.3f,s\nrays,%llu,1\n", seconds.count(),
                static_cast<unsigned long long>(report.form_factors.rays));
    std::printf("closure before repair,%.3g,1\nclosure,%.3g,1\nreciprocity,%.3g,1\n",
                report.form_factors.measured.closure_max, report.form_factors.repaired.closure_max,
                report.form_factors.repaired.reciprocity_max);
    std::printf("smallest factor,%.3g,1\nlargest factor,%.6f,1\n", sampled.smallest,
                sampled.largest);
    const RayScene ray_scene(scene, lines.overlaps);
    compare_with_contours(scene, mesh, sampled);
    if (rays > 0) compare_with_rays(scene, mesh, ray_scene, sampled, rays);
}

}  // namespace

}  // namespace patchlight

int main(int count, char** arguments) {
    const double patch_size = count > 1 ? std::atof(arguments[1]) : 0.0162;
    const int rays = count > 2 ? std::atoi(arguments[2]) : 10'000'000;
    const unsigned seed = count > 3 ? static_cast<unsigned>(std::atoi(arguments[3])) : 1;
    patchlight::run(patch_size, rays, seed);
    return 0;
}
