#include "server/files/gltf_instances.h"

#include <array>
#include <string>

namespace patchlight::server {
namespace {

constexpr std::size_t most_instances = 1'000'000;

/// The numbers of an attribute; none if it is not given. All that are given have one length.
std::vector<double> read_attribute(const JsonValue& attributes, const char* name,
                                   std::size_t components, std::size_t& count,
                                   GltfAccessors& accessors) {
    const auto reference = attributes.find(name);
    if (!reference) return {};
    std::vector<double> numbers = accessors.numbers(*reference, components);
    const std::size_t own = numbers.size() / components;
    if (own > most_instances)
        reference->reject("has " + std::to_string(own) + " instances; the limit is " +
                          std::to_string(most_instances));
    if (count > 0 && own != count)
        reference->reject("has " + std::to_string(own) + " instances, another attribute " +
                          std::to_string(count));
    count = own;
    return numbers;
}

}  // namespace

std::optional<std::vector<Eigen::Affine3d>> read_gltf_instances(const JsonValue& node,
                                                                GltfAccessors& accessors) {
    const auto extensions = node.find("extensions");
    if (!extensions) return std::nullopt;
    const auto extension = extensions->find("EXT_mesh_gpu_instancing");
    if (!extension) return std::nullopt;
    const JsonValue attributes = extension->at("attributes");
    std::size_t count = 0;
    const auto moves = read_attribute(attributes, "TRANSLATION", 3, count, accessors);
    const auto turns = read_attribute(attributes, "ROTATION", 4, count, accessors);
    const auto scales = read_attribute(attributes, "SCALE", 3, count, accessors);
    if (count == 0) attributes.reject("needs 'TRANSLATION', 'ROTATION' or 'SCALE'");
    std::vector<Eigen::Affine3d> places(count, Eigen::Affine3d::Identity());
    for (std::size_t k = 0; k < count; ++k) {
        if (!moves.empty()) places[k].translate(Eigen::Map<const Eigen::Vector3d>(&moves[3 * k]));
        if (!turns.empty()) {
            const Eigen::Quaterniond turn(turns[4 * k + 3], turns[4 * k], turns[4 * k + 1],
                                          turns[4 * k + 2]);
            if (!(turn.norm() > 0.5)) attributes.reject("a rotation is no unit quaternion");
            places[k].rotate(turn.normalized());
        }
        if (!scales.empty()) places[k].scale(Eigen::Map<const Eigen::Vector3d>(&scales[3 * k]));
    }
    return places;
}

}  // namespace patchlight::server
