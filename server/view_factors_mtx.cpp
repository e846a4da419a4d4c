#include "server/view_factors_mtx.h"

#include "server/quick_numbers.h"
#include "server/text_buffer.h"

#include <cassert>
#include <string>

namespace patchlight::server {
namespace {

constexpr std::size_t count_width = 20;  // digits of the largest count there is

/// A name on one line, as long as the format allows lines to be.
std::string comment(std::size_t k, const std::string& name) {
    constexpr std::size_t longest_line = 1024;
    std::string line = "% " + std::to_string(k + 1) + " " + name;
    for (char& character : line)
        if (character == '\n' || character == '\r') character = ' ';
    return line.substr(0, longest_line - 1) + "\n";
}

std::string header(const ViewFactorGroups& groups) {
    std::string text =
        "%%MatrixMarket matrix coordinate real general\n"
        "% view factors: row from, column to\n";
    if (groups.names.empty()) text += "% row and column k are patch k - 1\n";
    for (std::size_t k = 0; k < groups.names.size(); ++k) text += comment(k, groups.names[k]);
    const std::string size = std::to_string(groups.areas.size());
    return text + size + " " + size + " ";
}

}  // namespace

void write_view_factors_mtx(const ViewFactorGroups& groups, const ViewFactorRows& rows,
                            const TextSink& sink, const OverwriteText& overwrite) {
    TextBuffer buffer(sink);
    buffer.append(header(groups));
    const std::uint64_t place_of_count = buffer.size();
    buffer.append(std::string(count_width, ' ') + "\n");
    std::uint64_t count = 0;
    rows([&](const ViewFactorRow& row) {
        assert(row.factor.size() == row.to.size());
        const std::string from = std::to_string(std::uint64_t{row.from} + 1) + " ";
        for (std::size_t k = 0; k < row.to.size(); ++k) {
            const auto factor = static_cast<float>(row.factor[k]);
            if (factor == 0.0F) continue;
            char* end = buffer.room(from.size() + 2 * longest_number + 2);
            end += from.copy(end, from.size());
            end = put_index(end, row.to[k] + 1);
            *end++ = ' ';
            end = put_float(end, factor);
            *end++ = '\n';
            buffer.end_at(end);
            ++count;
        }
    });
    buffer.finish();
    const std::string number = std::to_string(count);
    overwrite(place_of_count, std::string(count_width - number.size(), ' ') + number);
}

}  // namespace patchlight::server
