// Rooms with things in them: lamps of many triangles, lampshades, furniture.
#include "tests/bench/claim_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

Vec3 lit_room(RoomParts& parts) {
    const Vec3 room(parts.between(2.5, 6.0), parts.between(2.5, 6.0), parts.between(2.2, 3.5));
    parts.room(room);
    return room;
}

/// From the lower to the upper pole of a ball, or part of the way.
std::vector<std::pair<double, double>> arc(double radius, int steps, double from, double to) {
    std::vector<std::pair<double, double>> profile;
    for (int k = 0; k <= steps; ++k) {
        const double angle = from + (to - from) * k / steps;
        const double ring = radius * std::sin(angle);
        profile.emplace_back(ring < 1e-9 * radius ? 0.0 : ring, -radius * std::cos(angle));
    }
    return profile;
}

Vec3 in_air(RoomParts& parts, const Vec3& room, double reach) {
    return {parts.between(reach, room.x() - reach), parts.between(reach, room.y() - reach),
            parts.between(reach, room.z() - reach)};
}

/// A rectangle cut into n by n squares of two triangles, facing down.
void panel(RoomParts& parts, const std::string& lamp, const Vec3& room) {
    const auto n = static_cast<std::size_t>(std::lround(parts.across(1.0, 32.0)));
    const double a = parts.between(0.2, 1.5), b = parts.between(0.2, 1.5);
    const Vec3 o(parts.between(0.05, room.x() - a - 0.05), parts.between(0.05, room.y() - b - 0.05),
                 room.z() - parts.between(0.02, 0.5));
    std::vector<Vec3> vertices;
    std::vector<std::vector<std::size_t>> faces;
    for (std::size_t j = 0; j <= n; ++j)
        for (std::size_t i = 0; i <= n; ++i)
            vertices.push_back(o + Vec3(a * static_cast<double>(i) / static_cast<double>(n),
                                        b * static_cast<double>(j) / static_cast<double>(n), 0.0));
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t p = j * (n + 1) + i, q = p + n + 1;
            faces.insert(faces.end(), {{p, q + 1, p + 1}, {p, q, q + 1}});
        }
    parts.text.mesh("lamp", lamp, vertices, faces);
}

void table(RoomParts& parts, const Vec3& at) {
    const std::string wood = parts.paint(0.1, 0.6);
    const double x = parts.between(0.7, 1.6), y = parts.between(0.5, 0.9),
                 z = parts.between(0.45, 0.8);
    const double leg = parts.between(0.03, 0.08), top = parts.between(0.015, 0.05);
    parts.box("table", wood, at + Vec3(0, 0, z - top / 2), {x, y, top});
    for (const double i : {-0.5, 0.5})
        for (const double j : {-0.5, 0.5})
            parts.box("leg", wood, at + Vec3(i * (x - 2 * leg), j * (y - 2 * leg), (z - top) / 2),
                      {leg, leg, z - top});
}

void chair(RoomParts& parts, const Vec3& at) {
    const std::string wood = parts.paint(0.1, 0.7);
    const double z = 0.45, leg = parts.between(0.02, 0.05);
    parts.box("seat", wood, at + Vec3(0, 0, z), {0.42, 0.42, 0.03});
    parts.box("back", wood, at + Vec3(-0.2, 0, z + 0.25), {0.02, 0.42, 0.4});
    for (const double i : {-0.18, 0.18})
        for (const double j : {-0.18, 0.18})
            parts.box("leg", wood, at + Vec3(i, j, (z - 0.015) / 2), {leg, leg, z - 0.015});
}

/// Of thin plates, or of boards, against the wall x = 0.
void shelf(RoomParts& parts, const Vec3& room) {
    const double deep = parts.between(0.2, 0.4), high = parts.between(0.8, 0.8 * room.z());
    const double wide = parts.between(0.5, 0.4 * room.y());
    const double y = parts.between(0.05, 0.9 * room.y() - wide);
    const int boards = 2 + parts.random.below(5);
    if (parts.random.chance(0.5)) {
        const std::string plate = parts.paint(0.2, 0.8, true);
        for (int k = 1; k <= boards; ++k)
            parts.text.quad("plate", plate, {0, y, high * k / boards}, {deep, 0, 0}, {0, wide, 0});
        for (const double side : {0.0, wide})
            parts.text.quad("plate", plate, {0, y + side, 0}, {deep, 0, 0}, {0, 0, high});
    } else {
        const std::string wood = parts.paint(0.2, 0.8);
        for (int k = 1; k <= boards; ++k)
            parts.box("board", wood, {deep / 2 + 0.01, y + wide / 2, high * k / boards},
                      {deep, wide - 0.05, 0.02});
        for (const double side : {0.0, wide})
            parts.box("board", wood, {deep / 2 + 0.01, y + side, high / 2 + 0.015},
                      {deep, 0.02, high + 0.03});
    }
}

}  // namespace

