// Scenes whose light comes through gaps: slits, louvres, perforations, sunbeams.
#include "tests/bench/claim_scenes.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

Vec3 room_size(RoomParts& parts) {
    return {parts.between(2.5, 6.0), parts.between(2.5, 6.0), parts.between(2.2, 3.5)};
}

/// A light far weaker or about as strong as what comes through.
void other_lamp(RoomParts& parts, const Vec3& room) {
    if (parts.random.chance(0.7)) parts.ceiling_lamp(room, parts.across(5.0, 60.0));
}

/// So many gaps of one width across a length, in some disorder.
std::vector<RoomParts::Row> gaps(RoomParts& parts, int count, double width, double length) {
    std::vector<RoomParts::Row> rows;
    const double step = length / count;
    for (int k = 0; k < count; ++k) {
        const double from = step * k + parts.between(0.05, 0.95) * (step - width);
        rows.push_back({from, from + width, {}});
    }
    return rows;
}

/// A wall of boards with gaps, the sky behind it.
void shutters(RoomParts& parts) {
    const Vec3 room = room_size(parts);
    const auto paints = parts.room_paints(0.2, 0.85);
    parts.room_at(Vec3::Zero(), room, RoomParts::all & ~RoomParts::x0, paints);
    const double width = parts.across(0.0005, 0.02);
    const bool upright = parts.random.chance(0.5);
    const Vec3 y(0, room.y(), 0), z(0, 0, room.z());
    const int count = 1 + parts.random.below(8);
    if (upright)  // boards side by side along y: front +x is b × a, so mirror the sheet's order
        parts.sheet("board", paints[2], z, -z, y, gaps(parts, count, width, room.y()));
    else
        parts.sheet("board", paints[2], Vec3::Zero(), y, z, gaps(parts, count, width, room.z()));
    const double behind = parts.across(0.01, 0.5), beyond = parts.between(0.0, 0.5);
    parts.text.quad("sky", parts.lamp_paint(parts.across(200.0, 5000.0)),
                    {-behind, -beyond, -beyond}, {0, room.y() + 2 * beyond, 0},
                    {0, 0, room.z() + 2 * beyond});
    other_lamp(parts, room);
    parts.boxes(room, parts.random.below(3));
}

/// A lamp above a plate with slits, below the ceiling.
void slotted_lamp(RoomParts& parts) {
    const Vec3 room = room_size(parts);
    parts.room(room);
    const double a = parts.between(0.3, 1.2), b = parts.between(0.3, 1.2);
    const double below = parts.between(0.05, 0.4), deep = parts.between(0.02, 0.2);
    const Vec3 o(parts.between(0.1, room.x() - a - 0.1), parts.between(0.1, room.y() - b - 0.1),
                 room.z() - below);
    const std::string housing = parts.paint(0.1, 0.9, true);
    const Vec3 x(a, 0, 0), y(0, b, 0), up(0, 0, std::min(deep, 0.9 * below));
    const double width = parts.across(0.0005, 0.02);
    parts.sheet("louvre", housing, o, y, x,
                gaps(parts, 1 + parts.random.below(10), std::min(width, 0.02 * a), a));
    parts.text.quad("lamp", parts.lamp_paint(parts.across(50.0, 2000.0)),
                    o + 0.95 * up + 0.01 * (x + y), 0.98 * y, 0.98 * x);
    parts.text.quad("housing", housing, o, x, up);
    parts.text.quad("housing", housing, o + y, x, up);
    parts.text.quad("housing", housing, o, y, up);
    parts.text.quad("housing", housing, o + x, y, up);
    parts.text.quad("housing", housing, o + up, x, y);
    other_lamp(parts, room);
    parts.boxes(room, parts.random.below(3));
}

/// A window behind slats that are turned nearly shut.
void blind(RoomParts& parts) {
    const Vec3 room = room_size(parts);
    parts.room(room, RoomParts::all & ~RoomParts::x0);
    const std::string wall = parts.paint(), slat = parts.paint(0.2, 0.8, true);
    const double y0 = parts.between(0.1, 0.4) * room.y(), y1 = parts.between(0.6, 0.9) * room.y();
    const double z0 = parts.between(0.1, 0.4) * room.z(), z1 = parts.between(0.6, 0.95) * room.z();
    parts.sheet("wall", wall, Vec3::Zero(), {0, room.y(), 0}, {0, 0, room.z()},
                {RoomParts::row(z0, z1, room.y(), {{y0, y1}})});
    parts.text.quad("window", parts.lamp_paint(parts.across(20.0, 500.0)),
                    {-0.15, y0 - 0.1, z0 - 0.1}, {0, y1 - y0 + 0.2, 0}, {0, 0, z1 - z0 + 0.2});
    const int count = 4 + parts.random.below(12);
    const double step = (z1 - z0) / count, gap = std::min(parts.across(0.001, 0.02), 0.5 * step);
    const double tilt = parts.between(0.2, 1.3), width = (step - gap) / std::sin(tilt);
    if (width * std::cos(tilt) > 0.14) return;
    for (int k = 0; k < count; ++k)
        parts.text.quad("slat", slat, {-0.14, y0, z0 + k * step}, {0, y1 - y0, 0},
                        {width * std::cos(tilt), 0, width * std::sin(tilt)});
    parts.boxes(room, parts.random.below(3));
}

