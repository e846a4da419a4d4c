#include "solver/accuracy/flux_regions.h"

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

/// A landing in the display.
struct Landed {
    std::uint32_t triangle = 0;
    std::uint32_t path = 0;
    float v = 0.0f, w = 0.0f;  // weights of the second and the third corner
    float y = 0.0f;            // Y(ρ Φ) [W]
    bool straight = false;
    /// By chance: low bits of a number say where in a Sobol sequence its point lies.
    bool decides() const { return mix(path, 0x64656369) % every == 0; }
};

constexpr std::uint32_t nowhere = 0xffffffffu;

std::vector<Landed> locate(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                           const DisplayMesh& display, const ParticleFlux& flux) {
    const DisplayedField field(scene, mesh, display);
    std::vector<Landed> landed(flux.landings.size());
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
                const auto place = field.locate(
                    from.surface,
                    rays.from_ray_space(from.position.cast<double>(), rays.frame(from.surface)));
                if (!place) continue;
                landed[k] = {place->triangle,
                             from.path,
                             static_cast<float>(place->weight[1]),
                             static_cast<float>(place->weight[2]),
                             static_cast<float>(y),
                             from.bounces == 0};
            }
        });
    std::erase_if(landed, [](const Landed& one) { return one.triangle == nowhere; });
    return landed;
}

/// A triangle, or a part of one, with what landed there.
struct Piece {
    std::array<Vec3, 3> corners;
    std::array<double, 3> shown{};  // Y(ρ H̃) at them [W/m²]
    double area = 0.0;
    std::vector<Landed> landed;  // weights are those of this piece
    double typical = 0.0;        // flux of a landing, weighted with itself [W]

    /// From its own landings, if they are enough to tell.
    void weigh(double otherwise) {
        constexpr std::size_t enough = 8;
        double sum = 0.0, square = 0.0;
        for (const Landed& one : landed) {
            sum += static_cast<double>(one.y);
            square += static_cast<double>(one.y) * static_cast<double>(one.y);
        }
        typical = landed.size() >= enough ? square / sum : otherwise;
    }
    std::size_t deciding() const {
        return static_cast<std::size_t>(std::count_if(
            landed.begin(), landed.end(), [](const Landed& one) { return one.decides(); }));
    }
    /// Number k of four: at corner k, or in the middle.
    Piece part(std::size_t k) const {
        const auto middle = [&](std::size_t a, std::size_t b) {
            return std::pair(Vec3(0.5 * (corners[a] + corners[b])), 0.5 * (shown[a] + shown[b]));
        };
        const std::array<std::pair<Vec3, double>, 3> middles{middle(0, 1), middle(1, 2),
                                                             middle(2, 0)};
        Piece piece;
        piece.area = 0.25 * area;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto& [position, value] = k == 3               ? middles[c]
                                            : c == k             ? std::pair(corners[k], shown[k])
                                            : (c == (k + 1) % 3) ? middles[k]
                                                                 : middles[(k + 2) % 3];
            piece.corners[c] = position;
            piece.shown[c] = value;
        }
        return piece;
    }
};

/// The four parts of a piece; landings go with them.
std::array<Piece, 4> cut(const Piece& piece) {
    std::array<Piece, 4> parts{piece.part(0), piece.part(1), piece.part(2), piece.part(3)};
    for (Landed one : piece.landed) {
        const std::array<float, 3> weight{1.0f - one.v - one.w, one.v, one.w};
        std::size_t k = 0;
        while (k < 3 && !(weight[k] > 0.5f)) ++k;
        std::array<float, 3> inside{};
        // In a corner's part the corner's weight is doubled less one; in the middle part, whose
        // corners lie opposite, each is one less twice the weight of the corner opposite.
        for (std::size_t c = 0; c < 3; ++c)
            inside[c] = k < 3 ? (c == k ? 2.0f * weight[c] - 1.0f : 2.0f * weight[c])
                              : 1.0f - 2.0f * weight[(c + 2) % 3];
        one.v = inside[1];
        one.w = inside[2];
        parts[k].landed.push_back(one);
    }
    return parts;
}

struct Sorter {
    const Scene& scene;
    const PatchMesh& mesh;
    const TreeDisplay& shown;
    std::size_t wanted;  // deciding landings of a region
    double typical;      // flux of a landing anywhere, weighted with itself [W]
    std::vector<FluxRegion> regions = {};
    FluxRegion open = {};  // that triangles are added to
    std::size_t open_deciding = 0;
    double open_variance = 0.0;  // that what is shown would have
    std::vector<Landed> open_landed = {};