/// Lamps of 2 to 2048 triangles: spheres, domes, tubes, panels.
void make_tessellated(RoomParts& parts) {
    parts.choose_scale();
    const Vec3 room = lit_room(parts);
    const std::string lamp = parts.lamp_paint(parts.across(10.0, 200.0));
    const double radius = parts.between(0.05, 0.4);
    const int around = static_cast<int>(std::lround(parts.across(4.0, 32.0)));
    const int steps = std::max(2, around);
    const Vec3 at = in_air(parts, room, 1.3 * radius);
    switch (parts.random.below(4)) {
        case 0:
            parts.revolved("lamp", lamp, at, arc(radius, steps, 0.0, std::numbers::pi), around,
                           true);
            break;
        case 1:  // a dome below the ceiling
            parts.revolved("lamp", lamp, {at.x(), at.y(), room.z()},
                           arc(radius, steps / 2, 0.0, std::numbers::pi / 2), around, true);
            break;
        case 2: {  // a tube, closed at its ends
            const double length = parts.between(0.2, 0.9) * room.z();
            const double thin = std::min(radius, 0.1);
            parts.revolved("lamp", lamp, {at.x(), at.y(), 0.05 * room.z()},
                           {{0.0, 0.0}, {thin, 0.0}, {thin, length}, {0.0, length}}, around, true);
            break;
        }
        default:
            panel(parts, lamp, room);
    }
    parts.boxes(room, parts.random.below(4));
    if (parts.random.chance(0.3)) {
        const double ball = parts.between(0.1, 0.4);
        parts.revolved("ball", parts.paint(), in_air(parts, room, 1.1 * ball),
                       arc(ball, 12, 0.0, std::numbers::pi), 24, parts.random.chance(0.5));
    }
}

/// Shades of many sides, open above and below, round a small lamp: pendants and table lamps.
void make_lampshade(RoomParts& parts) {
    parts.choose_scale();
    const Vec3 room = lit_room(parts);
    const int count = 1 + parts.random.below(2);
    for (int k = 0; k < count; ++k) {
        const double low = parts.between(0.1, 0.4), high = low * parts.between(0.3, 1.0);
        const double tall = parts.between(0.1, 0.5);
        const Vec3 at(parts.between(0.45, room.x() - 0.45), parts.between(0.45, room.y() - 0.45),
                      parts.between(0.5, room.z() - tall - 0.05));
        const int sides = 6 + parts.random.below(35);
        std::vector<std::pair<double, double>> shade{{low, 0.0}, {high, tall}};
        if (parts.random.chance(0.4))
            shade = arc(low, 6, 0.5 * std::numbers::pi, 0.85 * std::numbers::pi);
        parts.revolved("shade", parts.paint(0.2, 0.85, true), at, shade, sides, false);
        const double inner = std::min({low, high, 0.4}) * parts.between(0.15, 0.5);
        const std::string lamp = parts.lamp_paint(parts.across(30.0, 500.0));
        const Vec3 bulb = at + Vec3(0, 0, parts.between(0.2, 0.6) * std::min(tall, 0.9 * low));
        if (parts.random.chance(0.6))
            parts.revolved("bulb", lamp, bulb, arc(0.5 * inner, 4, 0.0, std::numbers::pi), 8,
                           parts.random.chance(0.5));
        else
            parts.box("bulb", lamp, bulb, Vec3::Constant(inner));
    }
    if (parts.random.chance(0.5)) table(parts, {room.x() / 2, room.y() / 2, 0});
    parts.boxes({room.x(), room.y(), 0.4 * room.z()}, parts.random.below(2));
}

void make_furniture(RoomParts& parts) {
    parts.choose_scale();
    const Vec3 room = lit_room(parts);
    const Vec3 at(room.x() * parts.between(0.45, 0.55), room.y() * parts.between(0.45, 0.55), 0);
    table(parts, at);
    const int chairs = 1 + parts.random.below(3);
    for (int k = 0; k < chairs; ++k)
        chair(parts, {parts.between(0.35, room.x() - 0.35),
                      k % 2 ? room.y() * 0.16 + 0.1 : room.y() * 0.84 - 0.1, 0});
    if (parts.random.chance(0.7)) shelf(parts, room);
    if (parts.random.chance(0.3))
        parts.text.quad("rug", parts.paint(0.1, 0.6), {0.3 * room.x(), 0.3 * room.y(), 0},
                        {0.4 * room.x(), 0, 0}, {0, 0.4 * room.y(), 0});
    const int lamps = 1 + parts.random.below(2);
    for (int k = 0; k < lamps; ++k) parts.ceiling_lamp(room, parts.across(5.0, 60.0), true);
}

}  // namespace patchlight
