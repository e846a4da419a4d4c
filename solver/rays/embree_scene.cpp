#include "solver/rays/embree_scene.h"

#include <algorithm>
#include <new>
#include <stdexcept>

namespace patchlight {

EmbreeScene::EmbreeScene(const std::string& instructions) {
    std::string config = "threads=0,set_affinity=0";
    if (!instructions.empty()) config += ",isa=" + instructions;
    device_ = rtcNewDevice(config.c_str());
    if (!device_) throw std::bad_alloc();
    rtcSetDeviceErrorFunction(
        device_,
        [](void* error, RTCError code, const char*) { *static_cast<RTCError*>(error) = code; },
        &error_);
}

EmbreeScene::~EmbreeScene() {
    for (const RTCScene scene : own_) rtcReleaseScene(scene);
    if (whole_ != own_)
        for (const RTCScene scene : whole_) rtcReleaseScene(scene);
    rtcReleaseDevice(device_);
}

RTCScene EmbreeScene::new_scene() const {
    const RTCScene scene = rtcNewScene(device_);
    if (!scene) throw std::bad_alloc();
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    return scene;
}

void EmbreeScene::check() const {
    if (error_ == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error_ != RTC_ERROR_NONE)
        throw std::runtime_error("Embree could not build the scene: error " +
                                 std::to_string(error_));
}

void EmbreeScene::add_triangles(const std::vector<RayPoint>& vertices,
                                const std::vector<std::uint32_t>& indices) {
    own_.push_back(new_scene());
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex_buffer = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), vertices.size()));
    auto* index_buffer = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), indices.size() / 3));
    if (!vertices.empty() && (!vertex_buffer || !index_buffer)) throw std::bad_alloc();
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
            vertex_buffer[3 * v + static_cast<std::size_t>(axis)] = vertices[v][axis];
    std::copy(indices.begin(), indices.end(), index_buffer);
    rtcSetGeometryMask(geometry, ~0u);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(own_.back(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(own_.back());
    check();
}

void EmbreeScene::join(const std::function<Vec3(FrameIndex, FrameIndex)>& shift) {
    if (own_.size() == 1) {
        whole_ = own_;
        return;
    }
    for (std::size_t to = 0; to < own_.size(); ++to) {
        whole_.push_back(new_scene());
        for (std::size_t of = 0; of < own_.size(); ++of) {
            const RayPoint by =
                shift(static_cast<FrameIndex>(of), static_cast<FrameIndex>(to)).cast<float>();
            const std::array<float, 12> transform{1, 0, 0, 0,      1,      0,
                                                  0, 0, 1, by.x(), by.y(), by.z()};
            const RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(instance, own_[of]);
            rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                                    transform.data());
            rtcSetGeometryMask(instance, ~0u);
            rtcCommitGeometry(instance);
            rtcAttachGeometryByID(whole_.back(), instance, static_cast<unsigned>(of));
            rtcReleaseGeometry(instance);
        }
        rtcCommitScene(whole_.back());
    }
    check();
}

void intersect(RTCScene scene, const RayLanes& valid, RTCRayHit16& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid.data(), scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid.data(), scene, &context, &query);
#endif
}

void intersect(RTCScene scene, RTCRayHit& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
}

void occlude(RTCScene scene, const RayLanes& valid, RTCRay16& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded16(valid.data(), scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid.data(), scene, &context, &query);
#endif
}

}  // namespace patchlight
