#pragma once

#include "server/chart/chart.h"
#include "server/text_sink.h"

namespace patchlight::server {

/// A row for every method: measured ones quickest first, then those skipped, with the reason. What
/// a method does not set, or what was not measured, is left empty. Lengths in metres.
void write_chart_csv(const Chart& chart, const TextSink& sink);

}  // namespace patchlight::server
