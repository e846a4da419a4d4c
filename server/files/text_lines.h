#pragma once

#include "solver/scene/light.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace patchlight::server {

/// The statements of a text file such as OBJ or MTL, one after another, whatever its lines end in
/// (LF, CR LF or CR), with lines that end in a backslash joined to the next. A line that begins
/// with # is a comment, and so is what follows a # among words and numbers; a name may hold one
/// ("Material #112"). Throws InputError at "file:line".
class TextLines {
  public:
    /// `text` has to outlive it. `file` is how messages call it.
    TextLines(std::string_view text, std::string file);

    /// Goes on to the next statement that is not empty. Returns whether there is one.
    bool next();

    /// The next word of the statement; empty at its end and before a comment.
    std::string_view word();
    /// All that is left, from the first word to the last: a name, blanks and # included.
    std::string_view rest() const { return statement_; }
    bool at_end() const { return statement_.empty() || statement_.front() == '#'; }

    /// The next word as a finite number within ±`limit`.
    double number(double limit);
    Vec3 point(double limit);

    std::uint32_t line() const { return line_; }
    std::string place() const { return file_ + ":" + std::to_string(line_); }
    [[noreturn]] void reject(const std::string& detail) const;

  private:
    void read_line();
    bool goes_on() const;

    std::string_view text_;
    std::string file_;
    std::string joined_;          // where a statement goes over several lines
    std::string_view statement_;  // what is left of it
    std::uint32_t line_ = 0;      // on which it begins
    std::uint32_t lines_read_ = 0;
};

}  // namespace patchlight::server
