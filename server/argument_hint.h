#pragma once

#include <string>

namespace CLI {
class App;
}

namespace patchlight::server {

/// What is wrong with arguments that name a command or an option that does not exist, such as
/// "unknown option '--patchsize'; did you mean '--patch-size'?". Empty if all exist.
std::string unknown_argument(const CLI::App& program, int count, const char* const* arguments);

}  // namespace patchlight::server
