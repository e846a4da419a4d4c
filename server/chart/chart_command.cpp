#include "server/chart/chart_command.h"

#include "raster/image_module.h"
#include "server/chart/chart_files.h"
#include "server/chart/chart_progress.h"
#include "server/chart/make_chart.h"
#include "server/chart/report_figures.h"
#include "server/chart/report_html.h"
#include "server/interrupt.h"
#include "server/scene_file.h"
#include "server/summary.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>

namespace patchlight::server {
namespace {

std::string reference_line(const Chart& chart) {
    if (!chart.reference) return "reference: none: the time limit was too short\n";
    if (chart.reference->is_known) return "reference: the known answer\n";
    std::string line = "reference: accuracy " + rounded(chart.reference->accuracy);
    if (chart.reference->estimate) line += ", error about " + percent(*chart.reference->estimate);
    return line + ", " + rounded(chart.reference->seconds) + " s\n";
}

std::string summary(const Chart& chart) {
    std::string lines = reference_line(chart) +
                        "methods:   " + std::to_string(chart.points.size()) + " measured, " +
                        std::to_string(chart.skipped.size()) + " skipped, in " +
                        rounded(chart.seconds) + " s\n";
    for (const ChartPoint& point : chart.points)
        if (point.is_on_front)
            lines += "front:     " + rounded(point.seconds) + " s, " + percent(*point.error) +
                     ", " + all_series[point.method.series].name + ", " +
                     setting_text(point.method) + "\n";
    if (const std::string lesson = automatic_lesson(chart); !lesson.empty())
        lines += "lesson:    " + lesson + "\n";
    return lines;
}

int chart_exit_code(const Chart& chart) {
    if (chart.is_interrupted) return 130;  // what a shell says of a program that SIGINT ended
    return chart.points.empty() ? 3 : 0;
}

}  // namespace

CLI::App* ChartCommand::add_to(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "chart", "Chart speed against accuracy: every method, on a scene of one's own");
    command
        ->add_option("SCENE", scene_,
                     "scene JSON, or .obj, .gltf, .glb, .stl; - for standard input")
        ->required();
    command
        ->add_option("--output", directory_,
                     "directory for chart.csv, .json, .svg, .png, .gp and .html; made if it is "
                     "not there")
        ->type_name("DIR")
        ->required();
    command
        ->add_option("--time-limit", time_limit_,
                     "in seconds, for all solves together; 120 if not given")
        ->type_name("S");
    command->add_flag("--quiet", is_quiet_, "no progress on the terminal");
    return command;
}

int ChartCommand::run() const {
    if (!(time_limit_ > 0.0) || !std::isfinite(time_limit_))
        throw WrongInput("--time-limit: must be above 0");
    catch_interrupts();
    const Job job = read_scene_file(scene_);
    naming_file(shown_path(scene_), [&] { require_chartable(job.scene); });
    prepare_directory("--output", directory_);
    raster::preload_image_codec();
    ChartWishes wishes;
    wishes.time_limit = time_limit_;
    Chart chart;
    naming_file(shown_path(scene_), [&] {
        ChartProgressLine line(!is_quiet_);
        chart = make_chart(
            job, wishes, [&](const std::string& doing, double share) { line.show(doing, share); },
            is_interrupted);
    });
    const std::string why_not_drawn =
        write_chart_files(chart, describe_origin(scene_, directory_, time_limit_), directory_);
    std::cout << summary(chart) << "written:   " << directory_ << "/chart.html\n";
    if (!why_not_drawn.empty())
        std::cerr << "patchlight: chart.svg and chart.png are not drawn: " << why_not_drawn
                  << "; chart.csv, chart.json and chart.html are there\n";
    if (chart.is_interrupted)
        std::cerr << "patchlight: interrupted: the chart holds what was measured so far\n";
    else if (chart.points.empty())
        std::cerr << "patchlight: the time limit was too short to measure anything\n";
    return chart_exit_code(chart);
}

}  // namespace patchlight::server
