#pragma once

#include "solver/scene/input_error.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace patchlight::server {

/// What one document may hold; beyond it is refused before the memory is spent.
struct JsonLimits {
    std::size_t bytes = std::size_t{64} << 20;  // of the text [bytes]
    std::size_t depth = 64;                     // arrays and objects inside one another
    std::size_t values = 20'000'000;            // at 16 bytes and more each
    std::size_t key_bytes = 256;                // of one key [bytes]
};

enum class JsonFault : std::uint8_t {
    syntax,
    encoding,
    number_range,
    duplicate_key,
    too_deep,
    too_large,
};

/// A place in a text.
struct TextPlace {
    std::size_t offset = 0;  // in bytes, from 0
    std::size_t line = 0;    // from 1
    std::size_t column = 0;  // in bytes, from 1
};

/// The bytes are not a JSON document: told apart from a scene that is wrong, because HTTP answers
/// 400 to the one and 422 to the other. `line` is 0 where a pointer names the place instead.
class JsonError : public InputError {
  public:
    JsonError(JsonFault fault, std::string pointer, const std::string& detail)
        : InputError(std::move(pointer), detail), fault_(fault) {}
    JsonError(JsonFault fault, const TextPlace& place, const std::string& detail)
        : InputError("", detail), fault_(fault), place_(place) {}
    JsonFault fault() const { return fault_; }
    std::size_t offset() const { return place_.offset; }
    std::size_t line() const { return place_.line; }
    std::size_t column() const { return place_.column; }

  private:
    JsonFault fault_;
    TextPlace place_;
};

/// Strict JSON: UTF-8 (a byte order mark is allowed), no duplicate keys, no number that a double
/// cannot hold. Throws JsonError.
nlohmann::json parse_json(std::string_view bytes, const JsonLimits& limits = {});

/// Empties a document from the inside out. Its own destructor takes memory, as much as the largest
/// array has, and ends the program if there is none: where memory has run out, this comes first.
void dismantle(nlohmann::json& document) noexcept;

}  // namespace patchlight::server
