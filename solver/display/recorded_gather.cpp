#include "solver/display/vertex_gather.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t places_per_record = 32, fewest_records = 1000;  // to begin with
constexpr float raised = 0.1f;  // of the distance between two places, that are looked at above
constexpr double tilt = 0.2;    // by which normals are moved to see what that changes [rad]

}  // namespace

GatherPoint VertexGather::point_of(const Request& request, const Shared& group) const {
    const TreeVertex& vertex = request.tree.vertices()[request.vertices[group.front()]];
    std::vector<Vec3> normals;
    return group.size() > 1 ? shared_point(request.tree, request.vertices, group, normals)
                            : point(vertex.patch, vertex.position);
}

/// Whether nothing is between two points, raised by a share of how far they are apart: what lies
/// on a surface and is lower hides nothing of its light.
bool VertexGather::sees(const GatherPoint& a, const GatherPoint& b) const {
    const RayPoint shift = rays_.shift(b.frame, a.frame).cast<float>();
    const auto raise = raised * (b.origin + shift - a.origin).norm();
    const RayPoint from = a.origin + raise * a.normal.cast<float>(),
                   to = b.origin + raise * b.normal.cast<float>();
    RayBatch batch;
    RayScene::set_segment(batch, 0, from, a.frame, to + shift - from, to, b.frame);
    return (rays_.blocked(batch, 1) & 1u) == 0;
}

/// Irradiance at the place of a group of vertices, on a surface that faces as they do on average
/// and on ones that are tilted each way.
IrradianceRecord VertexGather::record(const Request& request, const Shared& group) const {
    const std::uint32_t v = request.vertices[group.front()];
    const TreeVertex& vertex = request.tree.vertices()[v];
    const GatherPoint at = point_of(request, group);
    IrradianceRecord record;
    record.position = vertex.position;
    record.normal = at.normal;
    record.axis[0] = at.normal.unitOrthogonal();
    record.axis[1] = at.normal.cross(record.axis[0]);
    const std::uint64_t key = mix(seed_ + 1, v);
    const Rgb& reflectance = reflectance_of(vertex.patch);
    record.known = true;
    if (group.size() == 1) {  // a plane, where no neighbour is tilted
        const PointGather::Indirect found =
            gather_.indirect(at, request.field, request.first, request.end, key);
        record.irradiance = found.irradiance;
        record.variance = found.variance(reflectance);
        return record;
    }
    std::array<Vec3, 5> facing{at.normal};
    for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t sign = 0; sign < 2; ++sign)
            facing[1 + 2 * a + sign] = std::cos(tilt) * at.normal +
                                       (sign == 0 ? 1.0 : -1.0) * std::sin(tilt) * record.axis[a];
    std::array<PointGather::Indirect, 5> found;
    gather_.indirect(at, facing, request.field, request.first, request.end, key, found);
    record.irradiance = found[0].irradiance;
    for (std::size_t a = 0; a < 2; ++a)
        record.by_tilt[a] =
            (found[1 + 2 * a].irradiance - found[2 + 2 * a].irradiance) / (2.0 * std::sin(tilt));
    record.variance = found[0].variance(reflectance);
    return record;
}

std::vector<VertexGather::Gathered> VertexGather::by_records(const Request& request,
                                                             double may_miss) const {
    std::vector<double> area(request.tree.vertices().size(), 0.0);  // round each vertex [m²]
    for (const TreeElement& element : request.tree.elements()) {
        if (!element.is_leaf()) continue;
        const std::size_t n = element.corner_count();
        for (std::size_t k = 0; k < n; ++k)
            area[element.vertices[k]] += element.area / static_cast<double>(n);
    }
    const auto normal_of = [&](std::uint32_t k) -> const Vec3& {
        return scene_.surfaces[surface_of(request.tree.vertices()[request.vertices[k]].patch)]
            .normal;
    };
    std::vector<FacingPlace> places;
    std::vector<double> reflectance;
    for (const Shared& group : request.groups) {
        const TreeVertex& vertex = request.tree.vertices()[request.vertices[group.front()]];
        FacingPlace place{vertex.position, Vec3::Zero(), 0.0};
        double most = 0.0;
        for (const std::uint32_t k : group) {
            const std::uint32_t v = request.vertices[k];
            place.normal += normal_of(k);
            place.area += area[v];
            most = std::max(most, luminance(reflectance_of(request.tree.vertices()[v].patch)));
        }
        place.normal.normalize();
        places.push_back(place);
        reflectance.push_back(most);
    }
    const IrradianceRecords::Gather gather = [&](std::span<const std::uint32_t> wanted) {
        std::vector<IrradianceRecord> records(wanted.size());
        each(wanted.size(),
             [&](std::size_t k) { records[k] = record(request, request.groups[wanted[k]]); });
        return records;
    };
    std::vector<GatherPoint> points(request.groups.size());
    tbb::parallel_for(std::size_t{0}, points.size(),
                      [&](std::size_t g) { points[g] = point_of(request, request.groups[g]); });
    const IrradianceRecords::Sees seen = [&](std::uint32_t a, std::uint32_t b) {
        return sees(points[a], points[b]);
    };
    const IrradianceRecords records(
        places,
        {may_miss, std::max(fewest_records, places.size() / places_per_record), reflectance},
        gather, seen);
    std::vector<Gathered> values(request.vertices.size());
    each(request.groups.size(), [&](std::size_t g) {
        for (const std::uint32_t k : request.groups[g]) {
            const auto [irradiance, variance, known] =
                records.at(static_cast<std::uint32_t>(g), normal_of(k));
            values[k] = {irradiance, variance, known && records.complete()};
        }
    });
    return values;
}

}  // namespace patchlight
