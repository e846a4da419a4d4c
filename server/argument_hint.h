#pragma once

#include <string>

namespace CLI {
class App;
}

namespace patchlight::server {

/// What is wrong with arguments that name a command or an option that does not exist, such as
/// "unknown option '--patchsize'; did you mean '--patch-size'?". Empty if all exist.
std::string unknown_argument(const CLI::App& program, int count, const char* const* arguments);

/// What is wrong where an option stands in place of the value that another is due, such as
/// "--stats: needs FILE after it, not the option '--quiet'". Empty if none does. It would be taken
/// for the value, and a file of that name be written.
std::string option_for_value(const CLI::App& program, int count, const char* const* arguments);

}  // namespace patchlight::server
