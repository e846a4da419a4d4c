#include "solver/display/field_table.h"

#include "solver/scene/polygon.h"

#include <oneapi/tbb/parallel_for.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>

namespace patchlight {

namespace {

constexpr std::size_t most_cells = 4'000'000;
constexpr std::size_t usual = 16, finest = 128;  // cells along each direction of a patch
constexpr std::size_t cells_per_triangle = 2;    // of the display, where that is more

/// Cells along each direction of every patch, powers of two.
std::vector<std::size_t> cells_along(const PatchMesh& mesh, const DisplayMesh& display) {
    std::vector<std::size_t> count(mesh.size(), usual), triangles(mesh.size(), 0);
    for (const PatchIndex i : display.patch) ++triangles[i];
    std::size_t cells = 0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        while (count[i] < finest && count[i] * count[i] < cells_per_triangle * triangles[i])
            count[i] *= 2;
        cells += count[i] * count[i];
    }
    for (; cells > most_cells && cells > mesh.size(); cells = cells / 4 + 1)
        for (std::size_t& along : count) along = std::max<std::size_t>(1, along / 2);
    return count;
}

std::vector<std::vector<std::uint32_t>> by_patch(const DisplayMesh& display, std::size_t patches) {
    std::vector<std::vector<std::uint32_t>> triangles(patches);
    for (std::uint32_t t = 0; t < display.triangles.size(); ++t)
        triangles[display.patch[t]].push_back(t);
    return triangles;
}

/// Of the parallelogram about a patch, along its first edge and its last: (p - origin)·u counts
/// cells along the one, ·v along the other.
struct Axes {
    Vec3 origin, e1, e2, u, v;
    bool is_skew = false;  // the patch does not fill it, and is no triangle

    Axes(const PatchMesh& mesh, PatchIndex i, std::size_t count) {
        const Patch& patch = mesh.patches[i];
        origin = mesh.vertices[patch.vertices[0]];
        e1 = mesh.vertices[patch.vertices[1]] - origin;
        e2 = mesh.vertices[patch.vertices[patch.corner_count() - 1]] - origin;
        set_scale(1);
        if (!patch.is_triangle()) {
            Vec2 low = Vec2::Zero(), high = Vec2::Ones();
            const Vec2 opposite = at(mesh.vertices[patch.vertices[2]]);
            constexpr double rounding = 1e-6;
            is_skew = (opposite - high).cwiseAbs().maxCoeff() > rounding;
            if (is_skew) {
                low = low.cwiseMin(opposite);
                high = high.cwiseMax(opposite);
                origin += low.x() * e1 + low.y() * e2;
                e1 *= high.x() - low.x();
                e2 *= high.y() - low.y();
            }
        }
        set_scale(count);
    }
    void set_scale(std::size_t count) {
        const double g11 = e1.dot(e1), g12 = e1.dot(e2), g22 = e2.dot(e2);
        const double det = g11 * g22 - g12 * g12;
        const double scale = det > 0.0 ? static_cast<double>(count) / det : 0.0;
        u = scale * (g22 * e1 - g12 * e2);
        v = scale * (g11 * e2 - g12 * e1);
    }
    Vec2 at(const Vec3& p) const { return {(p - origin).dot(u), (p - origin).dot(v)}; }
};

}  // namespace

/// Adds triangles to the cells of a patch: to those whose centres it covers, or to the one it is
/// in.
struct FieldTable::Filler {
    std::size_t count = 1;                        // cells along each direction
    std::vector<std::array<double, 4>> sum = {};  // per cell: weighted values, weight

    std::size_t cell(double u) const {
        return std::min(static_cast<std::size_t>(std::max(0.0, u)), count - 1);
    }

    void add(const Vec2& at, const Rgb& value, double weight) {
        auto& entry = sum[cell(at.y()) * count + cell(at.x())];
        for (std::size_t c = 0; c < 3; ++c)
            entry[c] += weight * value[static_cast<Eigen::Index>(c)];
        entry[3] += weight;
    }

    void add_triangle(const std::array<Vec2, 3>& p, const std::array<Rgb, 3>& value) {
        const double twice = turn(p[0], p[1], p[2]);
        if (!(twice > 0.0)) return;
        const Vec2 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]),
                   high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
        bool any = false;
        for (std::size_t j = cell(low.y()); j <= cell(high.y()); ++j)
            for (std::size_t i = cell(low.x()); i <= cell(high.x()); ++i) {
                const Vec2 centre(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5);
                const double b = turn(p[2], p[0], centre) / twice,
                             c = turn(p[0], p[1], centre) / twice;
                if (b < 0.0 || c < 0.0 || b + c > 1.0) continue;
                any = true;
                add(centre, value[0] + b * (value[1] - value[0]) + c * (value[2] - value[0]),
                    twice);
            }
        if (!any) add((p[0] + p[1] + p[2]) / 3.0, (value[0] + value[1] + value[2]) / 3.0, twice);
    }

    /// Cells whose middles lie beside the patch are looked up at its edges: they hold what the
    /// nearest of their row do, rows without any what a row beside does.
    void write(std::array<float, 3>* cells) const {
        std::size_t empty_rows = 0;  // at the beginning
        for (std::size_t row = 0; row < count; ++row) {
            std::array<float, 3>* of_row = cells + row * count;
            std::optional<std::size_t> last;
            for (std::size_t c = 0; c < count; ++c) {
                const std::array<double, 4>& entry = sum[row * count + c];
                if (!(entry[3] > 0.0)) continue;
                for (std::size_t k = 0; k < 3; ++k)
                    of_row[c][k] = static_cast<float>(entry[k] / entry[3]);
                for (std::size_t empty = last ? *last + 1 : 0; empty < c; ++empty)
                    of_row[empty] = of_row[last && 2 * empty < *last + c ? *last : c];
                last = c;
            }
            if (last)
                std::fill(of_row + *last, of_row + count, of_row[*last]);
            else if (row > empty_rows)
                std::copy(of_row - count, of_row, of_row);
            else
                ++empty_rows;
        }
        for (std::size_t row = empty_rows; row-- > 0 && empty_rows < count;)
            std::copy(cells + (row + 1) * count, cells + (row + 2) * count, cells + row * count);
    }
};

