// A plain path tracer on Embree for reference pictures. It shares the scene reader and the camera
// with the program, and nothing of its form factors, transport or display: brute force, one path
// after another, sources sampled by area at each bounce (next-event estimation).
//
//   patchlight_path_tracer SCENE CAMERA SAMPLES SEED OUT.pfm
//
// Pixels in which any sample sees a source are written as -1, so that who compares can leave them
// out.
#include "raster/camera.h"
#include "raster/image_file.h"
#include "server/scene_file.h"
#include "solver/scene/polygon.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace patchlight {
namespace {

constexpr float start = 1e-5f;  // of the scene's size, from where rays leave a surface

struct Triangle {
    Eigen::Vector3f a, e1, e2, normal;
    Eigen::Array3f reflectance, exitance;
};

class Tracer {
  public:
    explicit Tracer(const Scene& scene) : size_(static_cast<float>(scene_size(scene))) {
        for (const Surface& surface : scene.surfaces) add(scene, surface);
        device_ = rtcNewDevice(nullptr);
        scene_ = rtcNewScene(device_);
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles_.size()));
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles_.size()));
        for (std::size_t t = 0; t < triangles_.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                Eigen::Vector3f p = triangles_[t].a;
                if (k == 1) p += triangles_[t].e1;
                if (k == 2) p += triangles_[t].e2;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    v[9 * t + 3 * k + axis] = p[static_cast<Eigen::Index>(axis)];
                index[3 * t + k] = static_cast<unsigned>(3 * t + k);
            }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }
    ~Tracer() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// Radiance along a ray from the eye, which looks through backs.
    Eigen::Array3f radiance(Eigen::Vector3f origin, Eigen::Vector3f direction,
                            std::mt19937_64& random, bool& sees_source) const {
        Eigen::Array3f sum = Eigen::Array3f::Zero(), weight = Eigen::Array3f::Ones();
        for (int bounce = 0; bounce < 64; ++bounce) {
            Eigen::Vector3f at;
            const Triangle* hit = nearest(origin, direction, bounce == 0, at);
            if (!hit) break;
            if (bounce == 0 && (hit->exitance > 0.0f).any()) {
                sees_source = true;
                sum += hit->exitance / std::numbers::pi_v<float>;
            }
            const Eigen::Vector3f above = at + start * size_ * hit->normal;
            weight *= hit->reflectance;
            sum += weight * from_sources(above, hit->normal, random) / std::numbers::pi_v<float>;
            const float survive = std::min(0.95f, weight.maxCoeff());
            if (bounce > 2) {
                if (uniform(random) >= survive) break;
                weight /= survive;
            }
            direction = cosine_direction(hit->normal, random);
            origin = above;
        }
        return sum;
    }

  private:
    static float uniform(std::mt19937_64& random) {
        return static_cast<float>(random() >> 40) * 0x1p-24f;
    }

    void add(const Scene& scene, const Surface& surface) {
        const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
        std::vector<Vec2> flat;
        for (const Vec3& p : surface.corners) flat.push_back(frame.flat(p));
        const Material& material = scene.materials[surface.material];
        for (const auto& [i, j, k] : triangulate(flat)) {
            const Vec3 &a = surface.corners[i], &b = surface.corners[j], &c = surface.corners[k];
            triangles_.push_back({a.cast<float>(), (b - a).cast<float>(), (c - a).cast<float>(),
                                  surface.normal.cast<float>(), material.reflectance.cast<float>(),
                                  material.exitance.cast<float>()});
            if (!(material.exitance > 0.0).any()) continue;
            sources_.push_back(triangles_.size() - 1);
            power_.push_back((power_.empty() ? 0.0 : power_.back()) +
                             0.5 * (b - a).cross(c - a).norm() * luminance(material.exitance));
        }
    }

    const Triangle* nearest(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                            bool through_backs, Eigen::Vector3f& at) const {
        float from = 0.0f;
        for (;;) {
            RTCRayHit query{};
            query.ray = {origin.x(),
                         origin.y(),
                         origin.z(),
                         from,
                         direction.x(),
                         direction.y(),
                         direction.z(),
                         0.0f,
                         1e30f,
                         ~0u,
                         0,
                         0};
            query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
            rtcIntersect1(scene_, &query, nullptr);
#else
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            rtcIntersect1(scene_, &context, &query);
#endif
            if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return nullptr;
            at = origin + query.ray.tfar * direction;
            const Triangle& triangle = triangles_[query.hit.primID];
            if (triangle.normal.dot(direction) < 0.0f) return &triangle;
            if (!through_backs) return nullptr;
            from = query.ray.tfar * 1.00001f;
        }
    }

    bool sees(const Eigen::Vector3f& from, const Eigen::Vector3f& ray) const {
        RTCRay query{from.x(), from.y(), from.z(), 0.0f, ray.x(), ray.y(),
                     ray.z(),  0.0f,     1.0f,     ~0u,  0,       0};
#if RTC_VERSION_MAJOR >= 4
        rtcOccluded1(scene_, &query, nullptr);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_, &context, &query);
