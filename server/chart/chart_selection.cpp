#include "server/chart/chart_selection.h"

#include <algorithm>
#include <array>
#include <functional>

namespace patchlight::server {
namespace {

constexpr double about = 1.1;  // a time that counts as equal, over the time [1]
constexpr std::array round_errors{0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.2, 0.5};

/// Of every series that has points the first, in the order of `is_better`, that is let in.
std::vector<Selected> select(
    const Chart& chart, const std::function<bool(const ChartPoint&)>& is_let_in,
    const std::function<bool(const ChartPoint&, const ChartPoint&)>& is_better) {
    std::vector<Selected> selected;
    for (SeriesIndex s = 0; s < all_series.size(); ++s) {
        Selected best{s, nullptr};
        bool has_points = false;
        for (const ChartPoint& point : chart.points) {
            if (point.method.series != s || !point.error) continue;
            has_points = true;
            if (is_let_in(point) && (!best.point || is_better(point, *best.point)))
                best.point = &point;
        }
        if (has_points) selected.push_back(best);
    }
    return selected;
}

}  // namespace

std::optional<double> middle_time(const Chart& chart) {
    std::vector<double> automatic, all;
    for (const ChartPoint& point : chart.points) {
        if (!point.error) continue;
        all.push_back(point.seconds);
        if (point.method.series == automatic_series) automatic.push_back(point.seconds);
    }
    std::vector<double>& seconds = automatic.empty() ? all : automatic;
    if (seconds.empty()) return std::nullopt;
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

std::vector<Selected> best_within_time(const Chart& chart, double seconds) {
    return select(
        chart, [=](const ChartPoint& point) { return point.seconds <= about * seconds; },
        [](const ChartPoint& a, const ChartPoint& b) { return *a.error < *b.error; });
}

double common_error(const Chart& chart) {
    double best = round_errors.back();
    std::ptrdiff_t most = 0;
    for (const double error : round_errors) {
        const std::vector<Selected> reached = quickest_within_error(chart, error);
        const auto count = std::count_if(reached.begin(), reached.end(),
                                         [](const Selected& each) { return each.point; });
        if (count <= most) continue;
        most = count;
        best = error;
    }
    return best;
}

std::vector<Selected> quickest_within_error(const Chart& chart, double error) {
    return select(
        chart, [=](const ChartPoint& point) { return *point.error <= error; },
        [](const ChartPoint& a, const ChartPoint& b) { return a.seconds < b.seconds; });
}

AutomaticScore score_automatic(const Chart& chart) {
    AutomaticScore score;
    for (const ChartPoint& point : chart.points) {
        if (point.method.series != automatic_series || !point.error) continue;
        ++score.points;
        if (point.is_on_front) ++score.on_front;
        const ChartPoint* rival = nullptr;
        for (const ChartPoint& other : chart.points)
            if (other.method.series != automatic_series && other.error &&
                *other.error <= *point.error && (!rival || other.seconds < rival->seconds))
                rival = &other;
        if (!rival) {
            ++score.unmatched;
            continue;
        }
        const double gain = rival->seconds / point.seconds;
        score.least_gain = score.least_gain > 0.0 ? std::min(score.least_gain, gain) : gain;
        score.most_gain = std::max(score.most_gain, gain);
    }
    return score;
}

}  // namespace patchlight::server
