#include "server/files/gltf_nodes.h"

#include "server/files/gltf_buffers.h"
#include "server/files/gltf_camera.h"
#include "server/files/gltf_instances.h"
#include "server/files/gltf_primitive.h"
#include "server/transform_json.h"
#include "server/unique_names.h"
#include "server/utf8_text.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace patchlight::server {
namespace {

/// Such as will do in a path.
std::string cleaned(std::string name) {
    constexpr std::size_t longest = 200;
    if (name.size() > longest) name.resize(longest);
    const auto is_control = [](unsigned char byte) { return byte < 0x20 || byte == 0x7F; };
    std::replace_if(name.begin(), name.end(), is_control, ' ');
    return as_utf8(name);  // it may have been cut within a character
}

/// It is not shown, nor is what is below it (KHR_node_visibility).
bool is_hidden(const JsonValue& node) {
    const auto extensions = node.find("extensions");
    const auto extension =
        extensions ? extensions->find("KHR_node_visibility") : std::optional<JsonValue>();
    const auto visible = extension ? extension->find("visible") : std::optional<JsonValue>();
    return visible && !visible->boolean();
}

/// Those of the node go before those of its mesh.
std::vector<double> morph_weights(const JsonValue& node, const JsonValue& mesh) {
    std::vector<double> weights;
    constexpr Range range{-1e6, 1e6};
    for (const JsonValue* owner : {&node, &mesh})
        if (const auto list = owner->find("weights")) {
            list->for_each_element(
                [&](const JsonValue& weight) { weights.push_back(weight.number(range)); });
            break;
        }
    return weights;
}

std::size_t node_count(const JsonValue& root) {
    const auto nodes = root.find("nodes");
    return nodes ? nodes->size() : 0;
}

}  // namespace

GltfNodes::GltfNodes(const JsonValue& root, GltfAccessors& accessors, ImportedGeometry& geometry)
    : root_(root), accessors_(accessors), geometry_(geometry), visited_(node_count(root)) {}

void GltfNodes::read_scene() {
    const auto shown = root_.find("scene");
    const auto scenes = root_.find("scenes");
    if (!shown && (!scenes || scenes->size() == 0)) return read_roots();
    const std::size_t index = shown ? gltf_index(*shown, root_, "scenes") : 0;
    const JsonValue scene = (*scenes)[index];
    if (const auto nodes = scene.find("nodes"))
        read_children(*nodes, "", Eigen::Affine3d::Identity(), 0);
}

void GltfNodes::read_children(const JsonValue& list, const std::string& path,
                              const Eigen::Affine3d& to_file, int depth) {
    constexpr int deepest = 200;
    if (depth > deepest) list.reject("nodes inside one another more than 200 deep");
    for (std::size_t k = 0; k < list.size(); ++k) read_node(list[k], k, path, to_file, depth);
}

void GltfNodes::read_node(const JsonValue& reference, std::size_t k, const std::string& parent,
                          const Eigen::Affine3d& to_file, int depth) {
    const std::size_t index = gltf_index(reference, root_, "nodes");
    if (visited_[index])
        reference.reject("node " + std::to_string(index) +
                         " is met twice: it has two parents, or is its own ancestor");
    visited_[index] = true;
    const JsonValue nodes = root_.at("nodes");
    const JsonValue node = nodes[index];
    if (is_hidden(node))
        return remark(has_hidden_, "hidden-left-out", "nodes that the file hides are left out",
                      "show them before the export, if light should meet them");
    const std::string path = path_of(node, k, parent);
    const Eigen::Affine3d own = to_file * read_transform(node);
    read_content(node, path, own);
    remark_on_rest(node);
    if (const auto children = node.find("children")) read_children(*children, path, own, depth + 1);
}

void GltfNodes::read_roots() {
    std::vector<bool> is_child(visited_.size());
    const auto nodes = root_.find("nodes");
    for (std::size_t k = 0; k < visited_.size(); ++k) {
        const JsonValue node = (*nodes)[k];
        if (const auto children = node.find("children"))
            children->for_each_element([&](const JsonValue& child) {
                is_child[gltf_index(child, root_, "nodes")] = true;
            });
    }
    nlohmann::json roots = nlohmann::json::array();
    for (std::size_t k = 0; k < visited_.size(); ++k)
        if (!is_child[k]) roots.push_back(k);
    read_children(JsonValue(roots), "", Eigen::Affine3d::Identity(), 0);
}