#endif
        return query.tfar >= 0.0f;
    }

    Eigen::Array3f from_sources(const Eigen::Vector3f& at, const Eigen::Vector3f& normal,
                                std::mt19937_64& random) const {
        if (sources_.empty()) return Eigen::Array3f::Zero();
        const double pick = std::uniform_real_distribution<double>(0.0, power_.back())(random);
        const auto k = static_cast<std::size_t>(
            std::upper_bound(power_.begin(), power_.end() - 1, pick) - power_.begin());
        const Triangle& source = triangles_[sources_[k]];
        const double chance = (power_[k] - (k > 0 ? power_[k - 1] : 0.0)) / power_.back();
        const float root = std::sqrt(uniform(random)), v = uniform(random);
        const Eigen::Vector3f to = source.a + root * (1.0f - v) * source.e1 + root * v * source.e2 +
                                   start * size_ * source.normal;
        const Eigen::Vector3f ray = to - at;
        const float squared = ray.squaredNorm();
        const float cosines = std::max(0.0f, ray.dot(normal)) *
                              std::max(0.0f, -ray.dot(source.normal)) / (squared * squared);
        if (!(cosines > 0.0f) || !sees(at, ray)) return Eigen::Array3f::Zero();
        const float area = 0.5f * source.e1.cross(source.e2).norm();
        return source.exitance *
               (cosines * area / (std::numbers::pi_v<float> * static_cast<float>(chance)));
    }

    static Eigen::Vector3f cosine_direction(const Eigen::Vector3f& normal,
                                            std::mt19937_64& random) {
        const float u = uniform(random);
        const float angle = 2.0f * std::numbers::pi_v<float> * uniform(random);
        const Eigen::Vector3f helper =
            std::abs(normal.x()) < 0.5f ? Eigen::Vector3f::UnitX() : Eigen::Vector3f::UnitY();
        const Eigen::Vector3f tangent = normal.cross(helper).normalized();
        const float radius = std::sqrt(u);
        return radius * std::cos(angle) * tangent +
               radius * std::sin(angle) * normal.cross(tangent) + std::sqrt(1.0f - u) * normal;
    }

    float size_;
    std::vector<Triangle> triangles_;
    std::vector<std::size_t> sources_;
    std::vector<double> power_;  // cumulated over sources
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
};

raster::Image trace(const Tracer& tracer, const raster::Camera& camera, int samples,
                    std::uint64_t seed) {
    raster::Image image;
    image.width = camera.width;
    image.height = camera.height;
    image.rgb.resize(static_cast<std::size_t>(camera.width) *
                     static_cast<std::size_t>(camera.height) * 3);
    const Vec3 forward = (camera.look_at - camera.eye).normalized();
    const Vec3 right = forward.cross(camera.up).normalized();
    const Vec3 up = right.cross(forward);
    const double half = std::tan(camera.vertical_fov * std::numbers::pi / 360.0);
    const double aspect = static_cast<double>(camera.width) / camera.height;
    tbb::parallel_for(0, camera.height, [&](int y) {
        std::mt19937_64 random(seed * 1'000'003 + static_cast<std::uint64_t>(y));
        std::uniform_real_distribution<double> place(0.0, 1.0);
        for (int x = 0; x < camera.width; ++x) {
            Eigen::Array3f sum = Eigen::Array3f::Zero();
            bool sees_source = false;
            for (int n = 0; n < samples; ++n) {
                const double u = 2.0 * (x + place(random)) / camera.width - 1.0;
                const double v = 1.0 - 2.0 * (y + place(random)) / camera.height;
                const Vec3 ray = forward + half * (aspect * u * right + v * up);
                sum += tracer.radiance(camera.eye.cast<float>(), ray.normalized().cast<float>(),
                                       random, sees_source);
            }
            for (std::size_t c = 0; c < 3; ++c)
                image
                    .rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) +
                              static_cast<std::size_t>(x)) +
                         c] = sees_source
                                  ? -1.0f
                                  : sum[static_cast<Eigen::Index>(c)] / static_cast<float>(samples);
        }
    });
    return image;
}

}  // namespace
}  // namespace patchlight

int main(int argc, char** argv) {
    if (argc != 6) {
        std::fprintf(stderr, "usage: %s SCENE CAMERA SAMPLES SEED OUT.pfm\n", argv[0]);
        return 2;
    }
    const patchlight::server::Job job = patchlight::server::read_scene_file(argv[1]);
    for (const patchlight::server::NamedCamera& camera : job.cameras) {
        if (camera.name != argv[2]) continue;
        const patchlight::Tracer tracer(job.scene);
        const patchlight::raster::Image image = patchlight::trace(
            tracer, camera.camera, std::atoi(argv[3]), std::strtoull(argv[4], nullptr, 10));
        std::ofstream(argv[5], std::ios::binary) << patchlight::raster::encode_pfm(image);
        return 0;
    }
    std::fprintf(stderr, "no camera is named %s\n", argv[2]);
    return 2;
}
