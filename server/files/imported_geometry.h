#pragma once

#include "solver/scene/finding.h"
#include "solver/scene/light.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// A picture that paints a surface. Its mean colour counts.
struct FileTexture {
    std::string name;                          // as messages call it
    std::filesystem::path path;                // empty: it is in `bytes`, or was not found
    std::shared_ptr<const std::string> bytes;  // of a picture inside the geometry file
    std::string problem;                       // why there is neither
};

/// A material as a geometry file gives it, or one that its faces name and nothing defines.
struct FileMaterial {
    std::string name;                // empty: of faces that name none
    std::optional<Rgb> reflectance;  // may reach or pass 1 [1]
    Rgb radiance = Rgb::Zero();      // in the unit of light of the scene that uses it
    bool two_sided = false;
    std::optional<FileTexture> reflectance_texture;  // times `reflectance`, or times 1
    std::optional<FileTexture> radiance_texture;     // times `radiance`
    bool is_transparent = false;                     // left out: it is opaque
    bool is_metal = false;                           // left out: all it reflects is diffuse
};

/// A view that the file keeps. Lengths are in its unit.
struct FileCamera {
    std::string name;
    Vec3 eye = Vec3::Zero();
    Vec3 view = -Vec3::UnitZ();          // where it looks [1]
    Vec3 up = Vec3::UnitY();             // [1]
    std::optional<double> vertical_fov;  // empty: a parallel view [degrees]
    double height = 1.0;                 // of a parallel view
    double aspect = 1.0;                 // width over height [1]
};

struct FileFace {
    std::uint32_t first = 0;     // number of its first corner in `ImportedGeometry::corners`
    std::uint32_t count = 0;     // of corners, at least 3
    std::uint32_t material = 0;  // number in `ImportedGeometry::materials`
    std::uint32_t line = 0;      // of the file; 0 where lines mean nothing
};

/// Faces that become one object.
struct FilePart {
    std::string path;  // below the object that names the file; empty: that object itself
    std::vector<FileFace> faces;
};

/// What a geometry file holds, checked: indices exist, numbers are finite.
struct ImportedGeometry {
    std::string file;              // as messages call it
    std::optional<double> metres;  // in one unit of length; empty: the scene's unit [m]
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> corners;  // numbers of vertices, face after face
    std::vector<FileMaterial> materials;
    std::vector<FilePart> parts;  // none without faces
    std::vector<FileCamera> cameras;
    std::vector<Finding> remarks;          // on the file as a whole
    std::vector<Finding> about_materials;  // of interest where the file's materials are used

    std::size_t face_count() const {
        std::size_t count = 0;
        for (const FilePart& part : parts) count += part.faces.size();
        return count;
    }

    /// "room.obj:12", or the file alone.
    std::string place_of(const FileFace& face) const {
        return face.line > 0 ? file + ":" + std::to_string(face.line) : file;
    }
};

/// Beyond, a file is refused before the memory is spent.
constexpr std::size_t most_file_faces = 4'000'000;
constexpr double largest_file_coordinate = 1e15;  // in the file's unit of length
constexpr double brightest_file_radiance = 1e15;

}  // namespace patchlight::server
