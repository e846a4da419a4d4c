#include "server/files/text_lines.h"

#include "server/wording.h"
#include "solver/scene/input_error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace patchlight::server {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

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

/// Makes the next line the statement, as it stands.
void TextLines::read_line() {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    const std::string_view line = text_.substr(0, end);
    statement_ = trimmed(line.substr(0, line.find('#')));
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++lines_read_;
}

bool TextLines::next() {
    statement_ = {};
    while (statement_.empty() && !text_.empty()) {
        read_line();
        line_ = lines_read_;
        if (!statement_.ends_with('\\')) continue;
        joined_.clear();
        while (statement_.ends_with('\\')) {
            joined_.append(statement_.substr(0, statement_.size() - 1)).append(" ");
            read_line();
        }
        statement_ = trimmed(joined_.append(statement_));
    }
    return !statement_.empty();
}

std::string_view TextLines::word() {
    const std::string_view found = statement_.substr(0, statement_.find_first_of(blanks));
    statement_ = trimmed(statement_.substr(found.size()));
    return found;
}

std::string_view TextLines::rest() const { return statement_; }

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
