// Rooms by what is bright in them, and by their shape.
#include "tests/bench/claim_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

Vec3 room_size(RoomParts& parts) {
    return {parts.between(2.5, 6.0), parts.between(2.5, 6.0), parts.between(2.2, 3.5)};
}

void some_lamps(RoomParts& parts, const Vec3& room, bool may_face_up = false) {
    const int count = 1 + parts.random.below(3);
    for (int k = 0; k < count; ++k) parts.ceiling_lamp(room, parts.across(5.0, 60.0), may_face_up);
}

Eigen::Affine3d any_turn(RoomParts& parts) {
    const Vec3 axis(parts.between(-1, 1), parts.between(-1, 1), parts.between(0.1, 1));
    return Eigen::Affine3d(Eigen::AngleAxisd(parts.between(0.1, 3.0), axis.normalized()));
}

/// A plan with walls along its edges, its corners counter-clockwise.
void prism(RoomParts& parts, const std::vector<Vec3>& plan, double height) {
    const auto paints = parts.room_paints(0.2, 0.85);
    const Vec3 up(0, 0, height);
    std::vector<Vec3> above;
    for (auto p = plan.rbegin(); p != plan.rend(); ++p) above.push_back(*p + up);
    parts.text.polygon("floor", paints[0], plan);
    parts.text.polygon("ceiling", paints[1], above);
    for (std::size_t k = 0; k < plan.size(); ++k) {
        const Vec3 &p = plan[k], &q = plan[(k + 1) % plan.size()];
        parts.text.quad("wall", paints[2 + k % 4], p, up, q - p);
    }
}

/// A room with a slanted ceiling: walls are trapezoids.
void attic(RoomParts& parts, const Vec3& room) {
    const auto paints = parts.room_paints(0.2, 0.85);
    const double low = room.z() * parts.between(0.2, 0.8), x = room.x(), y = room.y(), z = room.z();
    parts.text.polygon("floor", paints[0], {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}});
    parts.text.polygon("roof", paints[1], {{0, 0, z}, {0, y, z}, {x, y, low}, {x, 0, low}});
    parts.text.polygon("wall", paints[2], {{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}});
    parts.text.polygon("wall", paints[3], {{x, 0, 0}, {x, 0, low}, {x, y, low}, {x, y, 0}});
    parts.text.polygon("wall", paints[4], {{0, 0, 0}, {0, 0, z}, {x, 0, low}, {x, 0, 0}});
    parts.text.polygon("wall", paints[5], {{0, y, 0}, {x, y, 0}, {x, y, low}, {0, y, z}});
}

}  // namespace

void make_white(RoomParts& parts) {
    parts.choose_scale();
    const Vec3 room = room_size(parts);
    const double low = parts.between(0.9, 0.98);
    const int kind = parts.random.below(3);
    if (kind == 0) {  // one reflectance everywhere, the lamp too
        SceneText::Paint paint{Rgb::Constant(parts.between(0.9, 0.99))};
        const std::string wall = parts.text.material(paint);
        parts.room_at(Vec3::Zero(), room, RoomParts::all, std::vector<std::string>(6, wall));
        paint.radiance = Rgb::Constant(10.0);
        const Vec3 size(parts.between(0.2, 1.0), parts.between(0.2, 1.0), 0.1);
        const Vec3 at(parts.between(0.8, room.x() - 0.8), parts.between(0.8, room.y() - 0.8),
                      room.z() - parts.between(0.1, 0.6));
        if (parts.random.chance(0.5))
            parts.box("lamp", parts.text.material(paint), at, size);
        else
            parts.text.quad("lamp", parts.text.material(paint), at - size / 2, {0, size.y(), 0},
                            {size.x(), 0, 0});
        const int boxes = parts.random.below(9);
        for (int k = 0; k < boxes; ++k) {
            const Vec3 half(parts.between(0.1, 0.4), parts.between(0.1, 0.4),
                            parts.between(0.1, 0.5));
            parts.box("box", wall,
                      {parts.between(0.6, room.x() - 0.6), parts.between(0.6, room.y() - 0.6),
                       parts.random.chance(0.5) ? half.z() : parts.between(0.6, 1.2)},
                      2 * half, parts.between(0.0, 1.5));
        }
        return;
    }
    parts.room(room, RoomParts::all, low, kind == 1 ? low + 1e-9 : 0.99);
    some_lamps(parts, room, true);
    parts.boxes(room, parts.random.below(6), kind == 1 ? low : 0.9, kind == 1 ? low + 1e-9 : 0.99);
}

