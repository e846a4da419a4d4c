#pragma once

#include <string>

namespace patchlight::server {

/// Where a chart comes from: what its reader has to know to make it again.
struct ChartOrigin {
    std::string scene;      // file
    std::string command;    // as a shell takes it
    std::string processor;  // model, empty if the machine does not tell
    int cores = 1;          // hardware threads
    std::string version;    // of the program
};

ChartOrigin describe_origin(const std::string& scene, const std::string& directory,
                            double time_limit);

/// A word as a POSIX shell takes it: in quotes where it needs them.
std::string shell_word(const std::string& word);

}  // namespace patchlight::server
