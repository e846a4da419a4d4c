#include "solver/accuracy/flux_regions.h"

#include "solver/accuracy/flux_piece.h"
#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

constexpr std::uint64_t every = 4;  // one particle of so many says where regions are
constexpr int most_levels = 10;     // of cutting a triangle
constexpr std::size_t at_a_time = 4096;

/// By chance: low bits of a number say where in a Sobol sequence its point lies.
bool decides(std::uint32_t path) { return mix(path, 0x64656369) % every == 0; }

constexpr std::uint32_t nowhere = 0xffffffffu;

std::vector<LandingShown> locate(const Scene& scene, const ShownPlaces& places,
                                 const ParticleFlux& flux) {
    std::vector<LandingShown> landed(flux.landings.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, landed.size(), at_a_time), [&](const auto& range) {
            for (std::size_t k = range.begin(); k < range.end(); ++k) {
                const ParticleLanding& from = flux.landings[k];
                const Rgb& reflectance =
                    scene.materials[scene.surfaces[from.surface].material].reflectance;
                const double y = luminance(reflectance * Rgb(static_cast<double>(from.flux[0]),
                                                             static_cast<double>(from.flux[1]),
                                                             static_cast<double>(from.flux[2])));
                landed[k].triangle = nowhere;
                if (!(y > 0.0)) continue;
                const auto place = places.find(from.surface, from.position);
                if (!place) continue;
                landed[k] = {place->triangle,
                             from.path,
                             static_cast<float>(place->weight[1]),
                             static_cast<float>(place->weight[2]),
                             static_cast<float>(y),
                             from.bounces == 0,
                             decides(from.path)};
            }
        });
    std::erase_if(landed, [](const LandingShown& one) { return one.triangle == nowhere; });
    return landed;
}

/// Triangles of one region, or one to be taken apart.
struct TriangleGroup {
    std::vector<std::uint32_t> triangles;
    bool apart = false;
};

/// Those of one material, object by object, patch by patch.
std::vector<TriangleGroup> group_triangles(const Scene& scene, const PatchMesh& mesh,
                                           const DisplayMesh& display,
                                           const std::vector<std::uint32_t>& deciding,
                                           std::size_t wanted) {
    std::vector<PatchIndex> patches(mesh.size());
    std::iota(patches.begin(), patches.end(), PatchIndex{0});
    const auto key = [&](PatchIndex i) {
        const Surface& surface = scene.surfaces[mesh.patches[i].surface];
        return std::tuple(surface.material, surface.object, i);
    };
    std::sort(patches.begin(), patches.end(),
              [&](PatchIndex a, PatchIndex b) { return key(a) < key(b); });
    std::vector<std::uint32_t> first(mesh.size() + 1, 0);  // triangles sorted by patch
    for (const PatchIndex i : display.patch) ++first[i + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> sorted(display.triangles.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < sorted.size(); ++t) sorted[next[display.patch[t]]++] = t;
    std::vector<TriangleGroup> groups;
    TriangleGroup open;
    std::size_t open_deciding = 0;
    const auto close = [&] {
        if (!open.triangles.empty()) groups.push_back(std::exchange(open, {}));
        open_deciding = 0;
    };
    MaterialIndex material = 0;
    for (const PatchIndex i : patches) {
        const MaterialIndex m = scene.surfaces[mesh.patches[i].surface].material;
        if (std::exchange(material, m) != m) close();
        if (!(scene.materials[m].reflectance > 0.0).any()) continue;
        for (std::uint32_t k = first[i]; k < first[i + 1]; ++k) {
            const std::uint32_t t = sorted[k];
            if (deciding[t] >= 2 * wanted) {
                groups.push_back({{t}, true});
                continue;
            }
            open.triangles.push_back(t);
            open_deciding += deciding[t];
            if (open_deciding >= wanted) close();
        }
    }
    close();
    return groups;
}

struct RegionMaker {
    const Scene& scene;
    const PatchMesh& mesh;
    const TreeDisplay& shown;
    std::size_t wanted;  // deciding landings of a region
    double typical;      // flux of a landing anywhere, weighted with itself [W]
    std::vector<FluxRegion> regions = {};
    FluxRegion open = {};        // that triangles are added to
    double open_variance = 0.0;  // that what is shown would have
    std::vector<LandingShown> open_landed = {};

    double shown_at(std::uint32_t vertex, const Rgb& reflectance) const {
        Rgb arriving = shown.arriving.indirect[vertex];
        if (!shown.arriving.direct.empty()) arriving += shown.arriving.direct[vertex];
        return luminance(reflectance * arriving.max(0.0));
    }

    FluxPiece piece_of(std::uint32_t t) const {
        const auto& corners = shown.display.triangles[t];
        const Rgb& reflectance =
            scene.materials[scene.surfaces[surface_of(t)].material].reflectance;
        FluxPiece piece;
        for (std::size_t k = 0; k < 3; ++k) {
            piece.corners[k] = shown.display.positions[corners[k]];
            piece.shown[k] = shown_at(corners[k], reflectance);
        }
        piece.area =
            0.5 *
            (piece.corners[1] - piece.corners[0]).cross(piece.corners[2] - piece.corners[0]).norm();
        return piece;
    }
    SurfaceIndex surface_of(std::uint32_t t) const {
        return mesh.patches[shown.display.patch[t]].surface;
    }

    /// Adds a piece to the region that is open.
    void add(const FluxPiece& piece, std::uint32_t t) {
        open.area += piece.area;
        open.shown += piece.area * (piece.shown[0] + piece.shown[1] + piece.shown[2]) / 3.0;
        open.surface = surface_of(t);
        open.patch = shown.display.patch[t];
        open.centre = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
        open.radius = 0.0;
        for (const Vec3& corner : piece.corners)
            open.radius = std::max(open.radius, (corner - open.centre).norm());
        open_landed.insert(open_landed.end(), piece.landed.begin(), piece.landed.end());
        open_variance +=
            piece.typical * piece.area * (piece.shown[0] + piece.shown[1] + piece.shown[2]) / 3.0;
    }

    /// Only particles that did not decide count; landings of one path are no evidence of their own.
    void close(bool inside_triangle) {
        if (open.area > 0.0) {
            constexpr double scale =
                static_cast<double>(every) / (static_cast<double>(every) - 1.0);
            std::stable_sort(
                open_landed.begin(), open_landed.end(),
                [](const LandingShown& a, const LandingShown& b) { return a.path < b.path; });
            double of_path = 0.0;
            for (std::size_t k = 0; k < open_landed.size(); ++k) {
                const LandingShown& one = open_landed[k];
                if (one.decides) continue;
                const double y = scale * static_cast<double>(one.y);
                open.landed += y;
                if (one.straight) open.straight += y;
                of_path += y;
                if (k + 1 < open_landed.size() && open_landed[k + 1].path == one.path) continue;
                open.variance += of_path * of_path;
                of_path = 0.0;
            }
            // No landings are no certainty: as many as shown might have come, by chance.
            open.variance = std::max(open.variance, scale * open_variance);
            open.inside_triangle = inside_triangle;
            regions.push_back(open);
        }
        open = {};
        open_variance = 0.0;
        open_landed.clear();
    }

    void take_apart(const FluxPiece& piece, std::uint32_t t, int level) {
        if (level < most_levels && piece.deciding() >= 2 * wanted) {
            std::array<FluxPiece, 4> parts = cut(piece);
            for (FluxPiece& part : parts) {
                part.weigh(piece.typical);
                take_apart(part, t, level + 1);
            }
            return;
        }
        RegionMaker alone{scene, mesh, shown, wanted, typical};  // what is open goes on beside it
        alone.add(piece, t);
        alone.close(true);
        regions.insert(regions.end(), alone.regions.begin(), alone.regions.end());
    }
};

}  // namespace

