#include "solver/scene/local_frames.h"

#include <array>
#include <cmath>
#include <utility>

namespace patchlight {

namespace {

/// An object smaller than this share of its distance from the origin wants a nearer one: four steps
/// of float32 are then 1/4096 of its size [1].
constexpr double small_share = 1.0 / 512.0;
/// Of an object of many surfaces: their number along it up to which it is large as a whole [1].
constexpr double many = 16.0;
constexpr double shrinks = 0.5;         // of a frame's radius, that a smaller one has at most [1]
constexpr double neighbourhood = 16.0;  // of a frame's radius, round its box, and the size of
                                        // what is at home there, too [1]

struct Cell {
    std::vector<SurfaceIndex> surfaces;
    Box3 box;
};

/// What has to be told apart of each surface: its size, or that of the object it is a small part
/// of. A statue of ten thousand triangles is as large as a statue; a stray triangle far off does
/// not make its object large.
std::vector<double> feature_sizes(const Scene& scene, const std::vector<Box3>& boxes) {
    std::vector<std::vector<double>> sizes(scene.objects.size());
    for (SurfaceIndex s = 0; s < boxes.size(); ++s)
        sizes[scene.surfaces[s].object].push_back(boxes[s].diagonal().norm());
    std::vector<double> middle(scene.objects.size(), 0.0);
    for (std::size_t o = 0; o < sizes.size(); ++o) {
        if (sizes[o].empty()) continue;
        const auto half = sizes[o].begin() + static_cast<std::ptrdiff_t>(sizes[o].size() / 2);
        std::nth_element(sizes[o].begin(), half, sizes[o].end());
        middle[o] = *half;
    }
    std::vector<Box3> whole(scene.objects.size());
    for (SurfaceIndex s = 0; s < boxes.size(); ++s) {
        const ObjectIndex o = scene.surfaces[s].object;
        if (boxes[s].diagonal().norm() <= 4.0 * many * middle[o]) whole[o].extend(boxes[s]);
    }
    std::vector<double> features(boxes.size());
    for (SurfaceIndex s = 0; s < boxes.size(); ++s) {
        const ObjectIndex o = scene.surfaces[s].object;
        const double extent = whole[o].isEmpty() ? 0.0 : whole[o].diagonal().norm();
        features[s] = std::max(boxes[s].diagonal().norm(),
                               std::min(std::sqrt(extent * middle[o]), many * middle[o]));
    }
    return features;
}

Cell cell_of(std::vector<SurfaceIndex> surfaces, const std::vector<Box3>& boxes) {
    Cell cell{std::move(surfaces), {}};
    for (const SurfaceIndex s : cell.surfaces) cell.box.extend(boxes[s]);
    return cell;
}

/// Those that are small in a cell: one cell if that is much smaller, else up to eight.
std::vector<Cell> smaller_cells(std::vector<SurfaceIndex> small, double radius,
                                const std::vector<Box3>& boxes) {
    std::vector<Cell> cells;
    Cell all = cell_of(std::move(small), boxes);
    if (0.5 * all.box.sizes().maxCoeff() <= shrinks * radius) {
        cells.push_back(std::move(all));
        return cells;
    }
    const Vec3 sizes = all.box.sizes();
    const auto is_long = [&](int axis) { return sizes[axis] > shrinks * sizes.maxCoeff(); };
    std::array<std::vector<SurfaceIndex>, 8> parts;
    for (const SurfaceIndex s : all.surfaces) {
        const Vec3 away = boxes[s].center() - all.box.center();
        std::size_t part = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (is_long(axis) && away[axis] > 0.0) part |= std::size_t{1} << axis;
        parts[part].push_back(s);
    }
    for (auto& part : parts)
        if (!part.empty()) cells.push_back(cell_of(std::move(part), boxes));
    return cells;
}

/// Surfaces that reach into the neighbourhood of a smaller frame belong there, unless too large.
void invite_guests(const Scene& scene, const std::vector<Box3>& boxes,
                   const std::vector<bool>& settled, LocalFrames& found) {
    std::vector<FrameIndex> by_radius(found.frames.size());
    for (std::size_t f = 0; f < by_radius.size(); ++f) by_radius[f] = static_cast<FrameIndex>(f);
    std::stable_sort(by_radius.begin(), by_radius.end(), [&](FrameIndex a, FrameIndex b) {
        return found.frames[a].radius() < found.frames[b].radius();
    });
    for (SurfaceIndex s = 0; s < boxes.size(); ++s) {
        if (settled[s]) continue;
        if (scene.surfaces[s].cut_from_larger) {  // about one of them
            const auto away = [&](FrameIndex f) {
                return std::max(boxes[s].exteriorDistance(found.frames[f].origin()),
                                found.frames[f].radius());
            };
            found.of_surface[s] =
                *std::min_element(by_radius.begin(), by_radius.end(),
                                  [&](FrameIndex a, FrameIndex b) { return away(a) < away(b); });
            continue;
        }
        for (const FrameIndex f : by_radius) {
            const LocalFrame& frame = found.frames[f];
            const double margin = neighbourhood * frame.radius();
            const Box3 near(frame.box.min().array() - margin, frame.box.max().array() + margin);
            if (boxes[s].diagonal().norm() > margin || !near.intersects(boxes[s])) continue;
            found.of_surface[s] = f;
            break;
        }
    }
}

}  // namespace

std::vector<Box3> surface_boxes(const Scene& scene) {
    std::vector<Box3> boxes(scene.surfaces.size());
    for (SurfaceIndex s = 0; s < boxes.size(); ++s)
        for (const Vec3& p : scene.surfaces[s].corners) boxes[s].extend(p);
    return boxes;
}

LocalFrames find_local_frames(const Scene& scene, const std::vector<Box3>& boxes) {
    LocalFrames found{{}, std::vector<FrameIndex>(boxes.size(), 0)};
    if (boxes.empty()) {
        found.frames.push_back({});
        return found;
    }
    const std::vector<double> features = feature_sizes(scene, boxes);
    std::vector<SurfaceIndex> all(boxes.size());
    for (SurfaceIndex s = 0; s < all.size(); ++s) all[s] = s;
    std::vector<Cell> waiting{cell_of(std::move(all), boxes)};
    std::vector<bool> settled(boxes.size(), false);  // small surfaces are where they need to be
    for (std::size_t next = 0; next < waiting.size(); ++next) {
        const double radius = 0.5 * waiting[next].box.sizes().maxCoeff();
        std::vector<SurfaceIndex> small, large;
        for (const SurfaceIndex s : waiting[next].surfaces)
            (features[s] < small_share * radius && !scene.surfaces[s].cut_from_larger ? small
                                                                                      : large)
                .push_back(s);
        std::vector<Cell> cells;
        if (!small.empty()) cells = smaller_cells(small, radius, boxes);
        const std::size_t coming = waiting.size() - next - 1;
        if (found.frames.size() + coming + cells.size() + 1 > most_frames) {
            cells.clear();
            large = waiting[next].surfaces;
        }
        for (Cell& cell : cells) waiting.push_back(std::move(cell));
        if (large.empty()) continue;
        const bool whole = large.size() == waiting[next].surfaces.size();
        for (const SurfaceIndex s : large) {
            found.of_surface[s] = static_cast<FrameIndex>(found.frames.size());
            settled[s] =
                whole && found.frames.size() + coming > 0 && !scene.surfaces[s].cut_from_larger;
        }
        found.frames.push_back({waiting[next].box});
    }
    if (found.frames.size() > 1) invite_guests(scene, boxes, settled, found);
    return found;
}

}  // namespace patchlight
