// True errors of solves to an accuracy, in random rooms, beside what they say of themselves.
//
//   patchlight_accuracy_bench FIRST_SEED ROOMS [POINTS [RAYS [FINER [TIGHTEST]]]]
//
// The truth at points spread by area: direct light by 128 x 128 samples of each lamp, all other
// light by RAYS rays over the hemisphere that read a solution to the accuracy FINER where they
// land.
#include "solver/display/light_sources.h"
#include "solver/form_factors/point_factor.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/solve_scene.h"
#include "tests/bench/shown_field.h"
#include "tests/physics/random_room.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>

namespace patchlight {
namespace {

constexpr int lamp_samples = 128;  // along each side
constexpr double accuracies[] = {0.1, 0.03, 0.01, 0.003};

struct Truth {
    SurfaceIndex surface = 0;
    Vec3 position = Vec3::Zero();
    double reflected = 0.0;  // luminance of B - E [W/m²]
};

struct Reference {
    const Scene& scene;
    const RayScene& rays;
    const std::vector<LightSource>& lamps;
    const ShownLattices& shown;
    int count;  // of rays

    double visible_share(const RayPoint& origin, const RayPoint& normal, const LightSource& lamp,
                         std::mt19937_64& random) const {
        RayBatch batch;
        std::array<float, ray_batch> weight;
        int filled = 0;
        double clear = 0.0, all = 0.0;
        const auto flush = [&] {
            const std::uint32_t blocked = rays.blocked(batch, filled);
            for (int k = 0; k < filled; ++k) {
                all += weight[k];
                if (!((blocked >> k) & 1u)) clear += weight[k];
            }
            filled = 0;
        };
        for (int n = 0; n < lamp_samples * lamp_samples; ++n) {
            const float u = (static_cast<float>(n % lamp_samples) + jitter(random)) / lamp_samples,
                        v = (static_cast<float>(n / lamp_samples) + jitter(random)) / lamp_samples;
            const RayPoint ray = lamp.sampler.at(u, v) + lamp.lift * lamp.sampler.normal - origin;
            const float squared = ray.squaredNorm();
            const float kernel = std::max(0.0f, ray.dot(normal)) *
                                 std::max(0.0f, -ray.dot(lamp.sampler.normal)) /
                                 (squared * squared);
            if (!(kernel > 0.0f)) continue;
            batch.ox[filled] = origin.x(), batch.oy[filled] = origin.y(),
            batch.oz[filled] = origin.z();
            batch.dx[filled] = ray.x(), batch.dy[filled] = ray.y(), batch.dz[filled] = ray.z();
            weight[filled++] = kernel;
            if (filled == ray_batch) flush();
        }
        if (filled > 0) flush();
        return all > 0.0 ? clear / all : 0.0;
    }

    static float jitter(std::mt19937_64& random) {
        return static_cast<float>(random() >> 40) * 0x1p-24f;
    }

    double arriving(const Truth& at, std::uint64_t seed) const {
        std::mt19937_64 random(seed);
        const Surface& surface = scene.surfaces[at.surface];
        const RayPoint normal = surface.normal.cast<float>();
        const RayPoint origin = rays.to_ray_space(at.position) + rays.lift(at.surface) * normal;
        double sum = 0.0;
        for (const LightSource& lamp : lamps) {
            const double factor =
                point_factor(at.position, surface.normal, lamp.polygon, lamp.normal);
            if (factor > 0.0)
                sum +=
                    factor * luminance(lamp.exitance) * visible_share(origin, normal, lamp, random);
        }
        return sum + indirect(origin, surface.normal, random);
    }

