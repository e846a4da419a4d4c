#include "solver/form_factors/analytic_engine.h"

#include "solver/form_factors/four_samples.h"
#include "solver/rays/penumbra.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr int most_samples = 4096;      // of one pair
constexpr int points_in_a_row = 16384;  // after which they are scrambled anew
constexpr std::size_t fewest_on_a_plane = 4;
constexpr int penumbra_effort = 8;  // times as many where the first samples of neighbours disagree

/// Rounded up to whole packets.
int samples_for(double wanted) {
    return static_cast<int>(std::min(std::ceil(wanted / four), 1e6)) * four;
}

}  // namespace

AnalyticEngine::AnalyticEngine(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene,
                               const AnalyticSettings& settings, const std::function<bool()>& go_on)
    : mesh_(mesh),
      ray_scene_(ray_scene),
      settings_(settings),
      groups_(find_plane_groups(scene)),
      exchange_(scene, mesh, groups_),
      blockers_(scene, mesh, groups_, go_on),
      outside_rays_(scene, mesh, ray_scene, settings.outside_rays, mix(settings.seed, 0x6f7574)),
      visibility_(outside_rays_.rays(), ray_scene, points_in_a_row, mix(settings.seed, 0x766973)),
      sheet_(find_sheets(scene)) {}

/// Which patches tell each other of penumbrae: those of a plane, or of an object where planes are
/// of a few patches each, as on curved surfaces.
std::vector<std::uint32_t> AnalyticEngine::find_sheets(const Scene& scene) const {
    std::vector<std::size_t> count(groups_.size(), 0);
    for (const Patch& patch : mesh_.patches) ++count[groups_.of_surface[patch.surface]];
    std::vector<std::uint32_t> sheets;
    for (const Patch& patch : mesh_.patches) {
        const std::uint32_t group = groups_.of_surface[patch.surface];
        const auto object =
            static_cast<std::uint32_t>(groups_.size()) + scene.surfaces[patch.surface].object;
        sheets.push_back(count[group] < fewest_on_a_plane ? object : group);
    }
    return sheets;
}

std::vector<VisibilityQuery> AnalyticEngine::first_queries(const FactorRow& row,
                                                           PatchIndex i) const {
    std::vector<VisibilityQuery> queries;
    double total = 0.0;
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
        if (!blockers_.may_block(i, row.columns[k])) continue;
        VisibilityQuery query;
        query.i = i;
        query.j = row.columns[k];
        query.share = row.factors[k];
        total += query.share;
        queries.push_back(query);
    }
    int taken = 0;  // points of the row's one sequence
    for (VisibilityQuery& query : queries) {
        query.count = std::clamp(samples_for(settings_.rays * query.share / total), four,
                                 most_samples / penumbra_effort);
        query.first = taken;
        taken += query.count;
    }
    return queries;
}

void AnalyticEngine::refine(std::vector<VisibilityQuery>& queries) const {
    std::vector<FirstLook> looks;
    double total = 0.0;
    for (const VisibilityQuery& query : queries) total += query.share;
    const double per_share = settings_.rays / total;
    for (const VisibilityQuery& query : queries)
        looks.push_back({sheet_[query.j], query.clear, query.taken});
    const std::vector<bool> chosen = in_penumbra(looks);
    std::vector<VisibilityQuery> more;
    std::vector<std::size_t> places;
    int taken = queries.back().first + queries.back().count;
    for (std::size_t q = 0; q < queries.size(); ++q) {
        if (!chosen[q]) continue;
        more.push_back(queries[q]);
        more.back().first = taken;
        more.back().count =
            std::clamp(samples_for((penumbra_effort - 1) * queries[q].share * per_share), four,
                       (penumbra_effort - 1) * queries[q].count);
        taken += more.back().count;
        places.push_back(q);
    }
    visibility_.measure(more, [this] { look_at_clock(); });
    for (std::size_t m = 0; m < more.size(); ++m) queries[places[m]] = more[m];
}

void AnalyticEngine::row(PatchIndex i, FactorRow& row) const { fill(i, i + 1, row); }

void AnalyticEngine::whole_row(PatchIndex i, FactorRow& whole) const { fill(i, 0, whole); }

/// The columns from `first` on.
void AnalyticEngine::fill(PatchIndex i, PatchIndex first, FactorRow& row) const {
    row.clear();
    look_at_clock();
    const double area = mesh_.patches[i].area;
    for (PatchIndex j = first; j < mesh_.size(); ++j) {
        // One value for both ends, to the last bit.
        const double exchange = exchange_(std::min(i, j), std::max(i, j));
        if (exchange > 0.0) row.add(j, exchange / area, 0.0, exchange / area);
    }
    std::vector<VisibilityQuery> queries = first_queries(row, i);
    if (queries.empty()) return;
    visibility_.measure(queries, [this] { look_at_clock(); });
    refine(queries);
    std::size_t kept = 0, q = 0;
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
        double share = 1.0, variance = 0.0;
        if (q < queries.size() && queries[q].j == row.columns[k]) {
            if (queries[q].taken > 0) share = queries[q].visibility();
            variance = queries[q].variance();
            row.rays += static_cast<std::uint64_t>(queries[q].taken);
            ++q;
        }
        if (share == 0.0) continue;
        const double whole = row.factors[k];
        row.columns[kept] = row.columns[k];
        row.factors[kept] = whole * share;
        row.variance[kept] = whole * whole * variance;
        row.ceiling[kept++] = whole;
    }
    row.columns.resize(kept);
    row.factors.resize(kept);
    row.variance.resize(kept);
    row.ceiling.resize(kept);
}

Outside AnalyticEngine::outside(PatchIndex i) const {
    look_at_clock();
    return outside_rays_.at(i);
}

}  // namespace patchlight
