#include "server/files/obj_file.h"

#include "server/files/obj_materials.h"
#include "server/files/text_file.h"
#include "server/files/text_lines.h"
#include "server/wording.h"
#include "solver/scene/input_error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <unordered_map>

namespace patchlight::server {
namespace {

constexpr std::array<std::string_view, 16> without_area{
    "vt",     "vn",    "s",        "l",        "p",          "mg",        "lod",   "usemap",
    "maplib", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "ctech", "stech"};
constexpr std::array<std::string_view, 18> curved{"vp",    "cstype", "deg",  "bmat", "step", "curv",
                                                  "curv2", "surf",   "parm", "trim", "hole", "scrv",
                                                  "sp",    "end",    "con",  "bzp",  "bsp",  "res"};

template <std::size_t count>
bool is_among(const std::array<std::string_view, count>& known, std::string_view word) {
    return std::find(known.begin(), known.end(), word) != known.end();
}

class ObjReader {
  public:
    ObjReader(const std::filesystem::path& path, const std::string& file, std::string_view text)
        : lines_(text, file), materials_(path, file) {
        geometry_.file = file;
    }

    ImportedGeometry read() {
        while (lines_.next()) read_statement(lines_.word());
        check_indices();
        materials_.take_into(geometry_);
        std::erase_if(geometry_.parts, [](const FilePart& part) { return part.faces.empty(); });
        if (geometry_.parts.empty()) throw InputError(geometry_.file, "has no faces");
        remark_curved();
        return std::move(geometry_);
    }

  private:
    void read_statement(std::string_view key) {
        if (key == "v") return geometry_.vertices.push_back(lines_.point(largest_file_coordinate));
        if (key == "f" || key == "fo") return read_face();
        if (key == "o") return begin_object(std::string(lines_.rest()));
        if (key == "g") return begin_part(object_, std::string(lines_.rest()));
        if (key == "usemtl") {
            material_ = materials_.number_of(lines_.rest());
            return;
        }
        if (key == "mtllib") return materials_.open_library(lines_.rest());
        if (is_among(curved, key)) {
            ++curved_;
            return;
        }
        if (!is_among(without_area, key))
            lines_.reject("unknown statement " + in_quotes(key) + "; this is no OBJ file");
    }

    void begin_object(const std::string& name) {
        object_ = name;
        begin_part(name, "");
    }

    /// Faces that follow belong to the part of this path, which may have been begun before.
    void begin_part(const std::string& object, const std::string& group) {
        std::string path = object;
        if (!object.empty() && !group.empty()) path += '/';
        path += group;
        constexpr std::size_t longest = 512;
        if (path.size() > longest) lines_.reject("a name of more than 512 bytes is too long");
        const auto is_control = [](unsigned char byte) { return byte < 0x20 || byte == 0x7F; };
        std::replace_if(path.begin(), path.end(), is_control, ' ');
        const auto [found, is_new] = part_numbers_.try_emplace(path, geometry_.parts.size());
        if (is_new) geometry_.parts.push_back({path, {}});
        part_ = found->second;
    }

    void read_face() {
        if (geometry_.parts.empty()) begin_part("", "");
        if (++faces_ > most_file_faces)
            lines_.reject("more than " + std::to_string(most_file_faces) + " faces in one file");
        if (!material_) material_ = materials_.number_of("");
        FileFace face;
        face.first = static_cast<std::uint32_t>(geometry_.corners.size());
        face.material = *material_;
        face.line = lines_.line();
        for (; !lines_.at_end(); ++face.count) geometry_.corners.push_back(read_corner());
        if (face.count < 3)
            lines_.reject("a face must have at least 3 corners, not " + std::to_string(face.count));
        geometry_.parts[part_].faces.push_back(face);
    }

    /// "7", "7/1", "7//3" or "7/1/3": the first counts.
    std::uint32_t read_corner() {
        const std::string_view given = lines_.word();
        std::int64_t vertex = 0;
        std::string_view left = given;
        for (int part = 0; part < 3; ++part) {
            std::int64_t index = 1;
            const bool may_be_empty = part == 1;
            const auto read = std::from_chars(left.data(), left.data() + left.size(), index);
            const bool is_empty = read.ptr == left.data();
            if (index == 0 || (read.ec != std::errc() && !(is_empty && may_be_empty))) break;
            if (part == 0) vertex = index;
            left.remove_prefix(static_cast<std::size_t>(read.ptr - left.data()));
            if (left.empty() && !is_empty) return vertex_number(vertex, given);
            if (!left.starts_with('/')) break;
            left.remove_prefix(1);
        }
        lines_.reject(
            "a corner is a number from 1, or counted back from -1, such as 7, 7/1, 7//3 or "
            "7/1/3, not " +
            in_quotes(given));
    }

    /// Numbers from 1 may refer to vertices that are still to come: they are checked at the end.
    std::uint32_t vertex_number(std::int64_t index, std::string_view given) const {
        const auto before = static_cast<std::int64_t>(geometry_.vertices.size());
        constexpr std::int64_t most = std::int64_t{1} << 31;
        if (index < -before || index > most)
            lines_.reject("vertex " + in_quotes(given) + " does not exist; there are " +
                          std::to_string(before) + " vertices before this line");
        return static_cast<std::uint32_t>(index > 0 ? index - 1 : before + index);
    }

    void check_indices() const {
        for (const FilePart& part : geometry_.parts)
            for (const FileFace& face : part.faces)
                for (std::uint32_t k = face.first; k < face.first + face.count; ++k)
                    if (geometry_.corners[k] >= geometry_.vertices.size())
                        throw InputError(geometry_.place_of(face),
                                         "vertex " +
                                             std::to_string(std::size_t{geometry_.corners[k]} + 1) +
                                             " does not exist; there are " +
                                             std::to_string(geometry_.vertices.size()) +
                                             " vertices, numbered from 1");
    }

    void remark_curved() {
        if (curved_ == 0) return;
        geometry_.remarks.push_back({"unsupported-geometry",
                                     {},
                                     "curves and curved surfaces are left out of " + geometry_.file,
                                     "export them as polygons"});
    }

    TextLines lines_;
    ObjMaterials materials_;
    ImportedGeometry geometry_;
    std::unordered_map<std::string, std::size_t> part_numbers_;
    std::string object_;                     // of the last `o`
    std::size_t part_ = 0;                   // that faces go to
    std::optional<std::uint32_t> material_;  // that they get
    std::size_t faces_ = 0;
    std::size_t curved_ = 0;
};

}  // namespace

ImportedGeometry read_obj(const std::filesystem::path& path, const std::string& file) {
    const std::string text = read_text_file(path, file);
    return ObjReader(path, file, text).read();
}

}  // namespace patchlight::server
