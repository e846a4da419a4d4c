#include "server/form_factors_command.h"

#include "raster/write_whole.h"
#include "server/form_factors_json.h"
#include "server/interrupt.h"
#include "server/output_files.h"
#include "server/output_stream.h"
#include "server/peak_memory.h"
#include "server/progress_line.h"
#include "server/result_json.h"
#include "server/result_text.h"
#include "server/scene_file.h"
#include "server/scene_results.h"
#include "server/solve_json.h"
#include "server/summary.h"
#include "server/thread_limit.h"
#include "server/version.h"
#include "server/view_factors_file.h"
#include "server/wording.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <iostream>
#include <map>

namespace patchlight::server {
namespace {

const std::map<std::string, Grouping> groupings{
    {"object", Grouping::object}, {"face", Grouping::face}, {"patch", Grouping::patch}};

/// The rows came to an end before they were complete: what was written is thrown away.
struct Unfinished {
    ViewFactorReport report;
};

/// As the command line's contract has it.
int tell_unfinished(const ViewFactorReport& report) {
    const bool limit = report.status == Status::limit;
    std::cerr << "patchlight: " << (limit ? "a limit was reached" : "interrupted")
              << ": the factors are not complete, and no file was written\n";
    return limit ? 3 : 130;
}

Grouping grouping_of(const std::string& name) {
    const auto found = groupings.find(name);
    if (found != groupings.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [each, grouping] : groupings) known.push_back(each);
    throw WrongInput("--by: unknown choice " + in_quotes(name) + suggestion(name, known));
}

/// Without what steers a solver alone.
nlohmann::ordered_json settings_block_of(const ViewFactorReport& report) {
    nlohmann::ordered_json settings = solve_block(report.settings);
    for (const char* idle : {"solver", "tolerance", "max_iterations", "ambient"})
        settings.erase(idle);
    return settings;
}

nlohmann::ordered_json stats_of(const ViewFactorReport& report, double seconds) {
    nlohmann::ordered_json stats{{"version", 1},
                                 {"patchlight", program_version()},
                                 {"status", name_of(report.status)},
                                 {"settings", {{"solve", settings_block_of(report)}}},
                                 {"patches", report.patches},
                                 {"streamed", report.streamed},
                                 {"form_factors", form_factors_block(report.form_factors)}};
    if (report.streamed) stats["form_factors"].erase("reciprocity_max");
    if (report.streamed) stats["form_factors"].erase("repair");
    stats["findings"] = finding_list(report.findings);
    stats["seconds"] = {{"mesh", report.seconds.mesh},
                        {"form_factors", report.seconds.form_factors},
                        {"write", report.seconds.display},
                        {"total", seconds}};
    stats["peak_memory_bytes"] = peak_memory();
    return stats;
}

}  // namespace

CLI::App* FormFactorsCommand::add_to(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("form-factors", "Compute view factors: who sees how much of whom");
    command->add_option("SCENE", scene_, "scene JSON or geometry file; - for standard input")
        ->required();
    command
        ->add_option("--by", by_,
                     "object (the default), face (polygons as they were given) or patch")
        ->type_name("NAME");
    command
        ->add_option("--output", output_,
                     "file to write: .csv, .json or .mtx (Matrix Market); standard output takes "
                     "CSV")
        ->type_name("FILE");
    command->add_option("--stats", stats_, "JSON of closure, reciprocity, time and memory to write")
        ->type_name("FILE");
    command->add_flag("--quiet", is_quiet_, "no progress and no summary on the terminal");
    constexpr bool solved = false;
    settings_.add_to(*command, solved);
    return command;
}

int FormFactorsCommand::run() const {
    const auto start = std::chrono::steady_clock::now();
    const Grouping grouping = grouping_of(by_);
    check_view_factors_output("--output", output_);
    if (stats_) {
        require_writable("--stats", *stats_);
        require_different({output_, *stats_});
    }
    std::vector<std::string> outputs{output_};
    if (stats_) outputs.push_back(*stats_);
    require_not_read(outputs, {scene_});
    catch_interrupts();
    Job job = read_scene_file(scene_);
    require_not_read(outputs, job.files);
    settings_.lay_over(job);
    const ThreadLimit limit(job.settings.threads);
    ViewFactorReport report;
    try {
        settings_.naming_culprit(shown_path(scene_), [&] {
            const ViewFactorSolver solver(job.scene, job.settings, grouping);
            report = find(solver);
        });
    } catch (const Unfinished& unfinished) {
        return tell_unfinished(unfinished.report);
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    tell(report, seconds.count());
    return 0;
}

ViewFactorReport FormFactorsCommand::find(const ViewFactorSolver& solver) const {
    const FactorGroups& found = solver.groups();
    const ViewFactorGroups groups{found.names, found.areas};
    ProgressLine line(!is_quiet_);
    const Observer observe = [&](const Progress& progress) {
        line.show(progress);
        return is_interrupted() ? Verdict::stop : Verdict::go_on;
    };
    ViewFactorReport report;
    write_view_factors(output_, groups, [&](const TakeViewFactorRow& take) {
        report = solver.find(
            [&](const GroupFactors& row) {
                take({row.from, row.to, row.factors, row.errors});
            },
            observe);
        if (report.status != Status::converged) throw Unfinished{report};
    });
    return report;
}

void FormFactorsCommand::tell(const ViewFactorReport& report, double seconds) const {
    if (stats_)
        write_output(*stats_,
                     [&](const TextSink& sink) { sink(result_text(stats_of(report, seconds))); });
    if (is_quiet_) return;
    const ClosureReport &before = report.form_factors.measured,
                        &after = report.form_factors.repaired;
    std::cerr << "patches:   " << report.patches
              << (report.streamed ? ", rows one by one" : ", all pairs together") << "\n"
              << "closure:   within " << rounded(after.closure_max) << " ("
              << rounded(before.closure_max) << " before repair), row sums "
              << rounded(after.row_sum_min) << " to " << rounded(after.row_sum_max) << "\n";
    if (!report.streamed)
        std::cerr << "reciproc.: "
                  << (after.reciprocity_max > 0.0 ? "within " + rounded(after.reciprocity_max)
                                                  : "exact")
                  << "\n";
    std::cerr << "time:      " << rounded(seconds) << " s (factors "
              << rounded(report.seconds.form_factors) << ", writing "
              << rounded(report.seconds.display) << "), " << report.form_factors.rays
              << " rays, peak memory " << memory_text(static_cast<double>(peak_memory())) << "\n"
              << finding_lines(report.findings);
}

}  // namespace patchlight::server
