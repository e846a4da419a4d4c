#include "server/files/text_file.h"

#include "server/files/file_bytes.h"
#include "server/utf8_text.h"
#include "solver/scene/input_error.h"

namespace patchlight::server {
namespace {

/// Every other byte of a short beginning is NUL where letters of English are two bytes each.
bool alternates(std::string_view bytes) {
    constexpr std::size_t looked_at = 8;
    if (bytes.size() < looked_at) return false;
    for (const std::size_t first : {0u, 1u}) {
        bool is_wide = true;
        for (std::size_t k = 0; k < looked_at; ++k)
            is_wide &= (bytes[k] == '\0') == (k % 2 == first);
        if (is_wide) return true;
    }
    return false;
}

}  // namespace

void refuse_wide_text(std::string_view bytes, const std::string& shown) {
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") || alternates(bytes))
        throw InputError(shown, "is text in UTF-16 or UTF-32; save it as UTF-8");
}

std::string read_text_file(const std::filesystem::path& path, const std::string& shown) {
    const std::string bytes = read_file_bytes(path, shown);
    refuse_wide_text(bytes, shown);
    return as_utf8(bytes);
}

}  // namespace patchlight::server
