#include "tests/bench/room_parts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

double RoomParts::across(double low, double high) {
    return low * std::pow(high / low, random.unit());
}

std::string RoomParts::paint(double low, double high, bool two_sided) {
    SceneText::Paint paint;
    const double level = between(low, high);
    paint.reflectance = Rgb::Constant(level);
    if (random.chance(0.4))
        for (double& channel : paint.reflectance)
            channel = std::min(0.99, level * between(0.6, 1.2));
    paint.two_sided = two_sided;
    return text.material(paint);
}

std::string RoomParts::lamp_paint(double radiance, bool two_sided) {
    SceneText::Paint paint;
    if (random.chance(0.6)) paint.reflectance = Rgb::Constant(between(0.2, 0.8));
    paint.radiance = Rgb::Constant(radiance);
    if (random.chance(0.3))
        for (double& channel : paint.radiance) channel *= between(0.5, 1.2);
    paint.two_sided = two_sided;
    return text.material(paint);
}

void RoomParts::choose_scale() {
    if (random.chance(0.5)) text.transform.scale(across(0.1, 10.0));
}

std::vector<std::string> RoomParts::room_paints(double low, double high) {
    const std::string one = paint(low, high);
    std::vector<std::string> paints(6, one);
    if (random.chance(0.6))
        for (std::size_t k = 1; k < 6; ++k) paints[k] = paint(low, high);
    return paints;
}

void RoomParts::room(const Vec3& size, unsigned sides, double low, double high) {
    room_at(Vec3::Zero(), size, sides, room_paints(low, high));
}

void RoomParts::room_at(const Vec3& o, const Vec3& size, unsigned sides,
                        const std::vector<std::string>& paints) {
    const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
    if (sides & floor) text.quad("floor", paints[0], o, x, y);
    if (sides & ceiling) text.quad("ceiling", paints[1], o + z, y, x);
    if (sides & x0) text.quad("wall", paints[2], o, y, z);
    if (sides & x1) text.quad("wall", paints[3], o + x, z, y);
    if (sides & y0) text.quad("wall", paints[4], o, z, x);
    if (sides & y1) text.quad("wall", paints[5], o + y, x, z);
}

void RoomParts::box(const std::string& name, const std::string& material, const Vec3& centre,
                    const Vec3& size, double angle) {
    std::vector<Vec3> p;
    for (const double z : {-0.5, 0.5})
        for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
            const Vec3 q = size.cwiseProduct(Vec3(x, y, z));
            p.push_back(centre + Vec3(std::cos(angle) * q.x() - std::sin(angle) * q.y(),
                                      std::sin(angle) * q.x() + std::cos(angle) * q.y(), q.z()));
        }
    text.mesh(name, material, p,
              {{4, 5, 6, 7}, {0, 3, 2, 1}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

void RoomParts::boxes(const Vec3& room, int count, double low, double high) {
    for (int k = 0; k < count; ++k) {
        const Vec3 size(room.x() * between(0.06, 0.3), room.y() * between(0.06, 0.3),
                        room.z() * between(0.06, 0.45));
        const double angle = random.chance(0.5) ? between(0.0, 1.5) : 0.0;
        const double reach = 0.5 * std::hypot(size.x(), size.y()) + 0.01 * room.x();
        const double lift = random.chance(0.25) ? room.z() * between(0.1, 0.4) : 0.0;
        if (2.0 * reach >= std::min(room.x(), room.y())) continue;
        box("box", paint(low, high),
            {between(reach, room.x() - reach), between(reach, room.y() - reach),
             0.5 * size.z() + lift},
            size, angle);
    }
}

void RoomParts::ceiling_lamp(const Vec3& room, double radiance, bool may_face_up) {
    const double a = room.x() * between(0.04, 0.25), b = room.y() * between(0.04, 0.25);
    const Vec3 o(between(0.01, 0.99) * (room.x() - a), between(0.01, 0.99) * (room.y() - b),
                 room.z() * (1.0 - between(0.01, 0.15)));
    const std::string paint = lamp_paint(radiance);
    if (may_face_up && random.chance(0.25))
        text.quad("lamp", paint, o, {a, 0, 0}, {0, b, 0});
    else
        text.quad("lamp", paint, o, {0, b, 0}, {a, 0, 0});
}

RoomParts::Row RoomParts::row(double from, double to, double length,
                              const std::vector<std::pair<double, double>>& open) {
    Row row{from, to, {}};
    double at = 0.0;
    for (const auto& [first, last] : open) {
        if (first > at) row.filled.emplace_back(at, first);
        at = last;
    }
    if (at < length) row.filled.emplace_back(at, length);
    return row;
}

void RoomParts::sheet(const std::string& name, const std::string& material, const Vec3& o,
                      const Vec3& a, const Vec3& b, std::vector<Row> rows) {
    const Vec3 u = a.normalized(), v = b.normalized();
    double at = 0.0;
    rows.push_back({b.norm(), b.norm(), {}});
    for (const Row& row : rows) {
        if (row.from > at) text.quad(name, material, o + at * v, a, (row.from - at) * v);
        for (const auto& [first, last] : row.filled)
            text.quad(name, material, o + row.from * v + first * u, (last - first) * u,
                      (row.to - row.from) * v);
        at = row.to;
    }
}

void RoomParts::revolved(const std::string& name, const std::string& material, const Vec3& at,
                         const std::vector<std::pair<double, double>>& profile, int sides,
                         bool triangles) {
    std::vector<Vec3> vertices;
    std::vector<std::vector<std::size_t>> faces;
    const auto n = static_cast<std::size_t>(sides);
    for (const auto& [radius, height] : profile)
        for (std::size_t k = 0; k < n; ++k) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / sides;
            vertices.push_back(at +
                               Vec3(radius * std::cos(angle), radius * std::sin(angle), height));
        }
    for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring)
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t a = ring * n + k, b = ring * n + (k + 1) % n, c = b + n, d = a + n;
            const bool no_low = profile[ring].first == 0.0,
                       no_high = profile[ring + 1].first == 0.0;
            if (no_low)
                faces.push_back({a, c, d});
            else if (no_high)
                faces.push_back({a, b, d});
            else if (triangles)
                faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
            else
                faces.push_back({a, b, c, d});
        }
    text.mesh(name, material, vertices, faces);
}

}  // namespace patchlight
