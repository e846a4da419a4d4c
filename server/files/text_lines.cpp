#include "server/files/text_lines.h"

#include "server/wording.h"
#include "solver/scene/input_error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace patchlight::server {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";
constexpr std::string_view word_ends = " \t\r\v\f#";

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

}  // namespace

TextLines::TextLines(std::string_view text, std::string file)
    : text_(without_byte_order_mark(text)), file_(std::move(file)) {}

/// Makes the next line the statement, as it stands; of a comment nothing is left.
void TextLines::read_line() {
    const std::size_t end = std::min(text_.find_first_of("\n\r"), text_.size());
    statement_ = trimmed(text_.substr(0, end));
    if (statement_.starts_with('#')) statement_ = {};
    text_.remove_prefix(end);
    text_.remove_prefix(text_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, text_.size()));
    ++lines_read_;
}

/// A comment may end as it likes.
bool TextLines::goes_on() const {
    return statement_.ends_with('\\') && statement_.find('#') == std::string_view::npos;
}

bool TextLines::next() {
    statement_ = {};
    while (statement_.empty() && !text_.empty()) {
        read_line();
        line_ = lines_read_;
        if (!goes_on()) continue;
        joined_.clear();
        while (goes_on()) {
            joined_.append(statement_.substr(0, statement_.size() - 1)).append(" ");
            read_line();
        }
        statement_ = trimmed(joined_.append(statement_));
    }
    return !statement_.empty();
}

std::string_view TextLines::word() {
    const std::string_view found = statement_.substr(0, statement_.find_first_of(word_ends));
    statement_ = trimmed(statement_.substr(found.size()));
    return found;
}

double TextLines::number(double limit) {
    const std::string_view given = word();
    if (given.empty()) reject("a number is missing");
    const char* const end = given.data() + given.size();
    double number = 0.0;
    const auto read = std::from_chars(given.data() + (given.front() == '+' ? 1 : 0), end, number);
    const bool out_of_range = read.ec == std::errc::result_out_of_range;
    if (read.ptr != end || (read.ec != std::errc() && !out_of_range))
        reject("must be a number, not " + in_quotes(given));
    const bool below_the_least = out_of_range && given.find_first_of("-", 1) != given.npos;
    if (below_the_least) return 0.0;
    if (std::isnan(number)) reject("must be a finite number, not " + in_quotes(given));
    if (out_of_range || std::abs(number) > limit)
        reject("must be within ±" + number_text(limit) + ", not " + in_quotes(given));
    return number;
}

Vec3 TextLines::point(double limit) {
    const double x = number(limit);
    const double y = number(limit);
    return {x, y, number(limit)};
}

void TextLines::reject(const std::string& detail) const { throw InputError(place(), detail); }

}  // namespace patchlight::server
