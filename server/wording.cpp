#include "server/wording.h"

#include "server/synonyms.h"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace patchlight::server {
namespace {

/// Levenshtein, "Binary codes capable of correcting deletions, insertions, and reversals", 1966,
/// with two neighbours swapped counted as one edit (Damerau).
std::size_t edit_distance(std::string_view from, std::string_view to) {
    std::vector<std::size_t> before_last;
    std::vector<std::size_t> last(to.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::vector<std::size_t> row(to.size() + 1, i + 1);
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = last[j] + (from[i] == to[j] ? 0 : 1);
            row[j + 1] = std::min({last[j + 1] + 1, row[j] + 1, replaced});
            if (i > 0 && j > 0 && from[i] == to[j - 1] && from[i - 1] == to[j])
                row[j + 1] = std::min(row[j + 1], before_last[j - 1] + 1);
        }
        before_last = std::move(last);
        last = std::move(row);
    }
    return last.back();
}

std::string lower_case(std::string_view text) {
    std::string lowered(text);
    for (char& character : lowered)
        if (character >= 'A' && character <= 'Z')
            character = static_cast<char>(character - 'A' + 'a');
        else if (character == '-' || character == ' ')
            character = '_';
    return lowered;
}

/// How far `known` is from what was asked, or more than it could be if it is no likely answer.
std::size_t unlikeness(std::string_view asked, std::string_view known) {
    const std::string asked_plain = lower_case(asked);
    const std::string known_plain = lower_case(known);
    const std::size_t distance = edit_distance(asked_plain, known_plain);
    const std::size_t allowed = std::max<std::size_t>(1, std::max(asked.size(), known.size()) / 3);
    if (distance <= allowed) return distance;
    constexpr std::size_t telling_part = 3;  // "fov" tells vertical_fov
    const bool contained =
        (asked.size() >= telling_part && known_plain.find(asked_plain) != std::string::npos) ||
        (known.size() >= telling_part && asked_plain.find(known_plain) != std::string::npos);
    return contained ? distance : std::string_view::npos;
}

}  // namespace

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::string shown = "'";
    for (std::size_t k = 0; k < text.size(); ++k) {
        const auto byte = static_cast<unsigned char>(text[k]);
        const bool begins_character = (byte & 0xC0) != 0x80;  // of UTF-8
        if (k >= longest && begins_character) {
            shown += "…";
            break;
        }
        shown += byte < 0x20 || byte == 0x7F ? '?' : text[k];
    }
    return shown + "'";
}

std::string number_text(double number) {
    char digits[32];
    const auto written = std::to_chars(digits, digits + sizeof digits, number);
    return {digits, written.ptr};
}

std::string suggestion(std::string_view asked, const std::vector<std::string>& known) {
    constexpr std::size_t longest_compared = 256;  // bytes; the cost is a product of lengths
    constexpr std::size_t most_compared = 10'000;
    if (known.size() <= most_compared && asked.size() <= longest_compared)
        if (const std::string* const meant = synonym_of(lower_case(asked), known))
            return "; did you mean " + in_quotes(*meant) + "?";
    const std::string* nearest = nullptr;
    std::size_t least = std::string_view::npos;
    for (const std::string& candidate : known) {
        if (asked.size() > longest_compared || known.size() > most_compared) break;
        const std::size_t distance = unlikeness(asked, candidate);
        if (distance < least) {
            least = distance;
            nearest = &candidate;
        }
    }
    if (nearest) return "; did you mean " + in_quotes(*nearest) + "?";
    constexpr std::size_t most_listed = 20;
    if (known.empty() || known.size() > most_listed) return "";
    std::string listed = "; known here: ";
    for (const std::string& name : known) listed += (&name == &known.front() ? "" : ", ") + name;
    return listed;
}

}  // namespace patchlight::server