/// Siblings of one name are told apart: "chair", "chair#2".
std::string GltfNodes::path_of(const JsonValue& node, std::size_t k, const std::string& parent) {
    const auto name = node.find("name");
    const std::string own = name ? cleaned(name->text()) : "";
    return unique((parent.empty() ? "" : parent + "/") + (own.empty() ? name_of_unnamed(k) : own));
}

std::string GltfNodes::unique(const std::string& wanted) {
    std::string path = wanted;
    for (std::size_t number = 2; !paths_.insert(path).second; ++number)
        path = wanted + "#" + std::to_string(number);
    return path;
}

/// A node that places its mesh many times has an object for each place.
void GltfNodes::read_content(const JsonValue& node, const std::string& path,
                             const Eigen::Affine3d& to_file) {
    if (const auto camera = node.find("camera"))
        geometry_.cameras.push_back(read_gltf_camera(*camera, root_, path, to_file));
    const auto mesh = node.find("mesh");
    if (!mesh) return;
    const auto places = read_gltf_instances(node, accessors_);
    if (!places) return read_mesh(node, *mesh, path, to_file);
    for (std::size_t k = 0; k < places->size(); ++k)
        read_mesh(node, *mesh, unique(path + "/" + name_of_unnamed(k)), to_file * (*places)[k]);
}

void GltfNodes::read_mesh(const JsonValue& node, const JsonValue& reference,
                          const std::string& path, const Eigen::Affine3d& to_file) {
    const JsonValue meshes = root_.at("meshes");
    const JsonValue mesh = meshes[gltf_index(reference, root_, "meshes")];
    const std::vector<double> weights = morph_weights(node, mesh);
    FilePart part{path, {}};
    const JsonValue primitives = mesh.at("primitives");
    primitives.for_each_element(
        [&](const JsonValue& primitive) { add_primitive(primitive, weights, to_file, part); });
    if (!part.faces.empty()) geometry_.parts.push_back(std::move(part));
}

void GltfNodes::add_primitive(const JsonValue& primitive, std::span<const double> weights,
                              const Eigen::Affine3d& to_file, FilePart& part) {
    const auto named = primitive.find("material");
    const std::size_t material =
        named ? gltf_index(*named, root_, "materials") : geometry_.materials.size() - 1;
    const GltfTriangles read = read_gltf_primitive(primitive, weights, accessors_);
    if (read.has_colours)
        remark(has_colours_, "colours-ignored", "colours of vertices are left out",
               "give the materials their mean colours");
    faces_ += read.triangles.size();
    if (faces_ > most_file_faces)
        primitive.reject("brings the file to " + std::to_string(faces_) +
                         " triangles; the limit is " + std::to_string(most_file_faces));
    constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> numbers(read.positions.size(), unseen);  // of those that are used
    const bool mirrored = to_file.linear().determinant() < 0;
    for (auto triangle : read.triangles) {
        if (mirrored) std::swap(triangle[1], triangle[2]);  // fronts stay fronts
        part.faces.push_back({static_cast<std::uint32_t>(geometry_.corners.size()), 3,
                              static_cast<std::uint32_t>(material), 0});
        for (const std::uint32_t corner : triangle) {
            if (numbers[corner] == unseen) {
                numbers[corner] = static_cast<std::uint32_t>(geometry_.vertices.size());
                geometry_.vertices.push_back(to_file * read.positions[corner]);
            }
            geometry_.corners.push_back(numbers[corner]);
        }
    }
}

void GltfNodes::remark_on_rest(const JsonValue& node) {
    const auto extensions = node.find("extensions");
    if (extensions && extensions->has("KHR_lights_punctual"))
        remark(has_light_, "unsupported-light",
               "lights without area (point, spot, directional) are left out",
               "give each lamp a surface that emits");
    if (node.has("skin"))
        remark(has_skin_, "unsupported-skin", "meshes with a skin are taken as they are without it",
               "export them in the pose that is wanted, without a skin");
}

void GltfNodes::remark(bool& is_told, const char* kind, const char* detail, const char* remedy) {
    if (!std::exchange(is_told, true)) geometry_.remarks.push_back({kind, {}, detail, remedy});
}

}  // namespace patchlight::server
