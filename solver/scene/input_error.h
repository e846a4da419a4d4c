#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace patchlight {

/// The input is wrong: where (a JSON pointer such as "/objects/3/polygon", or file:line) and what
/// would be right. The command line turns it into exit code 2.
class InputError : public std::runtime_error {
  public:
    InputError(std::string pointer, const std::string& detail)
        : std::runtime_error(detail), pointer_(std::move(pointer)) {}
    const std::string& pointer() const { return pointer_; }

  private:
    std::string pointer_;
};

}  // namespace patchlight
