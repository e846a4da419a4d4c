#include "server/check_command.h"

#include "server/scene_file.h"
#include "server/summary.h"
#include "server/viewpoints.h"
#include "solver/foretell_time.h"
#include "solver/solve_scene.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <utility>
#include <vector>

namespace patchlight::server {

CLI::App* CheckCommand::add_to(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("check", "Say whether a scene is right and what it would cost");
    command
        ->add_option("SCENE", scene_,
                     "scene JSON, or .obj, .gltf, .glb, .stl; - for standard input")
        ->required();
    settings_.add_to(*command);
    return command;
}

int CheckCommand::run() const {
    Job job = read_scene_file(scene_);
    settings_.lay_over(job);
    CostEstimate cost;
    settings_.naming_culprit(shown_path(scene_),
                             [&] { cost = estimate_cost(job.scene, job.settings); });
    const Scene& scene = job.scene;
    const double seconds =
        cost.memory > cost.memory_limit ? cost.seconds : foretell_seconds(job.scene, job.settings);
    std::vector<Finding> findings = find_flaws(scene, job.settings, viewpoints(job));
    std::cout << "scene:     objects " << scene.objects.size() << ", polygons "
              << scene.surfaces.size() << ", materials " << scene.materials.size() << ", cameras "
              << job.cameras.size() << ", sensors " << scene.sensors.size() << "\n"
              << "patches:   " << cost.patches << "\n"
              << "memory:    " << memory_text(static_cast<double>(cost.memory))
              << (cost.memory > cost.memory_limit
                      ? ", over the limit of " + memory_text(static_cast<double>(cost.memory_limit))
                      : "")
              << "\n"
              << "time:      about " << rounded(seconds) << " s on this machine\n"
              << finding_lines(findings);
    return 0;
}

}  // namespace patchlight::server
