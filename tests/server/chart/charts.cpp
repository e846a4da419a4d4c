#include "tests/server/chart/charts.h"

namespace patchlight::server {

namespace {
constexpr int width = 3, height = 2;

ChartView plain_view(float reflected) {
    return {{width, height, std::vector<float>(3 * width * height, 0.5F)},
            {width, height, std::vector<float>(width * height, reflected),
             std::vector<float>(width * height, 1.0F)}};
}
}  // namespace

ChartPoint chart_point(SeriesIndex series, double setting, double seconds, double error) {
    ChartPoint point;
    point.method.series = series;
    SolveSettings& settings = point.method.settings;
    settings.method = all_series.at(series).method;
    settings.engine = all_series.at(series).engine;
    if (series == automatic_series)
        settings.accuracy = setting;
    else {
        settings.patch_size = 0.25;
        settings.rays = static_cast<int>(setting);
    }
    point.seconds = seconds;
    point.repeats = 3;
    point.patches = 100;
    point.error = error;
    point.view = plain_view(1.0F + static_cast<float>(error));
    return point;
}

Chart small_chart() {
    Chart chart;
    chart.points = {chart_point(1, 256, 0.05, 0.08),   chart_point(0, 0.1, 0.2, 0.04),
                    chart_point(2, 1024, 0.6, 0.02),   chart_point(0, 0.01, 0.5, 0.005),
                    chart_point(1, 4096, 0.125, 0.06), chart_point(0, 0.001, 4.0, 0.0009)};
    chart.points[0].estimate = 0.125;
    chart.skipped = {{chart_point(3, 128, 0.0, 0.0).method, "would have taken long, very long"}};
    chart.skipped[0].method.settings.rays.reset();
    chart.skipped[0].method.settings.hemicube_resolution = 128;
    ChartReference reference;
    reference.accuracy = 0.001;
    reference.estimate = 0.0008;
    reference.seconds = 9.0;
    reference.level = 1.0;
    reference.view = plain_view(1.0F);
    chart.reference = reference;
    chart.time_limit = 30.0;
    chart.seconds = 20.0;
    chart.threads = 2;
    mark_points(chart);
    return chart;
}

}  // namespace patchlight::server
