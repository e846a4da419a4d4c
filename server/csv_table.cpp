#include "server/csv_table.h"

#include <charconv>
#include <utility>

namespace patchlight::server {
namespace {

constexpr std::size_t piece = std::size_t{1} << 16;  // handed on when there is so much [bytes]

template <class Number>
void append_number(std::string& text, Number number) {
    char digits[32];
    const auto written = std::to_chars(digits, digits + sizeof digits, number);
    text.append(digits, written.ptr);
}

void append_field(std::string& table, std::string_view text) {
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
        table += text;
        return;
    }
    table += '"';
    for (const char character : text) table.append(character == '"' ? 2 : 1, character);
    table += '"';
}

}  // namespace

std::string csv_field(std::string_view text) {
    std::string field;
    append_field(field, text);
    return field;
}

CsvTable::CsvTable(std::string_view header, TextSink sink)
    : sink_(std::move(sink)), pending_(header) {
    pending_ += '\n';
}

CsvTable& CsvTable::text(std::string_view field) {
    begin_field();
    append_field(pending_, field);
    return *this;
}

CsvTable& CsvTable::number(double field) {
    begin_field();
    append_number(pending_, field + 0.0);  // -0 is written as 0
    return *this;
}

CsvTable& CsvTable::number(std::size_t field) {
    begin_field();
    append_number(pending_, field);
    return *this;
}

CsvTable& CsvTable::numbers(const Vec3& fields) {
    return number(fields[0]).number(fields[1]).number(fields[2]);
}

CsvTable& CsvTable::numbers(const Rgb& fields) {
    return number(fields[0]).number(fields[1]).number(fields[2]);
}

void CsvTable::end_row() {
    pending_ += '\n';
    is_first_ = true;
    if (pending_.size() >= piece) finish();
}

void CsvTable::finish() {
    sink_(pending_);
    pending_.clear();
}

void CsvTable::begin_field() {
    if (!is_first_) pending_ += ',';
    is_first_ = false;
}

}  // namespace patchlight::server
