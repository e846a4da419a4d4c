#include "server/chart/make_chart.h"

#include "server/chart/chart_view.h"
#include "server/chart/find_truth.h"
#include "server/chart/timed_solve.h"
#include "server/exposure.h"
#include "server/summary.h"
#include "solver/scene/input_error.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace patchlight::server {
namespace {

constexpr double truth_share = 0.35;  // of the time limit
constexpr double quick = 1.0;         // a solve that is repeated [s]
constexpr int repeats = 3;

class ChartMaker {
  public:
    ChartMaker(const Job& job, const ChartWishes& wishes, const ChartProgress& tell,
               const std::function<bool()>& is_stopped)
        : job_(job),
          camera_(small_camera(job.cameras.front().camera, wishes.most_pixels)),
          tell_(tell),
          is_stopped_(is_stopped),
          miss_(all_series.size(), 1.0) {
        chart_.time_limit = wishes.time_limit;
        using Control = tbb::global_control;
        chart_.threads = static_cast<int>(Control::active_value(Control::max_allowed_parallelism));
    }

    Chart make() {
        open_ = chart_methods(job_.scene, job_.settings);
        find_reference();
        while (!open_.empty() && !is_stopped_()) measure_next();
        for (const ChartMethod& method : open_) skip(method, "interrupted before its turn");
        mark_points(chart_);
        chart_.is_interrupted = is_stopped_();
        chart_.seconds = spent();
        return std::move(chart_);
    }

  private:
    double spent() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    double left() const { return chart_.time_limit - spent(); }
    Observer observer(const std::string& doing) {
        return [this, doing](const Progress&) {
            tell_(doing, spent() / chart_.time_limit);
            return is_stopped_() ? Verdict::stop : Verdict::go_on;
        };
    }
    /// What a method is likely to take. Estimates are orders of magnitude: what the last of the
    /// series missed by, the next will miss by in part [s].
    double expected(const ChartMethod& method) const {
        return method.cost.seconds * std::sqrt(miss_[method.series]);
    }
    void find_reference();
    void measure_next();
    void measure(const ChartMethod& method);
    void repeat(ChartPoint& point, const Observer& observe, double first);
    void skip(const ChartMethod& method, const std::string& why) {
        chart_.skipped.push_back({method, why});
    }

    const Job& job_;
    raster::Camera camera_;
    const ChartProgress& tell_;
    const std::function<bool()>& is_stopped_;
    std::vector<double> miss_;  // per series: seconds measured over seconds estimated, last [1]
    std::vector<ChartMethod> open_;
    std::optional<FoundTruth> found_;
    Chart chart_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void ChartMaker::find_reference() {
    std::string doing;
    const auto start = [&](double accuracy) {
        doing = "reference, accuracy " + rounded(accuracy);
        tell_(doing, spent() / chart_.time_limit);
    };
    const Observer observe = [&](const Progress& progress) { return observer(doing)(progress); };
    found_ = find_truth(job_.scene, job_.settings, truth_share * chart_.time_limit, left(), start,
                        observe);
    if (!found_) return;
    const ChartTruth& truth = found_->truth;
    if (!truth.error_of(truth.solution()))
        throw InputError("",
                         "nothing reflects and no sensor is lit, so there is nothing to err about");
    ChartReference reference;
    reference.is_known = truth.is_known();
    reference.accuracy = found_->accuracy;
    if (!reference.is_known) reference.estimate = truth.solution().error.estimate;
    reference.seconds = found_->seconds;
    reference.is_at_sensors = truth.is_at_sensors();
    reference.level = truth.level();
    reference.exposure = automatic_exposure(job_.scene, truth.solution());
    reference.view = take_view(job_.scene, truth.solution(), camera_);
    chart_.reference = std::move(reference);
}

void ChartMaker::measure_next() {
    const auto next = std::min_element(
        open_.begin(), open_.end(),
        [this](const ChartMethod& a, const ChartMethod& b) { return expected(a) < expected(b); });
    const ChartMethod method = *next;
    open_.erase(next);
    if (method.cost.memory > method.cost.memory_limit)
        skip(method, "would need " + memory_text(static_cast<double>(method.cost.memory)) + ", " +
                         memory_text(static_cast<double>(method.cost.memory_limit)) +
                         " are allowed");
    else if (!found_)
        skip(method, "there was no reference to measure it against");
    else if (expected(method) > left())
        skip(method, "would have taken about " + rounded(expected(method)) + " s, " +
                         rounded(std::max(0.0, left())) + " s were left");
    else
        measure(method);
}

void ChartMaker::measure(const ChartMethod& method) {
    const Observer observe =
        observer(std::string(all_series[method.series].name) + ", " + setting_text(method));
    const double allowed = left();
    const TimedSolution timed = solve_timed(job_.scene, method.settings, allowed, observe);
    if (timed.is_out_of_time) skip(method, "was stopped after " + rounded(allowed) + " s");
    if (timed.is_out_of_time || timed.solution.status == Status::cancelled) return;
    if (!timed.is_finite) return skip(method, "gave numbers that are not finite");
    miss_[method.series] = timed.seconds / method.cost.seconds;
    ChartPoint point{method, timed.seconds, 1, timed.solution.mesh.size(), {}, {}, {}, {}, {}};
    point.estimate = timed.solution.error.estimate;
    point.error = found_->truth.error_of(timed.solution);
    point.view = take_view(job_.scene, timed.solution, camera_);
    repeat(point, observe, timed.seconds);
    chart_.points.push_back(std::move(point));
}

/// The median of what there is time for.
void ChartMaker::repeat(ChartPoint& point, const Observer& observe, double first) {
    std::vector<double> seconds{first};
    SolveSettings settings = point.method.settings;
    settings.measure_error = false;  // the first solve has told
    while (first < quick && std::ssize(seconds) < repeats && left() > 0.0) {
        const TimedSolution timed = solve_timed(job_.scene, settings, left(), observe);
        if (timed.is_out_of_time || timed.solution.status == Status::cancelled) break;
        seconds.push_back(timed.seconds);
    }
    std::sort(seconds.begin(), seconds.end());
    const std::size_t middle = seconds.size() / 2;
    point.seconds =
        seconds.size() % 2 == 1 ? seconds[middle] : 0.5 * (seconds[middle - 1] + seconds[middle]);
    point.repeats = static_cast<int>(seconds.size());
}

}  // namespace

void require_chartable(const Scene& scene) {
    if (scene.surfaces.empty())
        throw InputError("/objects", "nothing with an area is left to solve");
    const auto gives_light = [&](const Surface& surface) {
        return (scene.materials[surface.material].exitance > 0.0).any();
    };
    if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(), gives_light))
        throw InputError("/objects", "nothing gives off light, so there is nothing to err about");
}

Chart make_chart(const Job& job, const ChartWishes& wishes, const ChartProgress& tell,
                 const std::function<bool()>& is_stopped) {
    return ChartMaker(job, wishes, tell, is_stopped).make();
}

}  // namespace patchlight::server
