#include "tests/physics/random_room.h"

#include <array>
#include <cmath>
#include <random>

namespace patchlight {

namespace {

class RoomMaker {
  public:
    explicit RoomMaker(unsigned seed) : random_(seed) {}

    Scene make(bool open) {
        const Vec3 size(uniform(2.5, 6.0), uniform(2.5, 6.0), uniform(2.2, 3.5));
        const Vec3 low = Vec3::Zero();
        add_room(low, size, open);
        const int boxes = 2 + static_cast<int>(random_() % 4);
        for (int k = 0; k < boxes; ++k) add_box(size);
        const int lamps = 1 + static_cast<int>(random_() % 3);
        for (int k = 0; k < lamps; ++k) add_lamp(size);
        return std::move(scene_);
    }

  private:
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }

    MaterialIndex paint() {
        const double level = uniform(0.15, 0.85);
        const Rgb colour = Rgb::Ones();
        Material material;
        material.name = "paint " + std::to_string(scene_.materials.size());
        material.reflectance = (level * colour).min(0.9);
        scene_.materials.push_back(material);
        return static_cast<MaterialIndex>(scene_.materials.size() - 1);
    }

    ObjectIndex object(const std::string& name) {
        scene_.objects.push_back({name + " " + std::to_string(scene_.objects.size())});
        return static_cast<ObjectIndex>(scene_.objects.size() - 1);
    }

    void polygon(ObjectIndex object, MaterialIndex material, const std::vector<Vec3>& corners) {
        add_polygon(scene_, object, material, face_++, corners, "/objects");
    }

    /// Sides of a block of eight corners, fronts outward or inward.
    void block(const std::array<Vec3, 8>& p, bool outward, int without, bool one_paint,
               const std::string& name) {
        static constexpr std::array<std::array<std::size_t, 4>, 6> sides{
            {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 4, 7, 3}, {1, 2, 6, 5}}};
        MaterialIndex material = paint();
        const ObjectIndex o = object(name);
        for (int s = 0; s < 6; ++s) {
            if (s == without) continue;
            if (!one_paint) material = paint();
            std::vector<Vec3> corners;
            for (const std::size_t k : sides[static_cast<std::size_t>(s)]) corners.push_back(p[k]);
            if (!outward) corners = {corners[0], corners[3], corners[2], corners[1]};
            polygon(o, material, corners);
        }
    }

    static std::array<Vec3, 8> corners_of(const Vec3& low, const Vec3& high) {
        std::array<Vec3, 8> p;
        for (std::size_t k = 0; k < 4; ++k) {
            const double x = k == 1 || k == 2 ? high.x() : low.x(), y = k >= 2 ? high.y() : low.y();
            p[k] = {x, y, low.z()};
            p[k + 4] = {x, y, high.z()};
        }
        return p;
    }

    void add_room(const Vec3& low, const Vec3& high, bool open) {
        constexpr int front = 2;
        block(corners_of(low, high), false, open ? front : -1, false, "room");
    }

    void add_box(const Vec3& room) {
        const Vec3 half(uniform(0.15, 0.5), uniform(0.15, 0.5), uniform(0.1, 0.6));
        const double reach = std::hypot(half.x(), half.y()) + 0.05;
        const double angle = random_() % 2 ? uniform(0.0, 1.5) : 0.0;
        const double lift = random_() % 4 == 0 ? uniform(0.2, 0.8) : 0.0;
        const Vec3 centre(uniform(reach, room.x() - reach), uniform(reach, room.y() - reach),
                          half.z() + lift);
        std::array<Vec3, 8> p = corners_of(-half, half);
        for (Vec3& q : p)
            q = centre + Vec3(std::cos(angle) * q.x() - std::sin(angle) * q.y(),
                              std::sin(angle) * q.x() + std::cos(angle) * q.y(), q.z());
        block(p, true, -1, true, "box");
    }

    void add_lamp(const Vec3& room) {
        Material lamp;
        lamp.name = "lamp " + std::to_string(scene_.materials.size());
        lamp.reflectance = Rgb::Constant(0.5);
        lamp.exitance = Rgb::Ones() * uniform(20.0, 100.0);
        scene_.materials.push_back(lamp);
        const auto material = static_cast<MaterialIndex>(scene_.materials.size() - 1);
        const double a = uniform(0.1, 0.6), b = uniform(0.1, 0.6);
        const Vec3 c(uniform(a, room.x() - a), uniform(b, room.y() - b),
                     room.z() - uniform(0.05, 0.4));
        std::vector<Vec3> corners{c + Vec3(-a, -b, 0) / 2, c + Vec3(-a, b, 0) / 2,
                                  c + Vec3(a, b, 0) / 2, c + Vec3(a, -b, 0) / 2};
        if (random_() % 4 == 0) corners = {corners[0], corners[3], corners[2], corners[1]};
        polygon(object("lamp"), material, corners);
    }

    std::mt19937_64 random_;
    Scene scene_;
    std::uint32_t face_ = 0;
};

}  // namespace

Scene random_room(unsigned seed) { return RoomMaker(seed).make(seed % 3 == 0); }

}  // namespace patchlight
