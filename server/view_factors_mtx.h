#pragma once

#include "server/text_sink.h"
#include "server/view_factors.h"

#include <cstdint>

namespace patchlight::server {

/// Puts text in the place of as much text that was written before, from byte `offset` on.
using OverwriteText = std::function<void(std::uint64_t offset, std::string_view text)>;

/// Matrix Market, coordinate real general: row and column count from 1, and `% k name` tells which
/// group is which, where they have names. Errors have no place in it. The number of entries stands
/// before them, so it is put there in the end. Boisvert, Pozo & Remington, "The Matrix Market
/// Exchange Formats: Initial Design", 1996.
void write_view_factors_mtx(const ViewFactorGroups& groups, const ViewFactorRows& rows,
                            const TextSink& sink, const OverwriteText& overwrite);

}  // namespace patchlight::server
