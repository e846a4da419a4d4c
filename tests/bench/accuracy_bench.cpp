// True errors of solves to an accuracy, in random rooms, beside what they say of themselves.
//
//   patchlight_accuracy_bench FIRST_SEED ROOMS [POINTS [RAYS [FINER [TIGHTEST]]]]
//
// The truth at points spread by area: direct light by 128 x 128 samples of each lamp, all other
// light by rays over the hemisphere that read a solution to the accuracy FINER where they land:
// twice, so that noise cancels, from RAYS each on until it is a fifth of TIGHTEST, the smallest
// accuracy, or they are 64 times as many. Column `noise` tells what is left.
#include "solver/solve_scene.h"
#include "tests/bench/gathered_truth.h"
#include "tests/physics/random_room.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace patchlight {
namespace {

constexpr double accuracies[] = {0.1, 0.03, 0.01, 0.003};
constexpr double most_rays = 64.0;   // times those at first
constexpr double truth_share = 0.2;  // of the tightest accuracy

struct Judged {
    std::size_t points = 400;
    double rays = 65536.0, finer = 0.002, tightest = 0.003;
};

void judge(unsigned seed, const Judged& how) {
    const Scene scene = random_room(seed);
    SolveSettings fine;
    fine.accuracy = how.finer;
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
    const std::vector<TruePoint> points =
        GatheredTruth(scene, rays, lamps, lattices)
            .at_points(how.points, seed, how.rays, most_rays * how.rays,
                       truth_share * how.tightest);
    for (const double accuracy : accuracies) {
        if (accuracy < how.tightest) continue;
        SolveSettings settings;
        settings.accuracy = accuracy;
        const auto start = std::chrono::steady_clock::now();
        const Solution solution = solve_scene(scene, settings, {});
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const ShownField shown(scene, solution);
        std::vector<double> found;
        for (const TruePoint& point : points)
            found.push_back(shown.at(point.surface, point.position));
        std::printf("%u,%g,%.3f,%.5f,%.5f,%d,%.5f,%.5f,%.5f\n", seed, accuracy, seconds,
                    solution.error.estimate.value_or(-1.0), true_error(points, found),
                    solution.error.met() ? 1 : 0, solution.error.mesh.value_or(-1.0),
                    solution.error.form_factors.value_or(-1.0), truth_noise(points));
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
    patchlight::Judged how;
    if (argc > 3) how.points = static_cast<std::size_t>(std::atoi(argv[3]));
    if (argc > 4) how.rays = std::atof(argv[4]);
    if (argc > 5) how.finer = std::atof(argv[5]);
    if (argc > 6) how.tightest = std::atof(argv[6]);
    std::printf("seed,accuracy,seconds,estimate,true,met,mesh,form_factors,noise\n");
    for (int k = 0; k < rooms; ++k) patchlight::judge(first + static_cast<unsigned>(k), how);
    return 0;
}
