#pragma once

#include "server/run_job.h"

#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// The files a solve is to write. "-" is standard output, for text alone.
struct SolveOutputs {
    std::vector<std::string> images;     // their formats are told by their names
    std::optional<std::string> stats;    // result JSON
    std::optional<std::string> sensors;  // CSV
    std::optional<std::string> patches;  // CSV
    std::optional<std::string> mesh;     // GLB

    std::vector<std::string> paths() const;
    bool none() const { return images.empty() && !stats && !sensors && !patches && !mesh; }
};

/// The formats of the images. Throws WrongInput unless every output can be made, as far as can be
/// seen before any work is done, and no two are the same file.
std::vector<ImageFormat> checked_formats(const SolveOutputs& outputs);

/// Throws WrongInput if an output asks for what the scene does not have.
void require_in_scene(const SolveOutputs& outputs, const Scene& scene, const std::string& file);

/// Writes all of them; of images those that were made. What cannot be written does not keep the
/// others from being written: the first failure is thrown at the end. `exposure` is the mesh's;
/// empty: from the solution [stops].
void write_outputs(const SolveOutputs& outputs, std::optional<double> exposure, const Job& job,
                   const JobResult& result);

}  // namespace patchlight::server
