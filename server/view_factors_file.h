#pragma once

#include "server/view_factors.h"

#include <string>

namespace patchlight::server {

/// Throws WrongInput unless view factors can be written to `path`, as far as can be seen before any
/// work is done: "-" is standard output, which takes CSV; else the name ends in .csv, .json or
/// .mtx.
void check_view_factors_output(const std::string& option, const std::string& path);

/// Writes them in the format that the name tells, all of them or, if something is thrown on the
/// way, none. Throws what `rows` throws, and std::system_error naming the file.
void write_view_factors(const std::string& path, const ViewFactorGroups& groups,
                        const ViewFactorRows& rows);

}  // namespace patchlight::server
