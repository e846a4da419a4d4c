#include "server/chart/chart_json.h"

#include "server/solve_json.h"

#include <utility>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

template <class Number>
void put(Json& block, const char* key, const std::optional<Number>& value) {
    if (value) block[key] = *value;
}

Json method_of(const ChartMethod& method) {
    Json block{{"solver", name_of(method.settings.method)},
               {"form_factors", name_of(method.settings.engine)}};
    put(block, "accuracy", method.settings.accuracy);
    put(block, "patch_size", method.settings.patch_size);
    put(block, "rays", method.settings.rays);
    put(block, "hemicube_resolution", method.settings.hemicube_resolution);
    return block;
}

Json point_of(const ChartPoint& point) {
    Json block = method_of(point.method);
    block["patches"] = point.patches;
    block["seconds"] = point.seconds;
    block["repeats"] = point.repeats;
    put(block, "estimate", point.estimate);
    put(block, "error", point.error);
    block["at_floor"] = point.is_at_floor;
    block["on_front"] = point.is_on_front;
    return block;
}

Json reference_of(const ChartReference& reference) {
    if (reference.is_known) return {{"kind", "known answer"}};
    Json block{{"kind", "solve"}, {"accuracy", reference.accuracy}};
    put(block, "estimate", reference.estimate);
    block["seconds"] = reference.seconds;
    return block;
}

}  // namespace

Json chart_json(const Chart& chart, const ChartOrigin& origin) {
    Json machine{{"cores", origin.cores}, {"threads", chart.threads}};
    if (!origin.processor.empty()) machine["processor"] = origin.processor;
    Json document{{"version", 1},
                  {"patchlight", origin.version},
                  {"status", chart.is_interrupted ? "cancelled" : "complete"},
                  {"scene", origin.scene},
                  {"command", origin.command},
                  {"machine", std::move(machine)},
                  {"time_limit", chart.time_limit},
                  {"seconds", chart.seconds}};
    if (chart.reference) {
        document["error_of"] =
            chart.reference->is_at_sensors ? "irradiance at sensors" : "displayed radiosity";
        document["reference"] = reference_of(*chart.reference);
    }
    document["points"] = Json::array();
    for (const ChartPoint& point : chart.points) document["points"].push_back(point_of(point));
    document["skipped"] = Json::array();
    for (const SkippedMethod& skipped : chart.skipped) {
        Json block = method_of(skipped.method);
        block["why"] = skipped.why;
        document["skipped"].push_back(std::move(block));
    }
    return document;
}

}  // namespace patchlight::server