    double shown_at(std::uint32_t vertex, const Rgb& reflectance) const {
        Rgb arriving = shown.arriving.indirect[vertex];
        if (!shown.arriving.direct.empty()) arriving += shown.arriving.direct[vertex];
        return luminance(reflectance * arriving.max(0.0));
    }

    Piece piece_of(std::uint32_t t) const {
        const auto& corners = shown.display.triangles[t];
        const Rgb& reflectance =
            scene.materials[scene.surfaces[surface_of(t)].material].reflectance;
        Piece piece;
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
    void add(const Piece& piece, std::uint32_t t) {
        open.area += piece.area;
        open.shown += piece.area * (piece.shown[0] + piece.shown[1] + piece.shown[2]) / 3.0;
        open.surface = surface_of(t);
        open.patch = shown.display.patch[t];
        open.centre = (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
        open.radius = 0.0;
        for (const Vec3& corner : piece.corners)
            open.radius = std::max(open.radius, (corner - open.centre).norm());
        open_landed.insert(open_landed.end(), piece.landed.begin(), piece.landed.end());
        open_deciding += piece.deciding();
        open_variance +=
            piece.typical * piece.area * (piece.shown[0] + piece.shown[1] + piece.shown[2]) / 3.0;
    }

    /// Only particles that did not decide count; landings of one path are no evidence of their own.
    void close(bool inside_triangle) {
        if (open.area > 0.0) {
            constexpr double scale =
                static_cast<double>(every) / (static_cast<double>(every) - 1.0);
            std::stable_sort(open_landed.begin(), open_landed.end(),
                             [](const Landed& a, const Landed& b) { return a.path < b.path; });
            double of_path = 0.0;
            for (std::size_t k = 0; k < open_landed.size(); ++k) {
                const Landed& one = open_landed[k];
                if (one.decides()) continue;
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
        open_deciding = 0;
        open_variance = 0.0;
        open_landed.clear();
    }

    void take_apart(const Piece& piece, std::uint32_t t, int level) {
        if (level < most_levels && piece.deciding() >= 2 * wanted) {
            std::array<Piece, 4> parts = cut(piece);
            for (Piece& part : parts) {
                part.weigh(piece.typical);
                take_apart(part, t, level + 1);
            }
            return;
        }
        Sorter alone{scene, mesh, shown, wanted, typical};  // what is open goes on beside it
        alone.add(piece, t);
        alone.close(true);
        regions.insert(regions.end(), alone.regions.begin(), alone.regions.end());
    }

    void take(Piece piece, std::uint32_t t) {
        piece.weigh(typical);
        if (piece.deciding() >= 2 * wanted) {
            take_apart(piece, t, 0);
            return;
        }
        add(piece, t);
        if (open_deciding >= wanted) close(false);
    }
};

}  // namespace

std::vector<FluxRegion> make_flux_regions(const Scene& scene, const PatchMesh& mesh,
                                          const RayScene& rays, const TreeDisplay& shown,
                                          const ParticleFlux& flux, int landings) {
    std::vector<Landed> landed = locate(scene, mesh, rays, shown.display, flux);
    double sum = 0.0, square = 0.0;
    for (const Landed& one : landed) {
        sum += static_cast<double>(one.y);
        square += static_cast<double>(one.y) * static_cast<double>(one.y);
    }
    const std::size_t triangles = shown.display.triangles.size();
    std::vector<std::uint32_t> first(triangles + 1, 0);  // landings sorted by triangle
    for (const Landed& one : landed) ++first[one.triangle + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> order(landed.size());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t k = 0; k < landed.size(); ++k) order[next[landed[k].triangle]++] = k;
    Sorter sorter{scene, mesh, shown, static_cast<std::size_t>(std::max(1, landings)),
                  landed.empty() ? 0.0 : square / sum};
    std::vector<std::uint32_t> sorted(triangles);
    std::iota(sorted.begin(), sorted.end(), 0u);
    const auto key = [&](std::uint32_t t) {
        const Surface& surface = scene.surfaces[sorter.surface_of(t)];
        return std::tuple(surface.material, surface.object, shown.display.patch[t], t);
    };
    std::sort(sorted.begin(), sorted.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    MaterialIndex material = 0;
    for (const std::uint32_t t : sorted) {
        const MaterialIndex m = scene.surfaces[sorter.surface_of(t)].material;
        if (std::exchange(material, m) != m) sorter.close(false);
        if (!(scene.materials[m].reflectance > 0.0).any()) continue;
        Piece piece = sorter.piece_of(t);
        for (std::uint32_t k = first[t]; k < first[t + 1]; ++k)
            piece.landed.push_back(landed[order[k]]);
        sorter.take(std::move(piece), t);
    }
    sorter.close(false);
    return std::move(sorter.regions);
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
