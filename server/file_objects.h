#pragma once

#include "server/files/imported_geometry.h"
#include "server/files/texture_mean.h"
#include "server/heritage.h"
#include "server/import_remarks.h"
#include "server/job.h"
#include "server/json_value.h"
#include "server/material_names.h"
#include "server/unique_names.h"
#include "solver/scene/scene.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

namespace patchlight::server {

/// Objects that come from geometry files. A file is read once, however often it is named.
class FileObjects {
  public:
    /// `directory` is where the scene lies, as files are named relative to it; empty if the scene
    /// came from no file. `metres` is the length of one unit of the scene [m]. `scene` has its own
    /// materials, and only these.
    FileObjects(std::optional<std::filesystem::path> directory, double metres, Scene& scene,
                MaterialNames& names);

    /// What the file holds. Throws InputError at `file` that says where in the file, if need be.
    const ImportedGeometry& open(const JsonValue& file);

    /// Adds the parts of the file as objects at and below the path of `own`.
    void add(const JsonValue& file, const Heritage& own, UniqueNames& paths);

    /// Those that were read.
    std::vector<std::filesystem::path> files() const;

    /// Of the files that were added, where these were put, under names of their own.
    const std::vector<NamedCamera>& cameras() const { return cameras_; }

  private:
    struct OpenFile {
        ImportedGeometry geometry;
        std::vector<std::optional<MaterialIndex>> materials;  // of the scene, once they are wanted
        bool is_remarked = false;
        bool is_remarked_on_materials = false;
    };

    OpenFile& opened(const JsonValue& file);
    void add_part(const JsonValue& place, OpenFile& file, const FilePart& part, const Heritage& own,
                  std::span<const Vec3> vertices);
    MaterialIndex material_of(OpenFile& file, const FileFace& face, const Heritage& own);
    MaterialIndex import_material(const FileMaterial& material);
    void add_camera(const FileCamera& given, const Eigen::Affine3d& to_scene);
    void tell(const std::vector<Finding>& remarks, const std::string& path);

    std::optional<std::filesystem::path> directory_;
    double metres_;
    Scene& scene_;
    MaterialNames& names_;
    ImportRemarks remarks_;  // on the file that is being added
    TextureMeans textures_;
    std::size_t declared_;  // materials the scene itself has
    std::map<std::string, OpenFile> files_;
    std::vector<NamedCamera> cameras_;
    std::unordered_set<std::string> camera_names_;
};

}  // namespace patchlight::server
