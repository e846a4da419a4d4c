// What the solver's stages cost, against what the machine can do. Prints CSV: quantity,value,unit.
// Usage: patchlight_solver_bench [repeats]

#include "solver/form_factors/ray_cast_engine.h"
#include "solver/mesh/make_patches.h"
#include "solver/transport/gather.h"
#include "solver/transport/gauss_seidel.h"
#include "tests/bench/bare_embree.h"
#include "tests/bench/cornell_box.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>

namespace patchlight {

namespace {

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median_seconds(int repeats, const std::function<void()>& work) {
    std::vector<double> seconds;
    for (int k = 0; k < repeats; ++k) seconds.push_back(seconds_of(work));
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

/// Rows of the ray-cast engine against bare loops over the same rays, made beforehand.
void bench_rows(int repeats) {
    const Scene scene = cornell_box();
    const MeshLines lines = find_mesh_lines(scene);
    const PatchMesh mesh = make_patches(scene, lines, 0.021);
    const RayScene ray_scene(scene, lines.overlaps);
    constexpr int rays = 4096;
    constexpr PatchIndex rows = 256;
    const RayCastEngine engine(scene, mesh, ray_scene, rays, 1);
    const HemisphereRays same_rays(scene, mesh, ray_scene, rays, 1);
    std::vector<RayBatch> batches;
    const auto step = static_cast<PatchIndex>(mesh.size() / rows);
    for (PatchIndex r = 0; r < rows; ++r)
        for (int first = 0; first < rays; first += ray_batch) {
            batches.emplace_back();
            same_rays.fill(r * step, first, batches.back());
        }
    const BareEmbree bare(scene, ray_scene);
    const double total = static_cast<double>(rows) * rays;
    std::uint64_t check = 0;
    FactorRow row;
    std::vector<double> own, one, sixteen;
    for (int k = 0; k < repeats; ++k) {  // in turn, so that the machine's drift meets all alike
        own.push_back(seconds_of([&] {
            for (PatchIndex r = 0; r < rows; ++r) engine.row(r * step, row);
        }));
        one.push_back(seconds_of([&] { check += bare.one_by_one(batches); }));
        sixteen.push_back(seconds_of([&] { check += bare.in_packets(batches); }));
    }
    const auto median = [](std::vector<double>& x) {
        std::sort(x.begin(), x.end());
        return x[x.size() / 2];
    };
    const double t_own = median(own), t_one = median(one), t_sixteen = median(sixteen);
    std::printf("ray-cast rows,%.3f,Mrays/s on 1 thread\n", total / t_own * 1e-6);
    std::printf("bare loop of rtcIntersect1,%.3f,Mrays/s on 1 thread\n", total / t_one * 1e-6);
    std::printf("bare loop of rtcIntersect16,%.3f,Mrays/s on 1 thread\n", total / t_sixteen * 1e-6);
    std::printf("rows over bare rtcIntersect1,%.3f,1\n", t_one / t_own);
    std::printf("rows over bare rtcIntersect16,%.3f,1\n", t_sixteen / t_own);
    std::printf("patches,%zu,1\ncheck,%llu,1\n", mesh.size(),
                static_cast<unsigned long long>(check % 1000));
}

/// A dense matrix of n rows with every factor 1/n.
ExchangeMatrix uniform_exchange(std::size_t n) {
    ExchangeMatrix exchange;
    exchange.area.assign(n, 1.0);
    exchange.start.push_back(0);
    for (PatchIndex i = 0; i < n; ++i) {
        for (PatchIndex j = i + 1; j < n; ++j) {
            exchange.column.push_back(j);
            exchange.exchange.push_back(1.0f / static_cast<float>(n));
        }
        exchange.start.push_back(exchange.column.size());
    }
    return exchange;
}

void bench_sweep(int repeats, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    constexpr std::size_t n = 5000;
    const FormFactorMatrix factors(uniform_exchange(n));
    RadiosityProblem problem{factors, std::vector<double>(n, 1.0), {}, {}};
    problem.exitance.assign(3, std::vector<double>(n, 1.0));
    problem.reflectance.assign(3, std::vector<double>(n, 0.5));
    Field radiosity = problem.exitance;
    const double bytes = static_cast<double>(n) * n * sizeof(float);
    double sink = 0.0;
    const auto read_all = [&] {  // the same bytes, summed as integers: as fast as memory gives them
        std::vector<std::uint64_t> sums(n);
        tbb::parallel_for(PatchIndex{0}, static_cast<PatchIndex>(n), [&](PatchIndex i) {
            const float* row = factors.dense(i).data();
            const auto* words = reinterpret_cast<const std::uint32_t*>(row);
            std::uint32_t sum = 0;
            for (std::size_t j = 0; j < n; ++j) sum += words[j];
            sums[i] = sum;
        });
        sink += static_cast<double>(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}));
    };
    std::vector<double> sweep, read;
    for (int k = 0; k < repeats; ++k) {
        sweep.push_back(seconds_of([&] { gauss_seidel_sweep(problem, radiosity); }));
        read.push_back(seconds_of(read_all));
    }
    std::sort(sweep.begin(), sweep.end());
    std::sort(read.begin(), read.end());
    const double t_sweep = sweep[sweep.size() / 2], t_read = read[read.size() / 2];
    std::printf("dense sweep of 5000 patches and 3 channels,%.2f,ms on %d threads\n", t_sweep * 1e3,
                threads);
    std::printf("matrix read in a sweep,%.2f,GB/s on %d threads\n", bytes / t_sweep * 1e-9,
                threads);
    std::printf("matrix read alone,%.2f,GB/s on %d threads\n", bytes / t_read * 1e-9, threads);
    std::printf("sweep over bare read,%.3f,1\n", t_read / t_sweep);
    if (sink < 0.0) std::printf("%f\n", sink);
}

void bench_stages(int repeats, Engine engine) {
    const Scene scene = cornell_box();
    SolveSettings settings;
    settings.engine = engine;
    settings.patch_size = 0.021;
    std::vector<Solution> runs;
    const double total =
        median_seconds(repeats, [&] { runs.push_back(solve_scene(scene, settings, {})); });
    std::sort(runs.begin(), runs.end(), [](const Solution& a, const Solution& b) {
        return a.seconds.form_factors < b.seconds.form_factors;
    });
    const Solution& middle = runs[runs.size() / 2];
    const char* name = engine == Engine::analytic ? "analytic" : "ray-cast";
    std::printf("cornell %s patches,%zu,1\n", name, middle.mesh.size());
    std::printf("cornell %s mesh,%.4f,s\n", name, middle.seconds.mesh);
    std::printf("cornell %s form factors,%.4f,s\n", name, middle.seconds.form_factors);
    std::printf("cornell %s solve,%.4f,s\n", name, middle.seconds.solve);
    std::printf("cornell %s display,%.4f,s\n", name, middle.seconds.display);
    std::printf("cornell %s total,%.4f,s\n", name, total);
    std::printf("cornell %s rays,%llu,1\n", name,
                static_cast<unsigned long long>(middle.form_factors.rays));
}

}  // namespace

}  // namespace patchlight

int main(int argc, char** argv) {
    const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
    std::printf("quantity,value,unit\n");
    patchlight::bench_rows(repeats);
    for (const int threads : {1, 2}) patchlight::bench_sweep(4 * repeats, threads);
    patchlight::bench_stages(repeats, patchlight::Engine::analytic);
    patchlight::bench_stages(repeats, patchlight::Engine::ray_cast);
}
