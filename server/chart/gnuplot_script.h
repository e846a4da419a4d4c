#pragma once

#include "server/chart/chart.h"

#include <cstdint>
#include <string>

namespace patchlight::server {

enum class Plot : std::uint8_t { svg, png };

/// Errors over seconds, both logarithmic: a series each solver and kind of form factors, in the
/// colours of Okabe & Ito, "Color Universal Design", 2008, told apart by marks and dashes too; the
/// front of all of them; the reference's own error as the floor. The script holds its data and
/// writes to standard output.
std::string gnuplot_script(const Chart& chart, const std::string& title, Plot plot);

/// The same for both, into chart.svg and chart.png: for users who want to change it.
std::string gnuplot_script(const Chart& chart, const std::string& title);

}  // namespace patchlight::server
