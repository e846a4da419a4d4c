#pragma once

#include "server/run_job.h"
#include "server/trace/step_pictures.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace patchlight::server {

/// The options of `solve` that ask for its steps to be shown.
class TraceOptions {
  public:
    /// Has to outlive the command, which writes into it.
    void add_to(CLI::App& command);

    bool is_asked() const { return directory_.has_value(); }

    /// Makes the directory. Throws WrongInput if there is none that could be written to.
    void prepare() const;

    /// The camera that pictures are taken with: that of the requests, else the job's first, of 512
    /// pixels an edge at most.
    static NamedCamera camera(const Job& job, const std::vector<PictureRequest>& requests);

    /// Writes all files. Throws WrongInput if there is no patch of the number asked for, and
    /// std::system_error naming the file.
    void write(const Job& job, const JobResult& result, const std::string& scene,
               const NamedCamera& camera, std::optional<double> exposure,
               const StepPictures& steps) const;

  private:
    std::optional<std::string> directory_;
    std::optional<PatchIndex> patch_;
};

}  // namespace patchlight::server
