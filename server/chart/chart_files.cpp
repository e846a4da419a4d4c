#include "server/chart/chart_files.h"

#include "raster/write_whole.h"
#include "server/chart/chart_csv.h"
#include "server/chart/chart_json.h"
#include "server/chart/gnuplot_script.h"
#include "server/chart/report_html.h"
#include "server/chart/run_gnuplot.h"
#include "server/output_files.h"
#include "server/output_stream.h"
#include "server/result_text.h"
#include "server/wrong_input.h"

#include <system_error>

namespace patchlight::server {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds patience(60);  // with gnuplot, which needs less than one
constexpr const char* drawings[] = {"chart.svg", "chart.png"};

std::string title_of(const Chart& chart, const ChartOrigin& origin) {
    return fs::path(origin.scene).filename().string() + ", " + std::to_string(chart.threads) +
           (chart.threads == 1 ? " thread" : " threads") +
           (origin.processor.empty() ? "" : " of " + origin.processor);
}

}  // namespace

void prepare_directory(const std::string& option, const fs::path& directory) {
    if (directory.empty()) throw WrongInput(option + ": the name is empty");
    std::error_code failure;
    if (!fs::is_directory(directory, failure)) {
        if (fs::exists(directory, failure))
            throw WrongInput(option + " " + directory.string() + ": is no directory");
        if (!fs::create_directory(directory, failure))
            throw WrongInput(option + " " + directory.string() +
                             ": cannot be made: " + failure.message());
    }
    require_writable(option, (directory / "chart.csv").string());
}

std::string write_chart_files(const Chart& chart, const ChartOrigin& origin,
                              const fs::path& directory) {
    const auto write = [&](const char* name, std::string_view bytes) {
        raster::write_whole(directory / name, bytes);
    };
    for (const char* name : drawings) fs::remove(directory / name);
    write_output((directory / "chart.csv").string(),
                 [&](const TextSink& sink) { write_chart_csv(chart, sink); });
    write("chart.json", result_text(chart_json(chart, origin)));
    const std::string title = title_of(chart, origin);
    write("chart.gp", gnuplot_script(chart, title));
    const GnuplotRun svg = run_gnuplot(gnuplot_script(chart, title, Plot::svg), patience);
    write("chart.html", report_html(chart, origin, svg.output, svg.problem));
    if (!svg.problem.empty()) return svg.problem;
    write(drawings[0], svg.output);
    const GnuplotRun png = run_gnuplot(gnuplot_script(chart, title, Plot::png), patience);
    if (png.problem.empty()) write(drawings[1], png.output);
    return png.problem;
}

}  // namespace patchlight::server
