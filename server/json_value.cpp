#include "server/json_value.h"

#include "server/json_pointer.h"
#include "server/wording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

namespace patchlight::server {
namespace {

std::string type_name(const nlohmann::json& value) {
    using Type = nlohmann::json::value_t;
    switch (value.type()) {
        case Type::null:
            return "null";
        case Type::object:
            return "an object";
        case Type::array:
            return "an array";
        case Type::string:
            return "a text";
        case Type::boolean:
            return "true or false";
        case Type::number_integer:
        case Type::number_unsigned:
        case Type::number_float:
            return "a number";
        case Type::binary:
        case Type::discarded:
            break;
    }
    throw std::logic_error("JSON text has no such type");
}

/// "; write 0.5 without quotes" where a text is a number all the same, a percentage for instance.
std::string number_meant(std::string_view text) {
    const auto is_blank = [](char letter) { return letter == ' ' || letter == '\t'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    std::string plain(text.substr(text.starts_with('+') ? 1 : 0));
    if (std::count(plain.begin(), plain.end(), ',') == 1 && plain.find('.') == plain.npos)
        std::replace(plain.begin(), plain.end(), ',', '.');
    double number = 0.0;
    const char* const end = plain.data() + plain.size();
    const auto read = std::from_chars(plain.data(), end, number);
    if (read.ec != std::errc() || !std::isfinite(number)) return "";
    std::string_view unit(read.ptr, static_cast<std::size_t>(end - read.ptr));
    while (!unit.empty() && is_blank(unit.front())) unit.remove_prefix(1);
    if (unit.empty()) return "; write " + number_text(number) + " without quotes";
    if (unit == "%") return "; write " + number_text(number / 100.0) + ", without quotes and %";
    return "; write " + number_text(number) + ", without a unit: `units` say what it is in";
}

std::string range_text(const Range& range) {
    const std::string low = (range.low_open ? "above " : "at least ") + number_text(range.low);
    const std::string high = (range.high_open ? "below " : "at most ") + number_text(range.high);
    if (!std::isfinite(range.high)) return low;
    if (!std::isfinite(range.low)) return high;
    return low + " and " + high;
}

/// A share in per cent where one of 1 is due.
std::string share_meant(const Range& range, double number) {
    const bool is_share = range.low == 0.0 && range.high == 1.0;
    if (!is_share || !(number > 1.0 && number < 100.0)) return "";
    return "; " + number_text(number) + " % is " + number_text(number / 100.0);
}

bool contains(const Range& range, double number) {
    return (range.low_open ? number > range.low : number >= range.low) &&
           (range.high_open ? number < range.high : number <= range.high);
}

/// What was probably meant by a value of the wrong type.
std::string type_hint(const nlohmann::json& value, const std::string& wanted) {
    if (wanted == "a number" && value.is_string())
        return number_meant(value.get_ref<const std::string&>());
    if (wanted == "a number" && value.is_array() && value.size() == 1 && value[0].is_number())
        return "; write " + value[0].dump() + " without brackets";
    if (wanted == "true or false" && value.is_string() && (value == "true" || value == "false"))
        return "; write " + value.get<std::string>() + " without quotes";
    if (wanted == "true or false" && value.is_number() && (value == 0 || value == 1))
        return value == 0 ? "; write false" : "; write true";
    if (wanted == "an array" && value.is_object() && !value.empty()) return "; write [ ] around it";
    return "";
}

}  // namespace

std::string JsonValue::pointer() const {
    if (!parent_) return "";
    const bool is_element = parent_->is_array();
    return parent_->pointer() + '/' +
           (is_element ? std::to_string(index_) : escaped_for_pointer(key_));
}

void JsonValue::reject(const std::string& detail) const { throw InputError(pointer(), detail); }

void JsonValue::reject_type(const std::string& wanted) const {
    reject("must be " + wanted + ", not " + type_name(value_) + type_hint(value_, wanted));
}

void JsonValue::require_map() const {
    if (!value_.is_object()) reject_type("an object");
}

void JsonValue::require_object(std::initializer_list<const char*> known) const {
    require_map();
    const std::vector<std::string> known_keys(known.begin(), known.end());
    for (const auto& [key, member] : value_.items())
        if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end())
            JsonValue(member, *this, key)
                .reject("unknown key " + in_quotes(key) + suggestion(key, known_keys));
}

JsonValue JsonValue::at(std::string_view key) const& {
    const auto member = value_.find(key);
    if (member == value_.end()) reject("needs " + in_quotes(key));
    return {*member, *this, key};
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const& {
    const auto member = value_.find(key);
    if (member == value_.end()) return std::nullopt;
    return std::optional<JsonValue>(std::in_place, *member, *this, key);
}

std::size_t JsonValue::size() const {
    if (!value_.is_array()) reject_type("an array");
    return value_.size();
}

JsonValue JsonValue::operator[](std::size_t index) const& { return {value_[index], *this, index}; }

double JsonValue::number(const Range& range) const {
    if (!value_.is_number()) reject_type("a number");
    const double number = value_.get<double>();
    if (!std::isfinite(number)) reject("must be finite");
    if (!contains(range, number))
        reject("must be " + range_text(range) + ", not " + number_text(number) +
               share_meant(range, number));
    return number;
}

std::int64_t JsonValue::whole_number(std::int64_t low, std::int64_t high) const {
    constexpr double exact = 9007199254740992.0;  // 2^53: whole numbers below are exact in a double
    const double number = this->number({-exact, exact});
    if (number != std::floor(number)) reject("must be a whole number, not " + number_text(number));
    const auto whole = static_cast<std::int64_t>(number);
    if (whole < low || whole > high)
        reject("must be from " + std::to_string(low) + " to " + std::to_string(high) + ", not " +
               std::to_string(whole));
    return whole;
}

std::uint64_t JsonValue::unsigned_number() const {
    if (!value_.is_number()) reject_type("a number");
    if (value_.is_number_unsigned()) return value_.get<std::uint64_t>();
    const double number = value_.get<double>();
    const double beyond = std::ldexp(1.0, 64);
    if (number >= 0 && number < beyond && number == std::floor(number))
        return static_cast<std::uint64_t>(number);
    reject("must be a whole number from 0 to 18446744073709551615, not " + number_text(number));
}

bool JsonValue::boolean() const {
    if (!value_.is_boolean()) reject_type("true or false");
    return value_.get<bool>();
}

const std::string& JsonValue::text() const {
    if (!value_.is_string()) reject_type("a text");
    return value_.get_ref<const std::string&>();
}

const std::string& JsonValue::name() const {
    require_name(text());
    return text();
}

void JsonValue::require_name(const std::string& name) const {
    constexpr std::size_t longest = 256;
    if (name.empty()) reject("a name must not be empty");
    if (name.size() > longest)
        reject("a name of " + std::to_string(name.size()) + " bytes is too long; the limit is " +
               std::to_string(longest));
    const auto is_control = [](unsigned char byte) { return byte < 0x20 || byte == 0x7F; };
    if (std::any_of(name.begin(), name.end(), is_control))
        reject("a name must not have control characters");
}

}  // namespace patchlight::server