/// A ledge round the walls that hides lamps from below, or lamps that face the ceiling.
void make_cove(RoomParts& parts) {
    parts.choose_scale();
    const Vec3 room = room_size(parts);
    parts.room(room);
    const double z = room.z() * parts.between(0.7, 0.93), wide = parts.between(0.1, 0.35);
    const double lip = parts.between(0.03, 0.3) * (room.z() - z);
    const std::string ledge = parts.paint(0.3, 0.85, true);
    const int sides = 1 + parts.random.below(15);
    const double margin = 0.02 * wide, x = room.x(), y = room.y();
    const auto side = [&](const Vec3& corner, const Vec3& along, const Vec3& out) {
        parts.text.quad("ledge", ledge, corner, along, out);
        parts.text.quad("lip", ledge, corner + out, along, {0, 0, lip});
        const Vec3 a = along * 0.8, b = out * parts.between(0.1, 0.5);
        const Vec3 o = corner + 0.1 * along + 0.2 * out + Vec3(0, 0, margin);
        const std::string lamp = parts.lamp_paint(parts.across(50.0, 500.0));
        if (a.cross(b).z() > 0)
            parts.text.quad("lamp", lamp, o, a, b);
        else
            parts.text.quad("lamp", lamp, o, b, a);
    };
    if (sides & 1) side({0, 0, z}, {x, 0, 0}, {0, wide, 0});
    if (sides & 2) side({0, y, z}, {x, 0, 0}, {0, -wide, 0});
    if (sides & 4) side({0, wide, z}, {0, y - 2 * wide, 0}, {wide, 0, 0});
    if (sides & 8) side({x, wide, z}, {0, y - 2 * wide, 0}, {-wide, 0, 0});
    parts.boxes({x, y, 0.6 * room.z()}, parts.random.below(4));
}

/// Boxes, or a court, below a panel of sky.
void make_skypanel(RoomParts& parts) {
    const double size = parts.across(3.0, 30.0), panel = parts.across(5.0, 100.0);
    const double height = parts.between(0.3, 1.2) * std::min(size, panel);
    const Vec3 site(size, size * parts.between(0.6, 1.4), 0.4 * height);
    const bool court = parts.random.chance(0.5);
    parts.room(site, court ? RoomParts::all & ~RoomParts::ceiling : unsigned{RoomParts::floor}, 0.1,
               0.7);
    parts.boxes({site.x(), site.y(), 0.9 * site.z()}, 2 + parts.random.below(9), 0.1, 0.7);
    SceneText::Paint sky;
    sky.radiance = parts.random.chance(0.5) ? Rgb(3, 4, 6) : Rgb::Constant(parts.across(1, 100));
    const Vec3 o(0.5 * site.x() - 0.5 * panel, 0.5 * site.y() - 0.5 * panel, height);
    parts.text.quad("sky", parts.text.material(sky), o, {0, panel, 0}, {panel, 0, 0});
}