FieldTable::FieldTable(const PatchMesh& mesh, const DisplayMesh& display, const RayScene& rays,
                       const std::vector<Rgb>& values, const std::vector<Rgb>& without)
    : mesh_(mesh), rays_(rays), frames_(mesh.size()) {
    const std::vector<std::size_t> count = cells_along(mesh, display);
    std::vector<Axes> axes;
    std::size_t cells = 0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        axes.emplace_back(mesh, i, count[i]);
        const Vec3 across = axes[i].e1.cross(axes[i].e2);
        const double side = rays.scale() / static_cast<double>(count[i]);
        areas_.push_back(across.norm() * side * side);
        const RayPoint o = rays.to_ray_space(axes[i].origin, rays.frame(mesh.patches[i].surface)),
                       u = (axes[i].u / rays.scale()).cast<float>(),
                       v = (axes[i].v / rays.scale()).cast<float>();
        frames_[i] = {o.x(), o.y(), o.z(), u.x(), u.y(),   u.z(),
                      v.x(), v.y(), v.z(), cells, count[i]};
        edges_.push_back({o, (rays.scale() * axes[i].e1).cast<float>(),
                          (rays.scale() * axes[i].e2).cast<float>()});
        if (axes[i].is_skew) {
            Outline& outline = outlines_[i];
            for (std::size_t k = 0; k < outline.size(); ++k)
                outline[k] = (axes[i].at(mesh.vertices[mesh.patches[i].vertices[k]]) /
                              static_cast<double>(count[i]))
                                 .cast<float>();
        }
        cells += count[i] * count[i];
    }
    cells_.resize(cells);
    const std::vector<std::vector<std::uint32_t>> triangles = by_patch(display, mesh.size());
    tbb::parallel_for(std::size_t{0}, mesh.size(), [&](std::size_t i) {
        Filler filler{count[i]};
        filler.sum.resize(count[i] * count[i]);
        const Rgb less = without.empty() ? Rgb(Rgb::Zero()) : without[i];
        const auto value = [&](std::uint32_t v) {
            return without.empty() ? values[v] : Rgb((values[v] - less).max(0.0));
        };
        for (const std::uint32_t t : triangles[i]) {
            const auto [a, b, c] = display.triangles[t];
            filler.add_triangle({axes[i].at(display.positions[a]), axes[i].at(display.positions[b]),
                                 axes[i].at(display.positions[c])},
                                {value(a), value(b), value(c)});
        }
        filler.write(&cells_[frames_[i].first]);
    });
}

void FieldTable::add_linear(PatchIndex i, const Rgb& value, const Eigen::Matrix3d& slope) {
    const Vec3& centroid = mesh_.patches[i].centre;
    for (std::size_t c = first_cell(i); c < end_cell(i); ++c) {
        const RayPoint middle = spot(i, c, 0.5f, 0.5f).position;
        const Vec3 away =
            rays_.from_ray_space(middle.cast<double>(), rays_.frame(mesh_.patches[i].surface)) -
            centroid;
        const Rgb more = value + (slope * away).array();
        for (std::size_t k = 0; k < 3; ++k)
            cells_[c][k] = std::max(
                0.0f, cells_[c][k] + static_cast<float>(more[static_cast<Eigen::Index>(k)]));
    }
}

bool FieldTable::is_on_patch(PatchIndex i, float u, float v) const {
    if (mesh_.patches[i].is_triangle()) return u + v <= 1.0f;
    const auto found = outlines_.find(i);
    if (found == outlines_.end()) return true;
    const Outline& outline = found->second;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Eigen::Vector2f &a = outline[k], along = outline[(k + 1) % outline.size()] - a;
        if (along.x() * (v - a.y()) - along.y() * (u - a.x()) < 0.0f) return false;
    }
    return true;
}

FieldTable::Spot FieldTable::spot(PatchIndex i, std::size_t cell, float u, float v) const {
    const std::size_t count = frames_[i].count, number = cell - frames_[i].first;
    const auto along = static_cast<float>(count);
    const Edges& edges = edges_[i];
    const float a = (static_cast<float>(number % count) + u) / along,
                b = (static_cast<float>(number / count) + v) / along;
    return {edges.origin + a * edges.first + b * edges.last, is_on_patch(i, a, b)};
}

}  // namespace patchlight
