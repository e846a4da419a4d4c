#include "solver/view_factors.h"

#include "solver/factor_rows.h"
#include "solver/flaws.h"
#include "solver/form_factors/hemicube_errors.h"
#include "solver/form_factors/repair_closure.h"
#include "solver/make_engine.h"
#include "solver/mesh/make_patches.h"
#include "solver/scene/input_error.h"
#include "solver/solve_plan.h"
#include "solver/watch.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace patchlight {

namespace {

constexpr double default_patches = 2000.0;
constexpr double most_kept = 2147483648.0;  // [bytes]
constexpr double kept_share = 0.25;         // of the memory limit
constexpr double bytes_per_pair = 40.0;     // matrix, its transposed index, and room to grow
constexpr double quadrature = 3e-7;         // relative error of an analytic factor [1]

/// Rays per patch unless they are given: what brings the sums of a row over an object within about
/// half a percent (measured on the Cornell box against 10^7 rays a row). The fewer the patches, the
/// fewer pairs there are over which errors even out. Samples in penumbrae come on top.
int rays_for(std::size_t patches) {
    constexpr double in_all = 1.6e8;
    constexpr double least = 1024.0, most = 32768.0;
    return static_cast<int>(std::clamp(in_all / static_cast<double>(patches), least, most));
}

/// Sums rows of patches to one row of groups.
class GroupSum {
  public:
    GroupSum(const FactorGroups& groups, const PatchMesh& mesh)
        : groups_(groups), mesh_(mesh), power_(groups.areas.size()), variance_(power_.size()) {}

    void add(const FactorRowView& row) {
        const double area = mesh_.patches[row.i].area;
        for (std::size_t k = 0; k < row.columns.size(); ++k) {
            const std::uint32_t g = groups_.of_patch[row.columns[k]];
            if (power_[g] == 0.0) touched_.push_back(g);
            power_[g] += area * row.factors[k];
            variance_[g] += area * area * row.variance[k];
        }
    }

    GroupFactors finish(std::uint32_t from) {
        std::sort(touched_.begin(), touched_.end());
        touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
        GroupFactors result{from, {}, {}, {}};
        const double area = groups_.areas[from];
        for (const std::uint32_t g : touched_) {
            const double factor = power_[g] / area;
            // Within a group each pair was met from both ends, with one and the same error.
            const double twice = g == from ? 2.0 : 1.0;
            if (factor > 0.0) {
                result.to.push_back(g);
                result.factors.push_back(factor);
                result.errors.push_back(
                    std::hypot(std::sqrt(twice * variance_[g]) / area, quadrature * factor));
            }
            power_[g] = variance_[g] = 0.0;
        }
        touched_.clear();
        return result;
    }

  private:
    const FactorGroups& groups_;
    const PatchMesh& mesh_;
    std::vector<double> power_, variance_;
    std::vector<std::uint32_t> touched_;
};

bool fits(const FormFactorEngine& engine, const PatchMesh& mesh, std::uint64_t memory_limit) {
    const double n = static_cast<double>(mesh.size());
    const double budget = std::min(most_kept, kept_share * static_cast<double>(memory_limit));
    if (0.5 * n * n * bytes_per_pair <= budget) return true;
    const double halves = engine.pairwise() ? 0.5 : 1.5;  // full rows stand beside joined ones
    return halves * n * n * estimate_density(engine, mesh) * bytes_per_pair <= budget;
}

FormFactorReport report_of(const StreamedRows& rows) {
    FormFactorReport report;
    report.rays = rows.rays();
    report.open = rows.open();
    report.measured = report.repaired = rows.closure();
    report.repaired.closure_max = 0.0;
    return report;
}

/// Hands on one group after another; `step` is told the fraction done and says why to stop, if at
/// all.
StopReason sum_groups(FactorRows& rows, const FactorGroups& groups, const PatchMesh& mesh,
                      const std::function<void(const GroupFactors&)>& take,
                      const std::function<StopReason(double)>& step) {
    GroupSum sum(groups, mesh);
    double visited = 0.0;  // rows
    StopReason stopped = StopReason::tolerance;
    const auto add = [&](const FactorRowView& row) {
        sum.add(row);
        stopped = step(++visited / static_cast<double>(mesh.size()));
        return stopped == StopReason::tolerance;
    };
    for (std::uint32_t g = 0; g < groups.areas.size(); ++g) {
        if (!rows.visit(groups.patches[g], add)) break;
        take(sum.finish(g));
    }
    return stopped;
}

/// All pairs, repaired together; empty if the work was stopped.
std::unique_ptr<FactorRows> keep_rows(const FormFactorEngine& engine, const Scene& scene,
                                      const PatchMesh& mesh, Watch& watch,
                                      ViewFactorReport& report) {
    StopReason stopped = StopReason::tolerance;
    ExchangeMatrix exchange = build_exchange(engine, scene, mesh, [&](double fraction) {
        stopped = watch.step({Stage::form_factors, fraction, 0, 0.0});
        return stopped == StopReason::tolerance;
    });
    report.form_factors.rays = exchange.rays;
    if (!exchange.complete) {
        report.status = status_of(stopped);
        return nullptr;
    }
    report.form_factors.measured = exchange.measured;
    repair_closure(exchange);
    report.form_factors.repaired = measure_closure(exchange);
    report.form_factors.open = std::any_of(exchange.escaped.begin(), exchange.escaped.end(),
                                           [](double share) { return share > 0.0; });
    return std::make_unique<KeptRows>(std::move(exchange));
}

}  // namespace

