#include "server/json_document.h"

#include "server/json_pointer.h"
#include "server/wording.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace patchlight::server {
namespace {

JsonError error_at(JsonFault fault, std::string_view bytes, std::size_t offset,
                   const std::string& detail) {
    const std::string_view before = bytes.substr(0, std::min(offset, bytes.size()));
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t newline = before.rfind('\n');
    const std::size_t line_begin = newline == std::string_view::npos ? 0 : newline + 1;
    return {fault, TextPlace{before.size(), line, before.size() - line_begin + 1}, detail};
}

/// The parser's message without its code, its position and the bytes it quotes, which may be
/// anything.
std::string plain_message(std::string message) {
    if (const auto code_end = message.find("] "); code_end != std::string::npos)
        message.erase(0, code_end + 2);
    if (message.starts_with("parse error"))
        if (const auto position_end = message.find(": "); position_end != std::string::npos)
            message.erase(0, position_end + 2);
    if (const auto quote = message.find("; last read"); quote != std::string::npos)
        message.erase(quote);
    return message;
}

bool is_in(const std::string& message, std::string_view words) {
    return message.find(words) != std::string::npos;
}

/// The last letter before a place that is no blank; 0 if there is none.
char letter_before(std::string_view bytes, std::size_t offset) {
    const std::size_t last = bytes.substr(0, offset).find_last_not_of(" \t\r\n");
    return last == std::string_view::npos ? '\0' : bytes[last];
}

/// Where the word begins whose end the parser complains of.
std::size_t begin_of_word(std::string_view bytes, std::size_t offset, const std::string& message) {
    std::size_t begin = std::min(offset, bytes.size());
    if (is_in(message, "unexpected string literal") && begin > 0 && begin < bytes.size()) {
        const std::size_t quote = bytes.rfind('"', begin - 1);
        return quote == std::string_view::npos ? begin : quote;
    }
    const auto is_word = [](char letter) {
        return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z') ||
               (letter >= 'A' && letter <= 'Z') || letter == '.' || letter == '-' || letter == '+';
    };
    while (begin > 0 && begin < bytes.size() && is_word(bytes[begin]) && is_word(bytes[begin - 1]))
        --begin;
    return begin;
}

/// What would be right, where a common slip explains what the parser met.
std::string remedy_of(const std::string& message, std::string_view bytes, std::size_t offset) {
    const std::string_view rest = bytes.substr(std::min(offset, bytes.size()));
    const char before = letter_before(bytes, begin_of_word(bytes, offset, message));
    const bool at_end = is_in(message, "unexpected end of input");
    if (at_end && is_in(message, "missing closing quote")) return "";
    if (at_end) return "; the document ends too early: a closing } or ] is missing";
    if (before == ',' && (rest.starts_with('}') || rest.starts_with(']')))
        return "; no comma may stand before a closing bracket";
    const bool is_separator = is_in(message, "expected ']'") || is_in(message, "expected '}'");
    const bool is_value = is_in(message, "unexpected string literal") ||
                          is_in(message, "unexpected number literal") ||
                          is_in(message, "unexpected '['") || is_in(message, "unexpected '{'") ||
                          is_in(message, "unexpected true") || is_in(message, "unexpected false");
    if (is_separator && is_value) return "; a comma is missing before this";
    if (is_in(message, "expected ':'") || is_in(message, "object separator"))
        return "; a colon must stand between a key and its value";
    const std::string_view word = bytes.substr(begin_of_word(bytes, offset, message));
    if (word.starts_with("//") || word.starts_with("/*") || word.starts_with('/') ||
        word.starts_with('#'))
        return "; JSON has no comments";
    if (word.starts_with('\'')) return "; texts stand in double quotes";
    for (const std::string_view no_number : {"NaN", "nan", "Infinity", "inf", "-inf", "-Infinity"})
        if (word.starts_with(no_number)) return "; every number must be finite";
    for (const std::string_view capital : {"True", "False", "None", "TRUE", "FALSE"})
        if (word.starts_with(capital)) return "; write true, false or null in small letters";
    if (is_in(message, "expected string literal") || is_in(message, "object key"))
        return "; a key stands in double quotes";
    return "";
}

/// The parser has one code for all it finds wrong; its words tell more.
JsonFault fault_of(const std::string& message) {
    for (const char* const word : {"UTF-8", "surrogate"})
        if (message.find(word) != std::string::npos) return JsonFault::encoding;
    return JsonFault::syntax;
}

/// Builds the document while it counts depth, values and keys.
class DocumentBuilder : public nlohmann::json_sax<nlohmann::json> {
  public:
    DocumentBuilder(std::string_view bytes, const JsonLimits& limits)
        : bytes_(bytes), limits_(limits) {}
    ~DocumentBuilder() override { dismantle(root_); }
    DocumentBuilder(const DocumentBuilder&) = delete;
    DocumentBuilder& operator=(const DocumentBuilder&) = delete;

