#pragma once

#include "server/run_job.h"
#include "server/trace/step_pictures.h"
#include "solver/patch_sight.h"

#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// All that a trace tells of.
struct Trace {
    const Job& job;
    const JobResult& result;
    std::string scene;          // name for people
    const NamedCamera& camera;  // all pictures are taken with
    double exposure = 0.0;      // and are exposed by [stops]
    const std::vector<StepPicture>& steps;
    std::optional<PatchSight> sight;  // empty if the work was interrupted
};

/// What one patch sees of the others after a solve, with a hemicube of the resolution in use, or of
/// 128 cells.
PatchSight trace_sight(const Job& job, const Solution& solution, std::optional<PatchIndex> patch);

/// Writes pictures, tables and index.html into a directory that is there, each file whole or not at
/// all, the page last. Throws std::system_error naming the file.
void write_trace(const std::string& directory, const Trace& trace);

/// Names of the files, as the page refers to them.
std::string step_file(const StepPicture& step, bool without_ambient);
std::string face_file(std::size_t face);

}  // namespace patchlight::server