/// A ceiling of two plates with crossing slits, or one with square holes, below a sky.
void perforated(RoomParts& parts) {
    const Vec3 room = room_size(parts);
    const auto paints = parts.room_paints(0.2, 0.8);
    parts.room_at(Vec3::Zero(), room, RoomParts::all & ~RoomParts::ceiling, paints);
    const int n = 3 + parts.random.below(8);
    const double width = parts.across(0.002, 0.02);
    std::vector<RoomParts::Row> rows;
    std::vector<std::pair<double, double>> open;
    for (int k = 0; k < n; ++k) {
        const double at = (k + 0.5) / n;
        open.emplace_back(at * room.y() - width / 2, at * room.y() + width / 2);
    }
    for (int k = 0; k < n; ++k) {
        const double at = (k + 0.5) / n * room.x();
        rows.push_back(RoomParts::row(at - width / 2, at + width / 2, room.y(), open));
    }
    const Vec3 z(0, 0, room.z());
    parts.sheet("ceiling", paints[1], z, {0, room.y(), 0}, {room.x(), 0, 0}, rows);
    parts.text.quad("sky", parts.lamp_paint(parts.across(300.0, 5000.0)),
                    z + Vec3(-0.2, -0.2, parts.across(0.01, 0.3)), {0, room.y() + 0.4, 0},
                    {room.x() + 0.4, 0, 0});
    other_lamp(parts, room);
    parts.boxes(room, parts.random.below(3));
}

/// A far, small, bright lamp whose light comes through holes in a wall.
void sunbeams(RoomParts& parts) {
    const Vec3 room = room_size(parts);
    const auto paints = parts.room_paints(0.2, 0.8);
    parts.room_at(Vec3::Zero(), room, RoomParts::all & ~RoomParts::x0, paints);
    const int n = 1 + parts.random.below(4);
    std::vector<RoomParts::Row> rows;
    Vec3 through = Vec3::Zero();
    for (int k = 0; k < n; ++k) {  // one above the other
        const double size = parts.across(0.01, 0.05);
        const double z = (k + parts.between(0.2, 0.8)) / n * (room.z() - 0.1) + 0.02;
        const double y = parts.between(0.3, 0.7) * room.y();
        rows.push_back(RoomParts::row(z, z + size, room.y(), {{y, y + size}}));
        through = {0, y + size / 2, z + size / 2};
    }
    parts.sheet("wall", paints[2], Vec3::Zero(), {0, room.y(), 0}, {0, 0, room.z()}, rows);
    const Vec3 to(room.x() * parts.between(0.2, 0.9), room.y() * parts.between(0.2, 0.8), 0.0);
    const Vec3 ray = (to - through).normalized();
    const double far = parts.across(5.0, 60.0), across = far * parts.across(0.005, 0.02);
    const Vec3 u = ray.unitOrthogonal(), v = ray.cross(u), at = through - far * ray;
    const double irradiance = parts.across(150.0, 1000.0);
    SceneText::Paint sun;
    sun.radiance = Rgb::Constant(irradiance * far * far / (across * across));
    parts.text.quad("sun", parts.text.material(sun), at - across / 2 * (u + v), across * u,
                    across * v);
    parts.ceiling_lamp(room, parts.across(2.0, 60.0));
    parts.boxes(room, parts.random.below(3));
}

/// A lamp in a box with holes.
void lantern(RoomParts& parts) {
    const Vec3 room = room_size(parts);
    parts.room(room);
    const Vec3 size(parts.between(0.2, 0.6), parts.between(0.2, 0.6), parts.between(0.2, 0.6));
    const Vec3 o(parts.between(0.3, room.x() - 0.9), parts.between(0.3, room.y() - 0.9),
                 parts.between(0.3, room.z() - 0.9));
    const std::string wall = parts.paint(0.05, 0.6, true);
    const Vec3 edge[3] = {{size.x(), 0, 0}, {0, size.y(), 0}, {0, 0, size.z()}};
    for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) {
            const Vec3 &a = edge[(axis + 1) % 3], &b = edge[(axis + 2) % 3];
            std::vector<RoomParts::Row> rows;
            const int n = 1 + parts.random.below(3);
            const double hole = std::min(parts.across(0.003, 0.05), 0.5 * a.norm() / n);
            for (int k = 0; k < n && parts.random.chance(0.7); ++k) {
                const double at = (k + 0.5) / n * b.norm(), along = 0.5 * a.norm();
                rows.push_back(RoomParts::row(at - std::min(hole, 0.4 * b.norm() / n) / 2,
                                              at + std::min(hole, 0.4 * b.norm() / n) / 2, a.norm(),
                                              {{along - hole / 2, along + hole / 2}}));
            }
            parts.sheet("lantern", wall, o + (high ? edge[axis] : Vec3(Vec3::Zero())), a, b, rows);
        }
    parts.box("lamp", parts.lamp_paint(parts.across(100.0, 3000.0)), o + 0.5 * size, 0.2 * size);
    other_lamp(parts, room);
}

}  // namespace

void make_slits(RoomParts& parts) {
    parts.choose_scale();
    switch (parts.random.below(3)) {
        case 0:
            return shutters(parts);
        case 1:
            return slotted_lamp(parts);
        default:
            return blind(parts);
    }
}

void make_holes(RoomParts& parts) {
    parts.choose_scale();
    switch (parts.random.below(4)) {
        case 0:
            return perforated(parts);
        case 1:
            return lantern(parts);
        default:
            return sunbeams(parts);
    }
}

}  // namespace patchlight
