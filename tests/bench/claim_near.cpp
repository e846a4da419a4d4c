// Things so close to a wall or to each other that much of the light between goes to and fro.
#include "tests/bench/claim_scenes.h"

#include <algorithm>

namespace patchlight {

namespace {

/// A box that gives light all round, or a panel on a body that gives it towards the ceiling.
void lamp_below_ceiling(RoomParts& parts, const Vec3& at, double wide, double deep, double gap,
                        double radiance) {
    const double thick = parts.between(0.03, 0.12), z = at.z() - gap;
    const Vec3 centre(at.x(), at.y(), z - 0.5 * thick), size(wide, deep, thick);
    if (parts.random.chance(0.5)) {
        parts.box("lamp", parts.lamp_paint(radiance), centre, size, parts.between(0.0, 1.5));
        return;
    }
    parts.box("body", parts.paint(0.3, 0.9), centre - Vec3(0, 0, 0.01), size);
    parts.text.quad("lamp", parts.lamp_paint(radiance),
                    Vec3(at.x() - 0.5 * wide, at.y() - 0.5 * deep, z), {wide, 0, 0}, {0, deep, 0});
}

/// A round one, of many facets.
void bowl_below_ceiling(RoomParts& parts, const Vec3& at, double radius, double gap,
                        double radiance) {
    const double deep = radius * parts.between(0.2, 0.6), top = at.z() - gap;
    parts.revolved("bowl", parts.lamp_paint(radiance), {at.x(), at.y(), top - deep},
                   {{0.0, 0.0}, {0.7 * radius, 0.2 * deep}, {radius, deep}, {0.0, deep}},
                   6 + parts.random.below(18), parts.random.chance(0.5));
}

/// Boards on a wall, one close above the other, some lit from below.
void shelves(RoomParts& parts, const Vec3& room) {
    const std::string board = parts.paint(0.6, 0.95);
    const double wide = parts.between(0.5, 0.8 * room.x()), deep = parts.between(0.2, 0.5);
    double z = parts.between(0.1, 0.5);
    const int count = 2 + parts.random.below(4);
    for (int k = 0; k < count && z + 0.1 < room.z(); ++k) {
        parts.box("board", board, {0.5 * room.x(), 0.5 * deep + 0.001, z}, {wide, deep, 0.02});
        if (parts.random.chance(0.4))
            parts.text.quad("strip", parts.lamp_paint(parts.across(10.0, 200.0)),
                            {0.5 * room.x() - 0.3 * wide, 0.3 * deep, z - 0.012}, {0, 0.05, 0},
                            {0.6 * wide, 0, 0});
        z += parts.between(0.05, 0.3);
    }
}

}  // namespace

void make_near(RoomParts& parts) {
    parts.choose_scale();
    const Vec3 room(parts.between(2.5, 6.0), parts.between(2.5, 6.0), parts.between(2.2, 3.5));
    const double low = parts.between(0.6, 0.95);
    parts.room(room, RoomParts::all, low, std::min(0.97, low + 0.1));
    const int lamps = 1 + parts.random.below(3);
    for (int k = 0; k < lamps; ++k) {
        const double wide = parts.across(0.2, 1.6), deep = parts.across(0.15, 0.8),
                     gap = parts.across(0.02, 0.4), radiance = parts.across(5.0, 60.0);
        // Each in a part of the room of its own, so that none stands in another.
        const double x = room.x() * (k + parts.between(0.4, 0.6)) / lamps;
        const Vec3 at(x, room.y() * parts.between(0.4, 0.6), room.z());
        const double most = 0.8 * room.x() / lamps;
        if (parts.random.chance(0.3))
            bowl_below_ceiling(parts, at, 0.5 * std::min(wide, most), gap, radiance);
        else
            lamp_below_ceiling(parts, at, std::min(wide, most), deep, gap, radiance);
    }
    if (parts.random.chance(0.4)) shelves(parts, room);
    const int boxes = parts.random.below(3);
    for (int k = 0; k < boxes; ++k)  // a little above the floor, or close to the wall
        parts.box("box", parts.paint(0.5, 0.9),
                  {room.x() * parts.between(0.3, 0.7), room.y() - 0.3 - parts.across(0.02, 0.3),
                   0.25 + parts.across(0.02, 0.2)},
                  {0.5, 0.6, 0.5});
}

}  // namespace patchlight
