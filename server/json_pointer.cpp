#include "server/json_pointer.h"

namespace patchlight::server {

std::string escaped_for_pointer(std::string_view key) {
    std::string escaped;
    for (const char character : key) {
        if (character == '~')
            escaped += "~0";
        else if (character == '/')
            escaped += "~1";
        else
            escaped += character;
    }
    return escaped;
}

}  // namespace patchlight::server
