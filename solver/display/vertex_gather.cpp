#include "solver/display/vertex_gather.h"

#include "solver/form_factors/blocker_table.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <numbers>
#include <numeric>

namespace patchlight {

namespace {

constexpr double inward = 1e-4;  // of the way to the patch's centre
/// Points between two looks at the clock, from 64 on: those beside many gaps take milliseconds.
constexpr std::size_t first_points = 64, fewest_points = 16, most_points = 4096;
constexpr double seconds_between = 0.02;
constexpr double most_pairs = 2e7;  // of patches and patches of sources that are looked at
constexpr std::size_t fewest_for_records = 20'000;  // places
constexpr std::size_t fewest_parts = 1024, most_of_part = 32;

/// Steps of that many, round and round, come to each of `count` places, always in the largest gap.
std::size_t step_through(std::size_t count) {
    auto step = std::max<std::size_t>(
        1, static_cast<std::size_t>(static_cast<double>(count) / std::numbers::phi));
    while (std::gcd(step, count) != 1) ++step;
    return step;
}

}  // namespace

VertexGather::VertexGather(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                           const PlaneGroups& planes, const PointGather& gather, std::uint64_t seed,
                           std::function<bool()> go_on)
    : scene_(scene),
      mesh_(mesh),
      rays_(rays),
      gather_(gather),
      seed_(seed),
      go_on_(std::move(go_on)) {
    double source_patches = 0.0;
    for (const LightSource& source : gather.sources())
        source_patches +=
            mesh.first_of_surface[source.surface + 1] - mesh.first_of_surface[source.surface];
    if (source_patches * static_cast<double>(mesh.size()) > most_pairs) return;
    const BlockerTable blockers(scene, mesh, planes, go_on_);
    clear_.assign(mesh.size(), std::vector<bool>(gather.sources().size(), true));
    for (PatchIndex i = 0; i < mesh.size(); ++i)
        for (std::size_t s = 0; s < gather.sources().size(); ++s) {
            const SurfaceIndex surface = gather.sources()[s].surface;
            for (PatchIndex j = mesh.first_of_surface[surface];
                 j < mesh.first_of_surface[surface + 1]; ++j)
                if (blockers.may_block(i, j)) clear_[i][s] = false;
        }
}

GatherPoint VertexGather::point(PatchIndex i, const Vec3& position) const {
    const Patch& patch = mesh_.patches[i];
    const Vec3 moved = position + inward * (patch.centre - position);
    GatherPoint point = gather_.at(moved, scene_.surfaces[patch.surface].normal,
                                   rays_.lift(patch.surface), rays_.frame(patch.surface));
    if (!clear_.empty()) point.clear = &clear_[i];
    return point;
}

const Rgb& VertexGather::reflectance_of(PatchIndex i) const {
    return scene_.materials[scene_.surfaces[surface_of(i)].material].reflectance;
}

bool VertexGather::may_be_shaded(PatchIndex i) const {
    if (clear_.empty()) return !gather_.sources().empty();
    return std::find(clear_[i].begin(), clear_[i].end(), false) != clear_[i].end();
}

void VertexGather::each(std::size_t count, const std::function<void(std::size_t)>& at) const {
    const std::size_t part = std::clamp(count / fewest_parts, std::size_t{1}, most_of_part),
                      parts = (count + part - 1) / part, step = step_through(parts);
    std::size_t at_a_time = std::max<std::size_t>(1, first_points / part);
    for (std::size_t first = 0, end = 0; first < parts; first = end) {
        end = std::min(first + at_a_time, parts);
        const auto began = std::chrono::steady_clock::now();
        tbb::parallel_for(first, end, [&](std::size_t k) {
            const std::size_t from = k * step % parts * part;
            for (std::size_t n = from; n < std::min(from + part, count); ++n) at(n);
        });
        if (go_on_ && !go_on_()) return;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        at_a_time = took.count() < seconds_between
                        ? std::min(2 * at_a_time, std::max<std::size_t>(1, most_points / part))
                        : std::max(at_a_time / 2, std::max<std::size_t>(1, fewest_points / part));
    }
}

std::vector<VertexGather::Gathered> VertexGather::direct(const RefinementTree& tree,
                                                         std::span<const std::uint32_t> vertices,
                                                         const DirectEffort& effort) const {
    std::vector<Gathered> values(vertices.size());
    each(vertices.size(), [&](std::size_t k) {
        const TreeVertex& vertex = tree.vertices()[vertices[k]];
        const PointGather::Direct found =
            gather_.direct(point(vertex.patch, vertex.position), effort, mix(seed_, vertices[k]));
        const double y = luminance(reflectance_of(vertex.patch));
        values[k] = {found.irradiance, y * y * found.variance, true};
    });
    return values;
}

std::vector<VertexGather::Gathered> VertexGather::indirect(const RefinementTree& tree,
                                                           std::span<const std::uint32_t> vertices,
                                                           const ReflectedField& field, int first,
                                                           int end, double may_miss) const {
    const auto value = [&](std::uint32_t v, const PointGather::Indirect& found) {
        const Rgb& reflectance = reflectance_of(tree.vertices()[v].patch);
        return Gathered{found.irradiance, found.variance(reflectance), true};
    };
    std::vector<Gathered> values(vertices.size());
    const std::vector<Shared> groups = shared(tree, vertices);
    if (least_cosine_ <= 1.0 && groups.size() >= fewest_for_records)
        return by_records({tree, vertices, groups, field, first, end}, may_miss);
    each(groups.size(), [&](std::size_t g) {
        const Shared& group = groups[g];
        const std::uint32_t v = vertices[group.front()];
        const std::uint64_t key = mix(seed_ + 1, v);
        if (group.size() == 1) {
            const TreeVertex& vertex = tree.vertices()[v];
            values[group.front()] = value(
                v, gather_.indirect(point(vertex.patch, vertex.position), field, first, end, key));
            return;
        }
        std::vector<Vec3> normals;
        const GatherPoint at = shared_point(tree, vertices, group, normals);
        std::vector<PointGather::Indirect> found(group.size());
        gather_.indirect(at, normals, field, first, end, key, found);
        for (std::size_t k = 0; k < group.size(); ++k)
            values[group[k]] = value(vertices[group[k]], found[k]);
    });
    return values;
}

}  // namespace patchlight
