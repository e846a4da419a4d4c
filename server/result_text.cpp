#include "server/result_text.h"

#include <algorithm>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

bool fits_on_a_line(const Json& value) {
    const auto is_plain = [](const Json& element) { return element.is_primitive(); };
    return value.is_primitive() || value.empty() ||
           (value.is_array() && std::all_of(value.begin(), value.end(), is_plain));
}

void write(const Json& value, const std::string& indent, std::string& text) {
    if (fits_on_a_line(value)) {
        text += value.dump();
        return;
    }
    const std::string deeper = indent + "  ";
    const bool is_object = value.is_object();
    text += is_object ? '{' : '[';
    const char* separator = "\n";
    for (const auto& [key, element] : value.items()) {
        text += separator + deeper;
        if (is_object) text += Json(key).dump() + ": ";
        write(element, deeper, text);
        separator = ",\n";
    }
    text += "\n" + indent + (is_object ? '}' : ']');
}

}  // namespace

std::string result_text(const Json& result) {
    std::string text;
    write(result, "", text);
    return text + "\n";
}

}  // namespace patchlight::server