std::vector<FluxRegion> make_flux_regions(const Scene& scene, const PatchMesh& mesh,
                                          const TreeDisplay& shown, const ShownPlaces& places,
                                          const ParticleFlux& flux, int landings) {
    std::vector<LandingShown> landed = locate(scene, places, flux);
    double sum = 0.0, square = 0.0;
    for (const LandingShown& one : landed) {
        sum += static_cast<double>(one.y);
        square += static_cast<double>(one.y) * static_cast<double>(one.y);
    }
    const std::size_t triangles = shown.display.triangles.size();
    std::vector<std::uint32_t> first(triangles + 1, 0), deciding(triangles, 0);
    for (const LandingShown& one : landed) {
        ++first[one.triangle + 1];
        deciding[one.triangle] += one.decides ? 1 : 0;
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> order(landed.size());  // sorted by triangle
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t k = 0; k < landed.size(); ++k) order[next[landed[k].triangle]++] = k;
    const auto wanted = static_cast<std::size_t>(std::max(1, landings));
    const std::vector<TriangleGroup> groups =
        group_triangles(scene, mesh, shown.display, deciding, wanted);
    std::vector<std::vector<FluxRegion>> of_group(groups.size());
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t g) {
        RegionMaker maker{scene, mesh, shown, wanted, landed.empty() ? 0.0 : square / sum};
        for (const std::uint32_t t : groups[g].triangles) {
            FluxPiece piece = maker.piece_of(t);
            piece.landed.reserve(first[t + 1] - first[t]);
            for (std::uint32_t k = first[t]; k < first[t + 1]; ++k)
                piece.landed.push_back(landed[order[k]]);
            piece.weigh(maker.typical);
            if (groups[g].apart)
                maker.take_apart(piece, t, 0);
            else
                maker.add(piece, t);
        }
        maker.close(false);
        of_group[g] = std::move(maker.regions);
    });
    std::vector<FluxRegion> regions;
    for (const auto& of : of_group) regions.insert(regions.end(), of.begin(), of.end());
    return regions;
}

TransportCheck compare_flux(const std::vector<FluxRegion>& regions, double norm) {
    TransportCheck check;
    double proven = 0.0, square = 0.0, variance = 0.0;
    for (const FluxRegion& region : regions) {
        const double miss = region.landed - region.shown,
                     beyond = std::max(0.0, std::abs(miss) - 2.0 * std::sqrt(region.variance));
        proven += beyond * beyond / region.area;
        square += (miss * miss - region.variance) / region.area;
        variance += (2.0 * region.variance + 4.0 * std::max(0.0, miss * miss - region.variance)) *
                    region.variance / (region.area * region.area);
    }
    square = std::max(0.0, square);
    check.proven = std::sqrt(proven) / norm;
    check.difference = std::sqrt(square) / norm;
    check.standard_error = (std::sqrt(square + std::sqrt(variance)) - std::sqrt(square)) / norm;
    return check;
}

}  // namespace patchlight
