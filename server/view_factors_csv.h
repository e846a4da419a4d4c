#pragma once

#include "server/text_sink.h"
#include "server/view_factors.h"

namespace patchlight::server {

/// `from,to,factor,error`, a line for each pair; `error` is empty where it is not known. Factors
/// have the digits that a float needs, errors three.
void write_view_factors_csv(const ViewFactorGroups& groups, const ViewFactorRows& rows,
                            const TextSink& sink);

}  // namespace patchlight::server
