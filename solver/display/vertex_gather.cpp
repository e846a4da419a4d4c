#include "solver/display/vertex_gather.h"

#include "solver/form_factors/blocker_table.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

namespace patchlight {

namespace {

constexpr double inward = 1e-4;  // of the way to the patch's centre
/// Points between two looks at the clock, from 64 on: those beside many gaps take milliseconds.
constexpr std::size_t first_points = 64, fewest_points = 16, most_points = 4096;
constexpr double seconds_between = 0.02;
constexpr double most_pairs = 2e7;  // of patches and patches of sources that are looked at

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

std::size_t VertexGather::each(std::size_t count,
                               const std::function<void(std::size_t)>& at) const {
    std::size_t at_a_time = first_points;
    for (std::size_t first = 0, end = 0; first < count; first = end) {
        end = std::min(first + at_a_time, count);
        const auto began = std::chrono::steady_clock::now();
        tbb::parallel_for(first, end, at);
        if (go_on_ && !go_on_()) return end;
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        at_a_time = took.count() < seconds_between ? std::min(2 * at_a_time, most_points)
                                                   : std::max(at_a_time / 2, fewest_points);
    }
    return count;
}

std::vector<VertexGather::Gathered> VertexGather::direct(const RefinementTree& tree,
                                                         std::span<const std::uint32_t> vertices,
                                                         const DirectEffort& effort) const {
    std::vector<Gathered> values(vertices.size());
    values.resize(each(vertices.size(), [&](std::size_t k) {
        const TreeVertex& vertex = tree.vertices()[vertices[k]];
        const PointGather::Direct found =
            gather_.direct(point(vertex.patch, vertex.position), effort, mix(seed_, vertices[k]));
        const double y = luminance(reflectance_of(vertex.patch));
        values[k] = {found.irradiance, y * y * found.variance};
    }));
    return values;
}

std::vector<VertexGather::Gathered> VertexGather::indirect(const RefinementTree& tree,
                                                           std::span<const std::uint32_t> vertices,
                                                           const ReflectedField& field, int first,
                                                           int end) const {
    const auto value = [&](std::uint32_t v, const PointGather::Indirect& found) {
        const Rgb& reflectance = reflectance_of(tree.vertices()[v].patch);
        return Gathered{found.irradiance, found.variance(reflectance)};
    };
    std::vector<Gathered> values(vertices.size());
    const std::vector<Shared> groups = shared(tree, vertices);
    const std::size_t done = each(groups.size(), [&](std::size_t g) {
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
    if (done < groups.size()) {  // up to the first that is missing
        std::size_t whole = vertices.size();
        for (std::size_t g = done; g < groups.size(); ++g)
            whole = std::min<std::size_t>(whole, groups[g].front());
        values.resize(whole);
    }
    return values;
}

}  // namespace patchlight
