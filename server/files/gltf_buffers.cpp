#include "server/files/gltf_buffers.h"

#include "server/files/base64.h"
#include "server/files/file_bytes.h"
#include "server/wording.h"

#include <charconv>

namespace patchlight::server {
namespace {

constexpr std::int64_t most_buffer_bytes = std::int64_t{512} << 20;  // of all buffers

/// "%20" is a blank (RFC 3986, section 2.1).
std::string without_percent_codes(std::string_view uri) {
    std::string plain;
    for (std::size_t k = 0; k < uri.size(); ++k) {
        unsigned code = 0;
        if (uri[k] == '%' && k + 2 < uri.size()) {
            const auto read = std::from_chars(&uri[k + 1], &uri[k + 1] + 2, code, 16);
            if (read.ptr == &uri[k + 1] + 2) {
                plain += static_cast<char>(code);
                k += 2;
                continue;
            }
        }
        plain += uri[k];
    }
    return plain;
}

/// Whether it only says how large data would be that is there compressed.
bool is_fallback(const JsonValue& buffer) {
    const auto extensions = buffer.find("extensions");
    return extensions && (extensions->has("EXT_meshopt_compression") ||
                          extensions->has("KHR_meshopt_compression"));
}

std::string read_file_uri(const JsonValue& uri, const std::filesystem::path& path) {
    const auto file = file_of_uri(uri, path);
    if (!file) uri.reject(in_quotes(uri.text()) + " does not lie beside the glTF file");
    try {
        return read_file_bytes(*file, in_quotes(uri.text()));
    } catch (const InputError& error) {
        uri.reject(error.pointer() + " " + error.what());
    }
}

}  // namespace

std::size_t gltf_index(const JsonValue& reference, const JsonValue& root, const char* list) {
    const auto found = root.find(list);
    const std::size_t count = found ? found->size() : 0;
    const std::int64_t number =
        reference.whole_number(-(std::int64_t{1} << 53), std::int64_t{1} << 53);
    if (number < 0 || static_cast<std::size_t>(number) >= count)
        reference.reject("there is no element " + std::to_string(number) + " in '" + list +
                         "'; it has " + std::to_string(count));
    return static_cast<std::size_t>(number);
}

std::string read_data_uri(const JsonValue& uri) {
    const std::string_view text = uri.text();
    constexpr std::string_view encoding = ";base64";
    const std::size_t comma = std::min(text.find(','), text.size());
    if (comma == text.size() || !text.substr(0, comma).ends_with(encoding))
        uri.reject(
            "must be a data URI in base64, such as data:application/octet-stream;base64,AAAA");
    auto bytes = decode_base64(text.substr(comma + 1));
    if (!bytes) uri.reject("is no base64");
    return std::move(*bytes);
}

std::optional<std::filesystem::path> file_of_uri(const JsonValue& uri,
                                                 const std::filesystem::path& path) {
    if (uri.text().find("://") != std::string::npos) return std::nullopt;
    return file_beside(path, without_percent_codes(uri.text()));
}

std::vector<std::string> read_gltf_buffers(const JsonValue& root, const std::filesystem::path& path,
                                           std::optional<std::string_view> binary) {
    std::vector<std::string> buffers;
    const auto list = root.find("buffers");
    if (!list) return buffers;
    std::int64_t left = most_buffer_bytes;
    list->for_each_element([&](const JsonValue& buffer) {
        const JsonValue announced = buffer.at("byteLength");
        const auto length = static_cast<std::size_t>(announced.whole_number(0, left));
        left -= static_cast<std::int64_t>(length);
        const auto uri = buffer.find("uri");
        if (uri)
            buffers.push_back(uri->text().starts_with("data:") ? read_data_uri(*uri)
                                                               : read_file_uri(*uri, path));
        else if (binary && buffers.empty())
            buffers.emplace_back(*binary);
        else
            buffer.reject(is_fallback(buffer) ? "has no data: the file holds it compressed alone "
                                                "(EXT_meshopt_compression); export it without"
                                              : "needs 'uri'");
        if (buffers.back().size() < length)
            announced.reject("announces " + std::to_string(length) + " bytes; there are " +
                             std::to_string(buffers.back().size()));
        buffers.back().resize(length);
    });
    return buffers;
}

}  // namespace patchlight::server
