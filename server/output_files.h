#pragma once

#include <string>
#include <vector>

namespace patchlight::server {

/// Throws WrongInput unless a file of that name can be made, as far as can be seen without making
/// it: before hours of work, not after. Not all obstacles can be seen: the disk may fill up.
void require_writable(const std::string& option, const std::string& path);

/// Throws WrongInput if two outputs would be the same file.
void require_different(const std::vector<std::string>& paths);

}  // namespace patchlight::server
