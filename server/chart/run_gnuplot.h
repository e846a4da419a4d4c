#pragma once

#include <chrono>
#include <string>

namespace patchlight::server {

/// What a run of gnuplot gave: its output, or a sentence on why there is none.
struct GnuplotRun {
    std::string output;
    std::string problem;  // empty: all is well
};

/// Runs the gnuplot that PATH leads to on a script, without a shell and without its user's own
/// settings. It is ended if it takes longer than that.
GnuplotRun run_gnuplot(const std::string& script, std::chrono::seconds most);

}  // namespace patchlight::server