    nlohmann::json take() { return std::move(root_); }

    bool null() override { return add(nullptr); }
    bool boolean(bool flag) override { return add(flag); }
    bool number_integer(number_integer_t number) override { return add(number); }
    bool number_unsigned(number_unsigned_t number) override { return add(number); }
    bool number_float(number_float_t number, const string_t&) override { return add(number); }
    bool string(string_t& text) override { return add(std::move(text)); }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(nlohmann::json::object()); }
    bool start_array(std::size_t) override { return open(nlohmann::json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        if (name.size() > limits_.key_bytes)
            throw JsonError(JsonFault::too_large, pointer(),
                            "a key of " + std::to_string(name.size()) +
                                " bytes is too long; the limit is " +
                                std::to_string(limits_.key_bytes));
        levels_.back().key = name;
        if (levels_.back().container->contains(name))
            throw JsonError(JsonFault::duplicate_key, pointer(),
                            "key " + in_quotes(name) + " is given twice");
        return true;
    }

    bool parse_error(std::size_t position, const std::string&,
                     const nlohmann::detail::exception& failure) override {
        constexpr int number_overflow = 406;  // the library's code for 1e999
        const std::size_t offset = position > 0 ? position - 1 : 0;
        if (failure.id == number_overflow)
            throw error_at(JsonFault::number_range, bytes_, offset, "number out of range");
        const std::string message = plain_message(failure.what());
        throw error_at(fault_of(message), bytes_, offset,
                       message + remedy_of(message, bytes_, offset));
    }

  private:
    struct Level {
        nlohmann::json* container;
        std::string key;  // the one whose value is being read, in an object
    };

    template <typename Value>
    bool add(Value&& value) {
        place(nlohmann::json(std::forward<Value>(value)));
        return true;
    }

    bool open(nlohmann::json container) {
        levels_.push_back({place(std::move(container)), {}});
        if (levels_.size() > limits_.depth)
            throw JsonError(JsonFault::too_deep, pointer(),
                            "nested deeper than " + std::to_string(limits_.depth) + " levels");
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    nlohmann::json* place(nlohmann::json value) {
        if (++values_ > limits_.values)
            throw JsonError(
                JsonFault::too_large, "",
                "more than " + std::to_string(limits_.values) + " values in one document");
        if (levels_.empty()) {
            root_ = std::move(value);
            return &root_;
        }
        nlohmann::json& container = *levels_.back().container;
        if (container.is_array()) {
            container.push_back(std::move(value));
            return &container.back();
        }
        nlohmann::json& member = container[levels_.back().key];
        member = std::move(value);
        return &member;
    }

    std::string pointer() const {
        std::string text;
        for (const Level& level : levels_) {
            if (level.container->is_object() && !level.key.empty())
                text += '/' + escaped_for_pointer(level.key);
            else if (level.container->is_array() && !level.container->empty())
                text += '/' + std::to_string(level.container->size() - 1);
        }
        return text;
    }

    std::string_view bytes_;
    JsonLimits limits_;
    nlohmann::json root_;
    std::vector<Level> levels_;
    std::size_t values_ = 0;
};

void check_bytes(std::string_view bytes, const JsonLimits& limits) {
    if (bytes.size() > limits.bytes)
        throw JsonError(JsonFault::too_large, "",
                        "the document has " + std::to_string(bytes.size()) +
                            " bytes; the limit is " + std::to_string(limits.bytes));
    if (bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE"))
        throw JsonError(JsonFault::encoding, "", "must be UTF-8, not UTF-16");
    if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos)
        throw JsonError(JsonFault::syntax, "", "the document is empty");
    if (const auto nul = bytes.find('\0'); nul != std::string_view::npos)
        throw error_at(JsonFault::encoding, bytes, nul, "a NUL byte is not JSON");
}

}  // namespace

void dismantle(nlohmann::json& document) noexcept {
    for (nlohmann::json& element : document)
        if (element.is_structured()) dismantle(element);
    if (document.is_structured()) document.clear();
}

nlohmann::json parse_json(std::string_view bytes, const JsonLimits& limits) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
    check_bytes(bytes, limits);
    DocumentBuilder builder(bytes, limits);
    nlohmann::json::sax_parse(bytes, &builder);
    return builder.take();
}

}  // namespace patchlight::server
