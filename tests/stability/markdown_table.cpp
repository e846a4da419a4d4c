#include "tests/stability/markdown_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace patchlight::stability {

namespace {

constexpr double agreement = 2.0;    // between figures that agree
constexpr double negligible = 1e-5;  // below: rounding, which compilers and libraries may change

std::string line_of(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line += " " + cell + " |";
    return line + "\n";
}

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    for (std::size_t begin = 1, end; (end = line.find('|', begin)) != std::string::npos;
         begin = end + 1)
        cells.push_back(trimmed(line.substr(begin, end - begin)));
    return cells;
}

/// Where the table of that name begins and ends; npos if the marks are not there.
std::pair<std::size_t, std::size_t> place_of(const std::string& document, const std::string& name) {
    const std::string begin = "<!-- begin " + name + " -->\n", end = "<!-- end " + name + " -->";
    const std::size_t first = document.find(begin), last = document.find(end);
    if (first == std::string::npos || last == std::string::npos)
        return {std::string::npos, std::string::npos};
    return {first + begin.size(), last};
}

std::vector<std::string> words_of(const std::string& cell) {
    std::istringstream stream(cell);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

bool agree(const std::string& a, const std::string& b) {
    if (a == b) return true;
    char *end_a = nullptr, *end_b = nullptr;
    const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
    if (a.empty() || b.empty() || *end_a != '\0' || *end_b != '\0') return false;
    if (std::abs(x) < negligible && std::abs(y) < negligible) return true;
    return x * y > 0.0 && std::abs(x) <= agreement * std::abs(y) &&
           std::abs(y) <= agreement * std::abs(x);
}

bool cells_agree(const std::string& a, const std::string& b) {
    const std::vector<std::string> left = words_of(a), right = words_of(b);
    if (!left.empty() && !right.empty() && left[0] == "holds" && right[0] == "holds") return true;
    const auto measured = [](const std::vector<std::string>& words) {
        return words.size() == 2 && (words[0] == "holds" || words[0] == "degrades");
    };
    if (measured(left) && measured(right)) return agree(left[1], right[1]);
    return std::equal(left.begin(), left.end(), right.begin(), right.end(), agree);
}

std::string key_of(const std::vector<std::string>& row, std::size_t keys) {
    std::string key;
    for (std::size_t k = 0; k < keys; ++k) key += (k > 0 ? ", " : "") + row[k];
    return key;
}

}  // namespace

std::string markdown(const MarkdownTable& table) {
    std::string text = line_of(table.head);
    text += "|";
    for (std::size_t k = 0; k < table.head.size(); ++k) text += "---|";
    text += "\n";
    for (const auto& row : table.rows) text += line_of(row);
    return text;
}

MarkdownTable table_in(const std::string& document, const std::string& name) {
    const auto [first, last] = place_of(document, name);
    MarkdownTable table;
    if (first == std::string::npos) return table;
    std::istringstream lines(document.substr(first, last - first));
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line); ++number) {
        if (number == 0) table.head = cells_of(line);
        if (number > 1) table.rows.push_back(cells_of(line));
    }
    return table;
}

std::string with_table(const std::string& document, const std::string& name,
                       const MarkdownTable& table) {
    const auto [first, last] = place_of(document, name);
    if (first == std::string::npos) throw std::runtime_error("no place for the table " + name);
    return document.substr(0, first) + markdown(table) + document.substr(last);
}

std::string figure(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value == 0.0 ? 0.0 : value);  // no -0
    return text;
}

std::vector<std::string> disagreements(const MarkdownTable& committed, const MarkdownTable& found,
                                       std::size_t keys, Rows rows) {
    std::vector<std::string> told;
    const bool all = rows == Rows::must_be_the_same;
    if (committed.head != found.head) told.push_back("the heads of the columns differ");
    const auto row_like = [&](const MarkdownTable& table, const std::vector<std::string>& row) {
        return std::find_if(table.rows.begin(), table.rows.end(), [&](const auto& other) {
            return other.size() == row.size() && key_of(other, keys) == key_of(row, keys);
        });
    };
    for (const auto& row : committed.rows)
        if (row.size() != committed.head.size() ||
            (all && row_like(found, row) == found.rows.end()))
            told.push_back(key_of(row, std::min(keys, row.size())) + ": committed, but not found");
    for (const auto& row : found.rows) {
        const auto other = row_like(committed, row);
        if (other == committed.rows.end()) {
            if (all) told.push_back(key_of(row, keys) + ": found, but not committed");
            continue;
        }
        for (std::size_t k = keys; k < row.size(); ++k)
            if (found.head[k] != "seconds" && !cells_agree((*other)[k], row[k]))
                told.push_back(key_of(row, keys) + ": " + found.head[k] + " is \"" + row[k] +
                               "\", committed \"" + (*other)[k] + "\"");
    }
    return told;
}

}  // namespace patchlight::stability
