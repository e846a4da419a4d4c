#pragma once

#include "server/files/gltf_accessors.h"
#include "server/files/imported_geometry.h"

#include <Eigen/Geometry>

#include <span>
#include <string>
#include <unordered_set>
#include <vector>

namespace patchlight::server {

/// Walks the nodes of a glTF scene and puts their meshes into the geometry.
class GltfNodes {
  public:
    /// All have to outlive it. `geometry.materials` must be there, the nameless one last.
    GltfNodes(const JsonValue& root, GltfAccessors& accessors, ImportedGeometry& geometry);

    /// The scene that the file shows, or its first one; without any, all nodes that are no
    /// children. Throws InputError, also if a node is its own ancestor or has two parents.
    void read_scene();

  private:
    void read_children(const JsonValue& list, const std::string& path,
                       const Eigen::Affine3d& to_file, int depth);
    void read_node(const JsonValue& reference, std::size_t k, const std::string& parent,
                   const Eigen::Affine3d& to_file, int depth);
    void read_roots();
    std::string path_of(const JsonValue& node, std::size_t k, const std::string& parent);
    std::string unique(const std::string& wanted);
    void read_content(const JsonValue& node, const std::string& path,
                      const Eigen::Affine3d& to_file);
    void read_mesh(const JsonValue& node, const JsonValue& reference, const std::string& path,
                   const Eigen::Affine3d& to_file);
    void add_primitive(const JsonValue& primitive, std::span<const double> weights,
                       const Eigen::Affine3d& to_file, FilePart& part);
    void remark_on_rest(const JsonValue& node);
    void remark(bool& is_told, const char* kind, const char* detail, const char* remedy);

    const JsonValue& root_;
    GltfAccessors& accessors_;
    ImportedGeometry& geometry_;
    std::vector<bool> visited_;
    std::unordered_set<std::string> paths_;
    std::size_t faces_ = 0;
    bool has_light_ = false;  // that was told of, like those below
    bool has_skin_ = false;
    bool has_hidden_ = false;
    bool has_colours_ = false;
};

}  // namespace patchlight::server
