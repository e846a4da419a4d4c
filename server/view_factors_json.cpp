#include "server/view_factors_json.h"

#include "server/quick_numbers.h"
#include "server/text_buffer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

/// Writes "key": [a, b, …] with what `put` puts for each k that `is_told`.
template <class IsTold, class Put>
void write_list(TextBuffer& buffer, std::string_view key, std::size_t count, const IsTold& is_told,
                const Put& put) {
    buffer.append(key);
    char separator = '[';
    for (std::size_t k = 0; k < count; ++k) {
        if (!is_told(k)) continue;
        char* const place = buffer.room(longest_number + 1);
        *place = separator;
        buffer.end_at(put(place + 1, k));
        separator = ',';
    }
    buffer.append("]");
}

char* put_error(char* place, double error) {
    constexpr std::string_view unknown = "null";
    if (std::isfinite(error)) return put_estimate(place, error);
    return std::copy(unknown.begin(), unknown.end(), place);
}

/// Whether there was anything to write.
bool write_row(TextBuffer& buffer, std::string_view separator, const ViewFactorRow& row) {
    assert(row.factor.size() == row.to.size() && row.error.size() == row.to.size());
    const auto is_told = [&](std::size_t k) { return static_cast<float>(row.factor[k]) != 0.0F; };
    const auto write = [&](std::string_view key, const auto& put) {
        write_list(buffer, key, row.to.size(), is_told, put);
    };
    bool any = false, any_error = false;
    for (std::size_t k = 0; k < row.to.size(); ++k) {
        any |= is_told(k);
        any_error |= is_told(k) && std::isfinite(row.error[k]);
    }
    if (!any) return false;
    buffer.append(separator);
    buffer.append("{\"from\":");
    buffer.end_at(put_index(buffer.room(longest_number), row.from));
    write(",\"to\":", [&](char* place, std::size_t k) { return put_index(place, row.to[k]); });
    write(",\"factor\":", [&](char* place, std::size_t k) {
        return put_float(place, static_cast<float>(row.factor[k]));
    });
    if (any_error)
        write(",\"error\":",
              [&](char* place, std::size_t k) { return put_error(place, row.error[k]); });
    buffer.append("}");
    return true;
}

}  // namespace

void write_view_factors_json(const ViewFactorGroups& groups, const ViewFactorRows& rows,
                             const TextSink& sink) {
    TextBuffer buffer(sink);
    buffer.append("{");
    if (!groups.names.empty()) buffer.append("\"names\":" + Json(groups.names).dump() + ",\n");
    buffer.append("\"areas\":" + Json(groups.areas).dump() + ",\n\"rows\":[");
    bool is_first = true;
    rows([&](const ViewFactorRow& row) {
        if (write_row(buffer, is_first ? "\n" : ",\n", row)) is_first = false;
    });
    buffer.append("\n]}\n");
    buffer.finish();
}

}  // namespace patchlight::server
