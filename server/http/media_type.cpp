#include "server/http/media_type.h"

#include <algorithm>
#include <charconv>

namespace patchlight::server {
namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

/// What stands before the next `separator`; `text` keeps what stands behind it.
std::string_view take_until(char separator, std::string_view& text) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const std::string_view taken = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return taken;
}

/// Of one range of Accept; 0 if it is no number from 0 to 1.
double quality_of(std::string_view parameters) {
    while (!parameters.empty()) {
        std::string_view value = take_until(';', parameters);
        const std::string_view name = take_until('=', value);
        if (name != "q" && name != "Q") continue;
        double quality = 0.0;
        const char* const end = value.data() + value.size();
        const auto read = std::from_chars(value.data(), end, quality, std::chars_format::fixed);
        const bool is_right = read.ec == std::errc() && read.ptr == end && quality >= 0.0;
        return is_right ? std::min(quality, 1.0) : 0.0;
    }
    return 1.0;
}

/// How closely a range names a type: 3 itself, 2 "image/*", 1 "*/*", 0 not at all.
int closeness(const std::string& range, const std::string& type) {
    if (range == type) return 3;
    if (range == "*/*" || range == "*") return 1;
    return range.ends_with("/*") && type.starts_with(range.substr(0, range.size() - 1)) ? 2 : 0;
}

/// The quality of the range that names the type most closely.
double quality_for(const std::string& type, std::string_view accept) {
    int closest = 0;
    double quality = 0.0;
    while (!accept.empty()) {
        std::string_view parameters = take_until(',', accept);
        const std::string range = media_type(take_until(';', parameters));
        const int close = closeness(range, type);
        if (close <= closest) continue;
        closest = close;
        quality = quality_of(parameters);
    }
    return quality;
}

}  // namespace

std::optional<std::string> negotiated_type(std::optional<std::string_view> accept,
                                           std::span<const std::string> offered) {
    if (!accept || trimmed(*accept).empty()) return offered.front();
    std::optional<std::string> best;
    double best_quality = 0.0;
    for (const std::string& type : offered)
        if (const double quality = quality_for(type, *accept); quality > best_quality) {
            best_quality = quality;
            best = type;
        }
    return best;
}

std::string media_type(std::string_view content_type) {
    std::string type(take_until(';', content_type));
    for (char& letter : type)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return type;
}

}  // namespace patchlight::server