/// Two to four rooms in a row or a square, joined by doors; light in one of them.
void make_doors(RoomParts& parts) {
    parts.choose_scale();
    const double height = parts.between(2.3, 3.0), thick = parts.between(0.05, 0.3);
    const int rooms = 2 + parts.random.below(3), lit = parts.random.below(rooms);
    const double deep = parts.between(2.5, 5.0);
    const auto outer = parts.room_paints(0.3, 0.85);
    const std::string frame = parts.paint(0.3, 0.9);
    double at = 0.0;
    struct Door {
        double from, to, top;
    } last{};
    for (int k = 0; k < rooms; ++k) {
        const Vec3 size(parts.between(2.5, 5.0), deep, height), o(at, 0, 0);
        unsigned sides = RoomParts::all;
        const Vec3 y(0, deep, 0), z(0, 0, height);
        if (k > 0) sides &= ~RoomParts::x0;
        if (k + 1 < rooms) sides &= ~RoomParts::x1;
        parts.room_at(o, size, sides, outer);
        const auto opening = [&](const Door& door) {
            return std::vector<RoomParts::Row>{
                RoomParts::row(0.0, door.top, deep, {{door.from, door.to}})};
        };
        if (k > 0) parts.sheet("wall", outer[2], o, y, z, opening(last));
        at += size.x();
        if (k + 1 < rooms) {
            const double wide = parts.between(0.6, 1.2), from = parts.between(0.2, deep - 1.4);
            last = {from, from + wide, parts.between(1.8, height - 0.1)};
            // Its front is -x: along y backwards.
            const Door mirrored{deep - last.to, deep - last.from, last.top};
            parts.sheet("wall", outer[3], {at, deep, 0}, -y, z, opening(mirrored));
            const Vec3 t(thick, 0, 0), up(0, 0, last.top), w(0, wide, 0), d(at, from, 0);
            parts.text.quad("sill", frame, d, t, w);
            parts.text.quad("lintel", frame, d + up, w, t);
            parts.text.quad("jamb", frame, d, up, t);
            parts.text.quad("jamb", frame, d + w, t, up);
            at += thick;
        }
        if (k == lit)
            parts.text.quad("lamp", parts.lamp_paint(parts.across(10.0, 100.0)),
                            o + Vec3(0.4 * size.x(), 0.4 * deep, height * 0.97),
                            {0, parts.between(0.1, 0.8), 0}, {parts.between(0.1, 0.8), 0, 0});
        if (parts.random.chance(0.5))
            parts.box("box", parts.paint(), o + Vec3(0.7 * size.x(), 0.2 * deep, 0.4),
                      {0.5, 0.4, 0.8}, parts.between(0, 1.5));
    }
}

/// Rooms turned in space, of an L-shaped plan, of many sides, below a slanted roof.
void make_tilted(RoomParts& parts) {
    parts.choose_scale();
    if (parts.random.chance(0.7)) parts.text.transform = parts.text.transform * any_turn(parts);
    Vec3 room = room_size(parts);
    const double x = room.x(), y = room.y();
    switch (parts.random.below(3)) {
        case 0: {
            const double a = x * parts.between(0.35, 0.7), b = y * parts.between(0.35, 0.7);
            prism(parts, {{0, 0, 0}, {x, 0, 0}, {x, b, 0}, {a, b, 0}, {a, y, 0}, {0, y, 0}},
                  room.z());
            some_lamps(parts, {a, b, room.z()});
            parts.boxes({a, b, room.z()}, parts.random.below(4));
            return;
        }
        case 1: {
            const int sides = 5 + parts.random.below(4);
            std::vector<Vec3> plan;
            for (int k = 0; k < sides; ++k) {
                const double angle = 2.0 * std::numbers::pi * (k + 0.5) / sides;
                plan.emplace_back(x * (0.5 + 0.5 * std::cos(angle)),
                                  y * (0.5 + 0.5 * std::sin(angle)), 0.0);
            }
            prism(parts, plan, room.z());
            parts.text.quad("lamp", parts.lamp_paint(parts.across(5.0, 60.0)),
                            {0.4 * x, 0.4 * y, 0.95 * room.z()}, {0, 0.2 * y, 0}, {0.2 * x, 0, 0});
            parts.box("box", parts.paint(), {0.55 * x, 0.5 * y, 0.4}, {0.6, 0.5, 0.8},
                      parts.between(0, 1.5));
            return;
        }
        default:
            attic(parts, room);
            some_lamps(parts, {0.5 * x, y, 0.55 * room.z()});
            parts.boxes({x, y, 0.3 * room.z()}, parts.random.below(4));
    }
}

void make_boxes(RoomParts& parts) {
    parts.choose_scale();
    const Vec3 room = room_size(parts);
    parts.room(room, parts.random.chance(0.3) ? RoomParts::all & ~RoomParts::y0
                                              : unsigned{RoomParts::all});
    parts.boxes(room, 2 + parts.random.below(8));
    some_lamps(parts, room, true);
}

}  // namespace patchlight
