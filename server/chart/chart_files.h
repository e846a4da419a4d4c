#pragma once

#include "server/chart/chart.h"
#include "server/chart/chart_origin.h"

#include <filesystem>
#include <string>

namespace patchlight::server {

/// Makes the directory if it is not there. Throws WrongInput that names the option if it is not one
/// that can be written to.
void prepare_directory(const std::string& option, const std::filesystem::path& directory);

/// Writes chart.csv, chart.json, chart.gp, chart.html, and as far as gnuplot draws them chart.svg
/// and chart.png, each whole or not at all; those of an earlier chart are gone. Returns why there
/// is no drawing, empty if there is one. Throws std::system_error.
std::string write_chart_files(const Chart& chart, const ChartOrigin& origin,
                              const std::filesystem::path& directory);

}  // namespace patchlight::server