    double indirect(const RayPoint& origin, const Vec3& normal, std::mt19937_64& random) const {
        const PlaneFrame frame = frame_of(Vec3::Zero(), normal);
        const int side = static_cast<int>(std::sqrt(static_cast<double>(count)));
        RayBatch batch;
        LandingBatch landings;
        int filled = 0;
        double sum = 0.0;
        const auto flush = [&] {
            rays.land(batch, filled, landings);
            for (int k = 0; k < filled; ++k)
                if (landings.landing[k] == Landing::front)
                    sum += shown.at(landings.surface[k],
                                    {landings.x[k], landings.y[k], landings.z[k]});
            filled = 0;
        };
        for (int n = 0; n < side * side; ++n) {
            const double u = (n % side + static_cast<double>(jitter(random))) / side,
                         turn = 2.0 * std::numbers::pi *
                                (n / side + static_cast<double>(jitter(random))) / side;
            const Vec3 d = std::sqrt(u) * (std::cos(turn) * frame.u + std::sin(turn) * frame.v) +
                           std::sqrt(std::max(1e-12, 1.0 - u)) * frame.normal;
            batch.ox[filled] = origin.x(), batch.oy[filled] = origin.y(),
            batch.oz[filled] = origin.z();
            batch.dx[filled] = static_cast<float>(d.x());
            batch.dy[filled] = static_cast<float>(d.y());
            batch.dz[filled] = static_cast<float>(d.z());
            if (++filled == ray_batch) flush();
        }
        if (filled > 0) flush();
        return sum / (side * side);
    }
};

std::vector<Truth> spread_points(const Scene& scene, std::size_t count, unsigned seed) {
    std::vector<double> area;
    for (const Surface& surface : scene.surfaces)
        area.push_back((area.empty() ? 0.0 : area.back()) + surface.area);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Truth> points(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double at = (static_cast<double>(k) + unit(random)) / static_cast<double>(count);
        const auto found = std::upper_bound(area.begin(), area.end() - 1, at * area.back());
        points[k].surface = static_cast<SurfaceIndex>(found - area.begin());
        const auto& corners = scene.surfaces[points[k].surface].corners;
        points[k].position = corners[0] + unit(random) * (corners[1] - corners[0]) +
                             unit(random) * (corners[3] - corners[0]);
    }
    return points;
}

void judge(unsigned seed, std::size_t count, int ray_count, double finer, double tightest) {
    const Scene scene = random_room(seed);
    SolveSettings fine;
    fine.accuracy = finer;
    fine.time_limit = 90.0;
    const Solution best = solve_scene(scene, fine, {});
    if (!best.error.met()) {
        std::fprintf(stderr, "%u is left out: its truth takes too long\n", seed);
        return;
    }
    const MeshLines lines = find_mesh_lines(scene);
    const RayScene rays(scene, lines.overlaps);
    const std::vector<LightSource> lamps = find_light_sources(scene, lines, rays, 1000);
    const ShownLattices lattices(scene, ShownField(scene, best), rays);
    const Reference reference{scene, rays, lamps, lattices, ray_count};
    std::vector<Truth> points = spread_points(scene, count, seed);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        Truth& point = points[k];
        const Rgb& reflectance =
            scene.materials[scene.surfaces[point.surface].material].reflectance;
        // Rooms are grey, so that luminance is all there is.
        point.reflected = luminance(reflectance) * reference.arriving(point, mix(seed, k));
    });
    double norm = 0.0;
    for (const Truth& point : points) norm += point.reflected * point.reflected;
    for (const double accuracy : accuracies) {
        if (accuracy < tightest) continue;
        SolveSettings settings;
        settings.accuracy = accuracy;
        const auto start = std::chrono::steady_clock::now();
        const Solution solution = solve_scene(scene, settings, {});
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const ShownField shown(scene, solution);
        double error = 0.0;
        for (const Truth& point : points) {
            const double miss = shown.at(point.surface, point.position) - point.reflected;
            error += miss * miss;
        }
        std::printf("%u,%g,%.3f,%.5f,%.5f,%d,%.5f,%.5f\n", seed, accuracy, seconds,
                    solution.error.estimate.value_or(-1.0), std::sqrt(error / norm),
                    solution.error.met() ? 1 : 0, solution.error.mesh.value_or(-1.0),
                    solution.error.form_factors.value_or(-1.0));
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace patchlight

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: %s FIRST_SEED ROOMS [POINTS [RAYS [FINER [TIGHTEST]]]]\n",
                     argv[0]);
        return 2;
    }
    const auto first = static_cast<unsigned>(std::atoi(argv[1]));
    const int rooms = std::atoi(argv[2]);
    const std::size_t points = argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : 400;
    const int rays = argc > 4 ? std::atoi(argv[4]) : 65536;
    const double finer = argc > 5 ? std::atof(argv[5]) : 0.002;
    const double tightest = argc > 6 ? std::atof(argv[6]) : 0.0;
    std::printf("seed,accuracy,seconds,estimate,true,met,mesh,form_factors\n");
    for (int k = 0; k < rooms; ++k)
        patchlight::judge(first + static_cast<unsigned>(k), points, rays, finer, tightest);
    return 0;
}
