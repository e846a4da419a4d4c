#include "server/chart/chart_csv.h"

#include "server/csv_table.h"
#include "server/solve_json.h"

namespace patchlight::server {
namespace {

template <class Number>
CsvTable& optional_number(CsvTable& table, const std::optional<Number>& field) {
    if (!field) return table.text("");
    if constexpr (std::is_integral_v<Number>)
        return table.number(static_cast<std::size_t>(*field));
    else
        return table.number(*field);
}

void write_method(CsvTable& table, const ChartMethod& method) {
    table.text(name_of(method.settings.method)).text(name_of(method.settings.engine));
    optional_number(table, method.settings.accuracy);
    optional_number(table, method.settings.patch_size);
    optional_number(table, method.settings.rays);
    optional_number(table, method.settings.hemicube_resolution);
}

}  // namespace

void write_chart_csv(const Chart& chart, const TextSink& sink) {
    CsvTable table(
        "solver,form_factors,accuracy,patch_size,rays,hemicube_resolution,patches,seconds,repeats,"
        "estimate,error,at_floor,on_front,skipped",
        sink);
    for (const ChartPoint& point : chart.points) {
        write_method(table, point.method);
        table.number(point.patches).number(point.seconds);
        table.number(static_cast<std::size_t>(point.repeats));
        optional_number(table, point.estimate);
        optional_number(table, point.error);
        table.text(point.is_at_floor ? "yes" : "no").text(point.is_on_front ? "yes" : "no");
        table.text("").end_row();
    }
    for (const SkippedMethod& skipped : chart.skipped) {
        write_method(table, skipped.method);
        table.number(skipped.method.cost.patches);
        for (int empty = 0; empty < 6; ++empty) table.text("");
        table.text(skipped.why).end_row();
    }
    table.finish();
}

}  // namespace patchlight::server
