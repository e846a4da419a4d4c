#include "server/view_factors_csv.h"

#include "server/csv_table.h"
#include "server/quick_numbers.h"
#include "server/text_buffer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

namespace patchlight::server {
namespace {

std::vector<std::string> fields_of(const ViewFactorGroups& groups) {
    std::vector<std::string> fields;
    fields.reserve(groups.areas.size());
    for (std::size_t k = 0; k < groups.areas.size(); ++k)
        fields.push_back(groups.names.empty() ? std::to_string(k) : csv_field(groups.names[k]));
    return fields;
}

char* put(char* place, const std::string& text) {
    return std::copy(text.begin(), text.end(), place);
}

}  // namespace

void write_view_factors_csv(const ViewFactorGroups& groups, const ViewFactorRows& rows,
                            const TextSink& sink) {
    std::vector<std::string> fields = fields_of(groups);
    std::size_t longest = 0;
    for (std::string& field : fields) {
        field += ',';
        longest = std::max(longest, field.size());
    }
    TextBuffer buffer(sink);
    buffer.append("from,to,factor,error\n");
    rows([&](const ViewFactorRow& row) {
        assert(row.factor.size() == row.to.size() && row.error.size() == row.to.size());
        const std::string& from = fields.at(row.from);
        for (std::size_t k = 0; k < row.to.size(); ++k) {
            const auto factor = static_cast<float>(row.factor[k]);
            if (factor == 0.0F) continue;
            char* end = buffer.room(2 * longest + 2 * longest_number + 2);
            end = put(put(end, from), fields[row.to[k]]);
            end = put_float(end, factor);
            *end++ = ',';
            if (std::isfinite(row.error[k])) end = put_estimate(end, row.error[k]);
            *end++ = '\n';
            buffer.end_at(end);
        }
    });
    buffer.finish();
}

}  // namespace patchlight::server
