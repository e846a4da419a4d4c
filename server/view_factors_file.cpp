#include "server/view_factors_file.h"

#include "raster/whole_file.h"
#include "server/output_files.h"
#include "server/output_stream.h"
#include "server/view_factors_csv.h"
#include "server/view_factors_json.h"
#include "server/view_factors_mtx.h"
#include "server/wrong_input.h"

#include <filesystem>

namespace patchlight::server {
namespace {

constexpr const char* matrix_market = ".mtx";

/// Its header is written last, which a pipe does not allow.
void write_mtx_file(const std::string& path, const ViewFactorGroups& groups,
                    const ViewFactorRows& rows) {
    raster::WholeFile file(path);
    write_view_factors_mtx(
        groups, rows, [&](std::string_view text) { file.write(text); },
        [&](std::uint64_t offset, std::string_view text) { file.overwrite(offset, text); });
    file.commit();
}

}  // namespace

void check_view_factors_output(const std::string& option, const std::string& path) {
    if (path == to_standard_output) return;
    require_ending(option, path, {".csv", ".json", matrix_market});
    require_writable(option, path);
    std::error_code absent;
    const std::filesystem::file_status status = std::filesystem::status(path, absent);
    if (has_ending(path, matrix_market) && std::filesystem::is_other(status))
        throw WrongInput(option + " " + path + ": Matrix Market needs a file, not a pipe");
}

void write_view_factors(const std::string& path, const ViewFactorGroups& groups,
                        const ViewFactorRows& rows) {
    if (has_ending(path, matrix_market)) return write_mtx_file(path, groups, rows);
    write_output(path, [&](const TextSink& sink) {
        if (has_ending(path, ".json"))
            write_view_factors_json(groups, rows, sink);
        else
            write_view_factors_csv(groups, rows, sink);
    });
}

}  // namespace patchlight::server
