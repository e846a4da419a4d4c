#pragma once

#include "server/text_sink.h"
#include "server/view_factors.h"

namespace patchlight::server {

/// {"names": […], "areas": […], "rows": [{"from": 0, "to": [1, 4], "factor": [0.2, 0.1],
///  "error": [0.001, null]}, …]}
/// `from` and `to` count from 0 in `names` and `areas` [m²]; `names` is left out where groups are
/// known by their index. A row is a line; it has no `error` where none of its errors is known.
void write_view_factors_json(const ViewFactorGroups& groups, const ViewFactorRows& rows,
                             const TextSink& sink);

}  // namespace patchlight::server
