#pragma once

#include "server/job.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace patchlight::server {

/// The settings of a solve as options of a command. What is given is laid over the scene's block
/// `solve`.
class SettingsOptions {
  public:
    /// Has to outlive the command, which writes into it. Where nothing is `solved`, what steers the
    /// solver alone is understood but not shown.
    void add_to(CLI::App& command, bool solved = true);

    /// Throws WrongInput that names the option.
    void lay_over(Job& job) const;

    /// As naming_file, but what an option gave is blamed on the option, not on the file.
    void naming_culprit(const std::string& file, const std::function<void()>& work) const;

  private:
    void add(CLI::App& command, const std::string& option, const std::string& meaning,
             bool is_number, bool is_shown = true);

    std::optional<std::string> culprit(const std::string& pointer) const;

    nlohmann::json block_ = nlohmann::json::object();  // as it would stand in a scene
    int threads_ = 0;
};

}  // namespace patchlight::server
