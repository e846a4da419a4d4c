#pragma once

#include "solver/scene/input_error.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string_view>

namespace patchlight::server {

/// What one document may hold; beyond it is refused before the memory is spent.
struct JsonLimits {
    std::size_t bytes = std::size_t{64} << 20;  // of the text [bytes]
    std::size_t depth = 64;                     // arrays and objects inside one another
    std::size_t values = 20'000'000;            // at 16 bytes and more each
    std::size_t key_bytes = 256;                // of one key [bytes]
};

/// The bytes are not a JSON document: told apart from a scene that is wrong, because HTTP answers
/// 400 to the one and 422 to the other. `line` is 0 where a pointer names the place instead.
class JsonError : public InputError {
  public:
    JsonError(std::string pointer, const std::string& detail)
        : InputError(std::move(pointer), detail) {}
    JsonError(std::size_t line, std::size_t column, const std::string& detail)
        : InputError("", detail), line_(line), column_(column) {}
    std::size_t line() const { return line_; }
    std::size_t column() const { return column_; }  // in bytes, from 1

  private:
    std::size_t line_ = 0;
    std::size_t column_ = 0;
};

/// Strict JSON: UTF-8 (a byte order mark is allowed), no duplicate keys, no number that a double
/// cannot hold. Throws JsonError.
nlohmann::json parse_json(std::string_view bytes, const JsonLimits& limits = {});

}  // namespace patchlight::server
