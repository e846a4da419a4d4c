#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace patchlight::stability {

/// A table of a Markdown document: every row has as many cells as the head.
struct MarkdownTable {
    std::vector<std::string> head;
    std::vector<std::vector<std::string>> rows;
};

std::string markdown(const MarkdownTable& table);

/// The table between "<!-- begin NAME -->" and "<!-- end NAME -->"; empty if there is none.
MarkdownTable table_in(const std::string& document, const std::string& name);

/// The document with that table put in place of the one it holds. Throws std::runtime_error if the
/// two marks are not there.
std::string with_table(const std::string& document, const std::string& name,
                       const MarkdownTable& table);

/// Two significant digits.
std::string figure(double value);

/// Where a committed table says something else than the run does, in words; rows are told apart by
/// their first `keys` cells. Words must be equal, and figures within a factor of 2, unless both are
/// below 1e-5; where both say "holds" none is compared, as any that is small enough is right, and
/// where one "holds" and one "degrades" the figures decide: another machine rounds a close call the
/// other way. Columns headed "seconds" are not compared.
enum class Rows : std::uint8_t { must_be_the_same, may_differ };
std::vector<std::string> disagreements(const MarkdownTable& committed, const MarkdownTable& found,
                                       std::size_t keys, Rows rows = Rows::must_be_the_same);

}  // namespace patchlight::stability
