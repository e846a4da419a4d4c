#pragma once

#include "server/run_job.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace patchlight::server {

/// The options of `solve` that say how pictures are taken.
class PictureOptions {
  public:
    /// Has to outlive the command, which writes into it. `image` is the option that asks for
    /// pictures: without it the others mean nothing. `scene` is what a word after --false-colour is
    /// taken for if it is no range.
    void add_to(CLI::App& command, CLI::Option& image, CLI::Option& scene);

    /// Throws WrongInput if an option means nothing to what is asked for.
    void check(const std::vector<ImageFormat>& formats, bool is_mesh_wanted) const;

    /// Of what is made to be looked at; empty: from the solution [stops].
    std::optional<double> exposure() const { return exposure_; }

    /// What is to be taken of the scene read from `file`; nothing if there are no formats. Throws
    /// WrongInput if the camera is not there. What the job says of the camera is made to agree.
    std::vector<PictureRequest> requests(const std::vector<ImageFormat>& formats,
                                         const std::string& file, Job& job) const;

  private:
    void take_false_colour(const std::vector<std::string>& words, CLI::Option& scene);
    NamedCamera& chosen_camera(const std::string& file, Job& job) const;

    std::optional<std::string> camera_;
    std::optional<std::string> size_;
    std::optional<double> exposure_;
    std::optional<FalseColourRequest> false_colour_;
};

}  // namespace patchlight::server
