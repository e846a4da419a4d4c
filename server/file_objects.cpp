#include "server/file_objects.h"

#include "server/file_camera.h"
#include "server/files/geometry_file.h"
#include "server/materials_json.h"
#include "server/utf8_text.h"
#include "server/wording.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace patchlight::server {
namespace {

constexpr double largest_coordinate = 1e9;      // of a point in the scene [m]
constexpr double highest_reflectance = 0.99;    // that a file's 1 and more is read as
constexpr double reflectance_of_unknown = 0.5;  // of faces whose material nothing defines

std::vector<Vec3> placed(const ImportedGeometry& geometry, const Eigen::Affine3d& to_scene) {
    std::vector<Vec3> vertices;
    vertices.reserve(geometry.vertices.size());
    for (const Vec3& vertex : geometry.vertices) vertices.push_back(to_scene * vertex);
    return vertices;
}

std::vector<Vec3> corners_of(const ImportedGeometry& geometry, const FileFace& face,
                             std::span<const Vec3> vertices, bool mirrored) {
    std::vector<Vec3> corners;
    corners.reserve(face.count);
    for (std::uint32_t k = 0; k < face.count; ++k)
        corners.push_back(vertices[geometry.corners[face.first + k]]);
    if (mirrored) std::reverse(corners.begin() + 1, corners.end());
    return corners;
}

void require_in_reach(std::span<const Vec3> corners) {
    for (const Vec3& corner : corners)
        if (!(corner.array().abs() <= largest_coordinate).all())
            throw InputError("", "a corner lies at " + number_text(corner.cwiseAbs().maxCoeff()) +
                                     " m; coordinates must be within 1e9 m of the origin");
}

/// Not so for one that lies out of reach, or that a slanted scale has laid flat.
bool spans_a_view(const raster::Camera& camera) {
    constexpr double least_sine = 1e-6;
    const Vec3 view = camera.look_at - camera.eye;
    return (camera.eye.array().abs() <= largest_coordinate).all() && view.norm() > 0.5 &&
           view.cross(camera.up).norm() > least_sine;
}

}  // namespace

FileObjects::FileObjects(std::optional<std::filesystem::path> directory, double metres,
                         Scene& scene, MaterialNames& names)
    : directory_(std::move(directory)),
      metres_(metres),
      scene_(scene),
      names_(names),
      declared_(scene.materials.size()) {}

const ImportedGeometry& FileObjects::open(const JsonValue& file) { return opened(file).geometry; }

FileObjects::OpenFile& FileObjects::opened(const JsonValue& file) {
    const std::string& name = file.text();
    if (!directory_)
        file.reject(
            "is relative to the scene's own file, and this scene came from none; give the "
            "geometry as `mesh`");
    if (name.find('\0') != std::string::npos) file.reject("a NUL is in no file's name");
    if (const auto found = files_.find(name); found != files_.end()) return found->second;
    try {
        ImportedGeometry geometry = read_geometry_file(*directory_ / name, as_utf8(name));
        const std::size_t materials = geometry.materials.size();
        OpenFile& kept = files_[name];
        kept.geometry = std::move(geometry);
        kept.materials.resize(materials);
        return kept;
    } catch (const InputError& error) {
        file.reject(error.pointer() + ": " + error.what());
    }
}

std::vector<std::filesystem::path> FileObjects::files() const {
    std::vector<std::filesystem::path> paths;
    for (const auto& [name, file] : files_) paths.push_back(*directory_ / name);
    return paths;
}

void FileObjects::add(const JsonValue& place, const Heritage& given, UniqueNames& paths) {
    OpenFile& file = opened(place);
    const ImportedGeometry& geometry = file.geometry;
    Heritage own = given;
    if (geometry.metres) own.to_scene.scale(*geometry.metres / metres_);
    if (!std::exchange(file.is_remarked, true)) tell(geometry.remarks, own.path);
    if (!own.material && !std::exchange(file.is_remarked_on_materials, true))
        tell(geometry.about_materials, own.path);
    for (const FileCamera& camera : geometry.cameras) add_camera(camera, own.to_scene);
    const std::vector<Vec3> vertices = placed(geometry, own.to_scene);
    for (const FilePart& part : geometry.parts) {
        Heritage at = own;
        if (!part.path.empty()) {
            at.path += "/" + part.path;
            paths.claim(at.path, place);
        }
        add_part(place, file, part, at, vertices);
    }
    tell(std::exchange(remarks_, {}).findings(own.path, geometry.file), own.path);
}

void FileObjects::add_part(const JsonValue& place, OpenFile& file, const FilePart& part,
                           const Heritage& own, std::span<const Vec3> vertices) {
    const auto object = static_cast<ObjectIndex>(scene_.objects.size());
    scene_.objects.push_back({own.path});
    const bool mirrored = own.to_scene.linear().determinant() < 0;
    std::uint32_t number = 0;
    for (const FileFace& face : part.faces) {
        try {
            const auto corners = corners_of(file.geometry, face, vertices, mirrored);
            require_in_reach(corners);
            add_polygon(scene_, object, material_of(file, face, own), number++, corners, "");
        } catch (const InputError& error) {
            place.reject(file.geometry.place_of(face) + ": " + error.what());
        }
    }
}

MaterialIndex FileObjects::material_of(OpenFile& file, const FileFace& face, const Heritage& own) {
    if (own.material) return *own.material;
    std::optional<MaterialIndex>& known = file.materials[face.material];
    if (known) return *known;
    const FileMaterial& material = file.geometry.materials[face.material];
    known =
        find_material(std::span<const Material>(scene_.materials).first(declared_), material.name);
    if (!known) known = import_material(material);
    return *known;
}

MaterialIndex FileObjects::import_material(const FileMaterial& read) {
    FileMaterial given = read;
    const PaintReport textures = textures_.paint(given);
    remarks_.look_at(given, textures);
    Material material;
    material.name = given.name.empty() ? "default" : given.name;
    material.reflectance = given.reflectance.value_or(Rgb::Constant(reflectance_of_unknown));
    material.reflectance =
        (material.reflectance < 1.0).select(material.reflectance, highest_reflectance);
    material.exitance = std::numbers::pi * given.radiance;
    material.two_sided = given.two_sided;
    return names_.add(std::move(material));
}

void FileObjects::add_camera(const FileCamera& given, const Eigen::Affine3d& to_scene) {
    constexpr std::size_t most = 1000;
    if (cameras_.size() >= most) return;
    NamedCamera named = placed_camera(given, to_scene);
    if (!spans_a_view(named.camera)) return;
    const std::string wanted = named.name;
    for (std::size_t number = 2; !camera_names_.insert(named.name).second; ++number)
        named.name = wanted + "#" + std::to_string(number);
    cameras_.push_back(std::move(named));
}

void FileObjects::tell(const std::vector<Finding>& remarks, const std::string& path) {
    for (Finding remark : remarks) {
        remark.objects = {path};
        scene_.findings.push_back(std::move(remark));
    }
}

}  // namespace patchlight::server
