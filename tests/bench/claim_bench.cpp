// Whether the true error lies within the estimate, by class of scene, over new seeds.
//
//   patchlight_claim_bench CLASS FIRST COUNT [OPTIONS]     scenes FIRST … FIRST + COUNT - 1
//   patchlight_claim_bench --scene FILE [OPTIONS]          any scene file
//   patchlight_claim_bench --classes                       names the classes; `all` is each of them
//
//   --accuracy A,B,…   asked for (0.1,0.03,0.01)       --time-limit S  of a solve (60)
//   --landings N       of the truth's light (2e7)      --bin N         landings a bin (500)
//   --threads N        of a solve (2)                  --seed N        of the truth (1)
//   --searches N       for small spots, a round (6400000)
//   --write DIR        writes CLASS-SEED.json there     --no-solve      no more than that
//   --flux FILE        writes what arrives at each object by the light tracer
//
// The truth: light_tracer.h. `true` is the error of bin means, so never more than the error itself
// but for noise (`true_sigma`). `within` is 1 if true <= estimate, `within_surely` if true less one
// sigma is. No estimate: neither. `false_met`: met, though true - 2 sigma is above the target.
#include "server/scene_file.h"
#include "server/scene_json.h"
#include "solver/solve_scene.h"
#include "tests/bench/claim_scenes.h"
#include "tests/bench/light_tracer.h"
#include "tests/bench/shown_in_bins.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace patchlight {
namespace {

struct Options {
    std::vector<double> accuracies{0.1, 0.03, 0.01};
    double time_limit = 60.0;
    int threads = 2;
    TracerSettings truth;
    std::string write, scene, flux;
    bool solve = true;
    std::vector<std::string> places;
};

struct Tally {
    int scenes = 0, within = 0, surely = 0, met = 0, false_met = 0, useless = 0;
    std::vector<double> ratio;
};
using Tallies = std::map<std::pair<std::string, double>, Tally>;  // by class and accuracy

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

const char* name_of(Status status) {
    switch (status) {
        case Status::converged:
            return "converged";
        case Status::limit:
            return "limit";
        case Status::cancelled:
            return "cancelled";
    }
    return "";
}

std::string number(const std::optional<double>& x) {
    if (!x) return "";
    char text[32];
    std::snprintf(text, sizeof text, "%.5f", *x);
    return text;
}

void write_flux(const Scene& scene, const LightTracer& truth, const std::string& path) {
    std::ofstream out(path);
    out << "name,F_r,F_g,F_b,se_r,se_g,se_b\n";
    for (ObjectIndex o = 0; o < scene.objects.size(); ++o) {
        std::vector<SurfaceIndex> surfaces;
        Rgb flux = Rgb::Zero();
        for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
            if (scene.surfaces[s].object == o) {
                surfaces.push_back(s);
                flux += truth.arriving(s);
            }
        const Rgb error = truth.arriving_error(surfaces);
        out << scene.objects[o].name;
        for (const double x : flux) out << ',' << x;
        for (const double x : error) out << ',' << x;
        out << '\n';
    }
}

void judge(const std::string& kind, const std::string& name, const Scene& scene,
           const Options& options, Tallies& tallies) {
    const auto start = std::chrono::steady_clock::now();
    const LightTracer truth(scene, options.truth);
    std::fprintf(stderr, "%s %s: %zu surfaces, %zu bins, %.3g landings in %.1f s\n", kind.c_str(),
                 name.c_str(), scene.surfaces.size(), truth.bins().size(), truth.landings(),
                 seconds_since(start));
    if (!options.flux.empty()) write_flux(scene, truth, options.flux);
    if (!options.solve) return;
    for (const double accuracy : options.accuracies) {
        SolveSettings settings;
        settings.accuracy = accuracy;
        settings.time_limit = options.time_limit;
        settings.threads = options.threads;
        const auto begin = std::chrono::steady_clock::now();
        const Solution solution = solve_scene(scene, settings, {});
        const double seconds = seconds_since(begin);
        const TrueError error =
            truth.error_of(shown_in_bins(scene, solution, truth.traced(), truth.bins()));
        const auto& estimate = solution.error.estimate;
        const bool met = solution.error.met(), within = estimate && error.value <= *estimate,
                   surely = estimate && error.low <= *estimate;
        std::printf("%s,%s,%g,%.2f,%s,%.5f,%.5f,%d,%d,%d,%.5f,%s,%s,%s,%zu,%.5f", kind.c_str(),
                    name.c_str(), accuracy, seconds, number(estimate).c_str(), error.value,
                    error.sigma(), met, within, surely, solution.energy.defect,
                    name_of(solution.status), number(solution.error.form_factors).c_str(),
                    number(solution.error.mesh).c_str(), solution.mesh.patches.size(),
                    solution.error.unbalanced);
        if (const auto& check = solution.error.transport)
            std::printf(",%.5f,%.5f,%.5f,%.5f,%llu\n", check->proven, check->difference,
                        check->standard_error, check->doubt,
                        static_cast<unsigned long long>(check->rays));
        else
            std::printf(",,,,,\n");
        std::fflush(stdout);
        Tally& tally = tallies[{kind, accuracy}];
        ++tally.scenes;
        tally.within += within;
        tally.surely += surely;
        tally.met += met;
        tally.useless += !estimate || *estimate > 1.0;
        tally.false_met += met && error.value - 2.0 * error.sigma() > accuracy;
        if (estimate && error.value > 0.0) tally.ratio.push_back(*estimate / error.value);
    }
}

void judge_class(const SceneClass& kind, unsigned first, int count, const Options& options,
                 Tallies& tallies) {
    for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
        const std::string text = claim_scene(kind.name, seed);
        if (!options.write.empty())
            std::ofstream(options.write + "/" + kind.name + "-" + std::to_string(seed) + ".json")
                << text;
        try {
            const server::Job job = server::read_scene_text(text);
            judge(kind.name, std::to_string(seed), job.scene, options, tallies);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s %u: %s\n", kind.name, seed, error.what());
            std::printf("%s,%u,,,,,,0,0,0,,failed,,,\n", kind.name, seed);
            for (const double accuracy : options.accuracies)
                ++tallies[{kind.name, accuracy}].scenes;
        }
    }
}

