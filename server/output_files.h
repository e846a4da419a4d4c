#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace patchlight::server {

/// Throws WrongInput unless a file of that name can be made, as far as can be seen without making
/// it: before hours of work, not after. Not all obstacles can be seen: the disk may fill up.
void require_writable(const std::string& option, const std::string& path);

/// Throws WrongInput unless the name ends in one of `endings`, in small letters or capitals; none
/// given allow any name. What is there and is no regular file, such as a pipe, is named as it is.
void require_ending(const std::string& option, const std::string& path,
                    std::initializer_list<std::string_view> endings);

/// Whether a name ends so, in small letters or capitals. `ending` is in small letters.
bool has_ending(std::string_view name, std::string_view ending);

/// Throws WrongInput if two outputs would be the same file, or both standard output ("-").
void require_different(const std::vector<std::string>& paths);

/// Throws WrongInput if an output is one of the files that were read.
void require_not_read(const std::vector<std::string>& outputs,
                      const std::vector<std::filesystem::path>& read);

}  // namespace patchlight::server