ViewFactorSolver::ViewFactorSolver(const Scene& scene, const SolveSettings& settings,
                                   Grouping grouping)
    : scene_(scene) {
    if (scene.surfaces.empty())
        throw InputError("/objects", "nothing with an area is left to compute factors between");
    const Observer nobody;
    Watch watch(nobody, settings.time_limit);
    SolveSettings asked = settings;
    asked.method = Method::shooting;  // its memory is that of rows, not of the matrix
    asked.accuracy.reset();           // that is one of light
    if (!asked.patch_size) asked.patch_size = patch_size_for(scene, default_patches);
    settings_ = plan_solve(scene, asked).settings;
    check_memory(scene, estimate_patch_count(scene, *settings_.patch_size), settings_);
    const auto go_on = [&] { return watch.in_time(); };
    lines_ = find_mesh_lines(scene, go_on);
    if (go_on())
        mesh_ = make_patches(scene, lines_, *settings_.patch_size,
                             [&](std::size_t) { return go_on(); });
    if (!go_on()) mesh_ = uncut_patches(scene);
    check_memory(scene, mesh_.size(), settings_);
    if (!settings.rays && settings_.engine == Engine::analytic)
        settings_.rays = rays_for(mesh_.size());
    groups_ = make_factor_groups(scene, mesh_, grouping);
    mesh_seconds_ = watch.lap();
}

ViewFactorReport ViewFactorSolver::find(const std::function<void(const GroupFactors&)>& take,
                                        const Observer& observe) const {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(settings_.threads));
    std::optional<double> time_left = settings_.time_limit;
    if (time_left) *time_left -= mesh_seconds_;
    Watch watch(observe, time_left);
    ViewFactorReport report;
    report.settings = settings_;
    report.settings.method = Method::automatic;
    report.patches = mesh_.size();
    report.seconds.mesh = mesh_seconds_;
    const auto in_time = [&] { return watch.in_time(); };
    if (!in_time()) {
        report.status = Status::limit;
        return report;
    }
    const RayScene rays(scene_, lines_.overlaps);
    report.findings = find_geometry_flaws(scene_, lines_.overlaps, rays, settings_.seed, in_time);
    const auto engine =
        make_engine(scene_, mesh_, rays, settings_, [&] { return watch.may_prepare(); });
    engine->give_up_unless(in_time);
    if (const StopReason stopped = watch.step({Stage::form_factors});
        stopped != StopReason::tolerance) {
        report.status = status_of(stopped);
        return report;
    }
    std::unique_ptr<FactorRows> rows;
    try {
        report.streamed = !fits(*engine, mesh_, *settings_.memory_limit);
        if (report.streamed)
            rows = std::make_unique<StreamedRows>(*engine, mesh_);
        else
            rows = keep_rows(*engine, scene_, mesh_, watch, report);
        report.seconds.form_factors = watch.lap();
        if (!rows) return report;
        const Stage stage = report.streamed ? Stage::form_factors : Stage::display;
        report.status = status_of(sum_groups(*rows, groups_, mesh_, take, [&](double fraction) {
            return watch.step({stage, fraction});
        }));
    } catch (const OutOfTime&) {
        report.status = Status::limit;
        report.seconds.form_factors += watch.lap();
    }
    if (const auto* streamed = dynamic_cast<const StreamedRows*>(rows.get()))
        report.form_factors = report_of(*streamed);
    if (settings_.engine == Engine::hemicube && report.status == Status::converged)
        report.form_factors.hemicube =
            estimate_hemicube_errors(scene_, mesh_, rays, hemicube_settings(settings_), in_time);
    report.seconds.display = watch.lap();
    return report;
}

}  // namespace patchlight