void summarise(Tallies& tallies) {
    for (auto& [key, tally] : tallies) {
        std::sort(tally.ratio.begin(), tally.ratio.end());
        const double median = tally.ratio.empty() ? 0.0 : tally.ratio[tally.ratio.size() / 2];
        std::printf(
            "# %s %g: within %d/%d (surely %d), median estimate/true %.2f, met %d, "
            "false met %d, none or above 1: %d\n",
            key.first.c_str(), key.second, tally.within, tally.scenes, tally.surely, median,
            tally.met, tally.false_met, tally.useless);
    }
}

std::vector<double> numbers(const char* text) {
    std::vector<double> all;
    std::stringstream stream(text);
    for (std::string one; std::getline(stream, one, ',');) all.push_back(std::atof(one.c_str()));
    return all;
}

Options read_options(int argc, char** argv) {
    Options options;
    for (int k = 1; k < argc; ++k) {
        const std::string name = argv[k];
        const auto value = [&]() -> const char* {
            if (k + 1 >= argc) throw std::invalid_argument(name + " needs a value");
            return argv[++k];
        };
        if (name == "--accuracy")
            options.accuracies = numbers(value());
        else if (name == "--time-limit")
            options.time_limit = std::atof(value());
        else if (name == "--threads")
            options.threads = std::atoi(value());
        else if (name == "--landings")
            options.truth.landings = std::atof(value());
        else if (name == "--bin")
            options.truth.a_bin = std::atof(value());
        else if (name == "--seed")
            options.truth.seed = std::strtoull(value(), nullptr, 10);
        else if (name == "--searches")
            options.truth.searches = static_cast<std::size_t>(std::atof(value()));
        else if (name == "--write")
            options.write = value();
        else if (name == "--scene")
            options.scene = value();
        else if (name == "--flux")
            options.flux = value();
        else if (name == "--no-solve")
            options.solve = false;
        else if (name.starts_with("--") && name != "--classes")
            throw std::invalid_argument("no option is named " + name);
        else
            options.places.push_back(name);
    }
    return options;
}

int run(const Options& options) {
    Tallies tallies;
    if (options.places == std::vector<std::string>{"--classes"}) {
        for (const SceneClass& kind : scene_classes()) std::printf("%s\n", kind.name);
        return 0;
    }
    if (options.scene.empty() && options.places.size() != 3)
        throw std::invalid_argument(
            "usage: CLASS FIRST COUNT, or --scene FILE; see claim_bench.cpp");
    std::printf(
        "class,seed,accuracy,seconds,estimate,true,true_sigma,met,within,within_surely,"
        "defect,status,form_factors,mesh,patches,"
        "unbalanced,proven,difference,difference_sigma,doubt,particle_rays\n");
    if (!options.scene.empty()) {
        judge("file", options.scene, server::read_scene_file(options.scene).scene, options,
              tallies);
    } else {
        const unsigned first = static_cast<unsigned>(std::atoi(options.places[1].c_str()));
        const int count = std::atoi(options.places[2].c_str());
        bool known = false;
        for (const SceneClass& kind : scene_classes()) {
            if (options.places[0] != "all" && options.places[0] != kind.name) continue;
            known = true;
            judge_class(kind, first, count, options, tallies);
        }
        if (!known) throw std::invalid_argument("no class is named " + options.places[0]);
    }
    summarise(tallies);
    return 0;
}

}  // namespace
}  // namespace patchlight

int main(int argc, char** argv) {
    try {
        return patchlight::run(patchlight::read_options(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
