#include "server/trace/html_text.h"

namespace patchlight::server {

std::string html_text(std::string_view text) {
    std::string escaped;
    for (const char character : text) switch (character) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += character;
        }
    return escaped;
}

std::string html_figure(const std::string& file, const std::string& alternative,
                        const std::string& caption) {
    return "<figure><img src=\"" + file + "\" alt=\"" + alternative + "\"><figcaption>" + caption +
           "</figcaption></figure>\n";
}

}  // namespace patchlight::server
