#pragma once

#include "solver/scene/input_error.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace patchlight::server {

/// What a number must lie in. An open end is not part of it.
struct Range {
    double low;
    double high;
    bool low_open = false;
    bool high_open = false;
};

/// A value of the input together with where it stands, so that whatever is wrong with it can be
/// said with its JSON pointer. The one way to read input: every accessor checks the type, and
/// throws InputError. It refers to its parent, which has to outlive it: hence no copies.
class JsonValue {
  public:
    explicit JsonValue(const nlohmann::json& document) : value_(document) {}
    JsonValue(const nlohmann::json& value, const JsonValue& parent, std::string_view key)
        : value_(value), parent_(&parent), key_(key) {}
    JsonValue(const nlohmann::json& value, const JsonValue& parent, std::size_t index)
        : value_(value), parent_(&parent), index_(index) {}
    JsonValue(const JsonValue&) = delete;
    JsonValue& operator=(const JsonValue&) = delete;

    std::string pointer() const;
    [[noreturn]] void reject(const std::string& detail) const;

    bool is_array() const { return value_.is_array(); }
    bool is_number() const { return value_.is_number(); }

    /// An object without any other key than `known`.
    void require_object(std::initializer_list<const char*> known) const;
    /// An object whose keys are names of the author's choice.
    void require_map() const;
    bool has(std::string_view key) const { return value_.contains(key); }
    JsonValue at(std::string_view key) const&;  // throws if there is none
    std::optional<JsonValue> find(std::string_view key) const&;
    /// Calls visit(name, value) for each member of a map, by name.
    template <typename Visit>
    void for_each_member(const Visit& visit) const {
        require_map();
        for (const auto& [name, member] : value_.items())
            visit(name, JsonValue(member, *this, name));
    }

    /// Number of elements of an array.
    std::size_t size() const;
    JsonValue operator[](std::size_t index) const&;
    /// Calls visit(element) for each element of an array.
    template <typename Visit>
    void for_each_element(const Visit& visit) const {
        for (std::size_t k = 0; k < size(); ++k) visit((*this)[k]);
    }

    double number(const Range& range) const;
    std::int64_t whole_number(std::int64_t low, std::int64_t high) const;
    std::uint64_t unsigned_number() const;
    bool boolean() const;
    const std::string& text() const;
    /// A text of 1 to 256 bytes without control characters.
    const std::string& name() const;
    /// Throws unless `name`, a text or the key of this value, would do as a name.
    void require_name(const std::string& name) const;

    JsonValue at(std::string_view key) const&& = delete;
    std::optional<JsonValue> find(std::string_view key) const&& = delete;
    JsonValue operator[](std::size_t index) const&& = delete;

  private:
    [[noreturn]] void reject_type(const std::string& wanted) const;

    const nlohmann::json& value_;
    const JsonValue* parent_ = nullptr;
    std::string_view key_;
    std::size_t index_ = 0;
};

}  // namespace patchlight::server
