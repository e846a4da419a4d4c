#include "solver/prepare_transport.h"

#include "solver/accuracy/cluster_transport.h"
#include "solver/form_factors/outside_rays.h"
#include "solver/make_engine.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/transport/patch_fields.h"

#include <utility>

namespace patchlight {

namespace {

constexpr double for_transport = 0.2;  // of the time that is left, if there is a limit

PreparedTransport carry_on_clusters(const SolveStage& stage, std::uint64_t seed) {
    Solution& solution = stage.solution;
    LightClusters clusters = make_light_clusters(stage.scene, solution.mesh, most_clusters);
    ClusterExchange exchange = find_cluster_exchange(
        stage.scene, solution.mesh, stage.rays, clusters, *solution.settings.rays,
        for_transport * stage.watch.seconds_left(), mix(seed, 0x636c7573), [&](double fraction) {
            return stage.watch.step({Stage::form_factors, fraction}) == StopReason::tolerance;
        });
    PreparedTransport prepared;
    if (!exchange.between.complete) return prepared;
    solution.form_factors.rays = exchange.between.rays;
    prepared.backs.assign(solution.mesh.size(), 0.0);
    prepared.escaped.assign(solution.mesh.size(), 0.0);
    for (const PatchIndex i : clusters.patches) {
        prepared.backs[i] = exchange.between.backs[clusters.of_patch[i]];
        prepared.escaped[i] = exchange.between.escaped[clusters.of_patch[i]];
    }
    PatchFields fields = make_patch_fields(stage.scene, solution.mesh);
    prepared.transport = std::make_unique<ClusterTransport>(
        std::move(clusters), exchange, std::move(fields.area), std::move(fields.reflectance));
    return prepared;
}

PreparedTransport shoot_on_rows(const SolveStage& stage, std::uint64_t seed,
                                const std::function<bool()>& go_on) {
    const Solution& solution = stage.solution;
    PreparedTransport prepared;
    prepared.engine = make_engine(stage.scene, solution.mesh, stage.rays, solution.settings, go_on);
    prepared.engine->give_up_unless([&watch = stage.watch] { return watch.in_time(); });
    PatchFields fields = make_patch_fields(stage.scene, solution.mesh);
    prepared.transport = std::make_unique<ShotTransport>(*prepared.engine, std::move(fields.area),
                                                         std::move(fields.reflectance));
    const OutsideRays probe(stage.scene, solution.mesh, stage.rays, probe_rays,
                            mix(seed, 0x70726f62));
    for (const Outside& outside : probe.everywhere()) {
        prepared.backs.push_back(outside.backs);
        prepared.escaped.push_back(outside.escaped);
    }
    return prepared;
}

}  // namespace

PreparedTransport prepare_transport(const SolveStage& stage, std::uint64_t seed,
                                    const std::function<bool()>& go_on) {
    const SolveSettings& settings = stage.solution.settings;
    if (settings.method == Method::hierarchical) return carry_on_clusters(stage, seed);
    if (settings.method == Method::shooting) return shoot_on_rows(stage, seed, go_on);
    PreparedTransport prepared;
    ExchangeMatrix exchange;
    if (!find_form_factors(stage, exchange)) return prepared;
    PatchFields fields = make_patch_fields(stage.scene, stage.solution.mesh);
    prepared.transport = std::make_unique<MatrixTransport>(exchange, std::move(fields.area),
                                                           std::move(fields.reflectance),
                                                           settings.engine == Engine::analytic);
    prepared.backs = std::move(exchange.backs);
    prepared.escaped = std::move(exchange.escaped);
    return prepared;
}

}  // namespace patchlight
