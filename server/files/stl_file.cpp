#include "server/files/stl_file.h"

#include "server/files/file_bytes.h"
#include "server/files/text_file.h"
#include "server/files/text_lines.h"
#include "server/unique_names.h"
#include "server/utf8_text.h"
#include "server/wording.h"
#include "solver/scene/input_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_set>

namespace patchlight::server {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t header_bytes = 84;    // 80 of any text, then the number of triangles
constexpr std::size_t triangle_bytes = 50;  // a normal and three corners of floats, and 2 more

std::string lower_case(std::string_view word) {
    std::string lowered(word);
    for (char& letter : lowered)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return lowered;
}

void add_face(ImportedGeometry& geometry, std::uint32_t corners, std::uint32_t line) {
    const auto first = static_cast<std::uint32_t>(geometry.corners.size());
    for (std::uint32_t k = 0; k < corners; ++k) geometry.corners.push_back(first + k);
    if (first + corners > 3 * most_file_faces)
        throw InputError(geometry.file, "has more than " + std::to_string(most_file_faces) +
                                            " triangles, the limit");
    geometry.parts.back().faces.push_back({first, corners, 0, line});
}

std::uint32_t triangles_told(std::string_view bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + 80, sizeof count);
    return count;
}

/// The number of triangles ends in a NUL in every file within the limits, and text has none; nor
/// has it the byte that a number out of all reason ends in.
bool is_text(std::string_view bytes) {
    constexpr std::string_view in_no_text("\0\xFF", 2);
    return bytes.substr(0, header_bytes).find_first_of(in_no_text) == std::string_view::npos;
}

void require_all_triangles(std::string_view bytes, const std::string& file) {
    const std::size_t needed = header_bytes + triangle_bytes * std::size_t{triangles_told(bytes)};
    if (bytes.size() >= header_bytes && needed <= bytes.size() && triangles_told(bytes) > 0) return;
    if (bytes.size() == header_bytes) throw InputError(file, "has no triangles");
    throw InputError(file, "is no STL: text begins with 'solid'; a binary file of " +
                               std::to_string(triangles_told(bytes)) +
                               " triangles, as it says, has " + std::to_string(needed) +
                               " bytes, not " + std::to_string(bytes.size()));
}

void remark(ImportedGeometry& geometry, const char* kind, const std::string& detail,
            const char* remedy) {
    geometry.remarks.push_back({kind, {}, detail, remedy});
}

void read_binary(std::string_view bytes, ImportedGeometry& geometry) {
    require_all_triangles(bytes, geometry.file);
    const std::size_t more = bytes.size() - header_bytes - triangle_bytes * triangles_told(bytes);
    if (more > 0)
        remark(geometry, "trailing-bytes",
               std::to_string(more) + " bytes after the " + std::to_string(triangles_told(bytes)) +
                   " triangles that " + geometry.file + " announces are left out",
               "write the file again, if triangles are missing");
    geometry.parts.emplace_back();
    for (std::uint32_t number = 0; number < triangles_told(bytes); ++number) {
        float coordinates[9];
        constexpr std::size_t normal_bytes = 12;
        std::memcpy(coordinates,
                    bytes.data() + header_bytes + number * triangle_bytes + normal_bytes,
                    sizeof coordinates);
        for (const float coordinate : coordinates)
            if (!(std::abs(coordinate) <= largest_file_coordinate))
                throw InputError(geometry.file, "triangle " + std::to_string(number) +
                                                    ": a coordinate is " + number_text(coordinate) +
                                                    "; it must be within ±1e+15");
        for (int k = 0; k < 9; k += 3)
            geometry.vertices.emplace_back(coordinates[k], coordinates[k + 1], coordinates[k + 2]);
        add_face(geometry, 3, 0);
    }
}

class TextReader {
  public:
    TextReader(std::string_view text, ImportedGeometry& geometry)
        : lines_(text, geometry.file), geometry_(geometry) {}

    void read() {
        while (lines_.next()) {
            expect("solid");
            begin_solid(std::string(lines_.rest()));
            while (read_in_solid()) {
            }
        }
        // One solid is the object that names the file; several are told apart.
        if (geometry_.parts.size() == 1) geometry_.parts.front().path.clear();
        if (has_colours_)
            remark(geometry_, "colours-ignored", "colours of " + geometry_.file + " are left out",
                   "give its objects a `material`");
    }

  private:
    /// Solids without a name get their number, as objects do.
    void begin_solid(const std::string& name) {
        constexpr std::size_t longest = 512;
        if (name.size() > longest) lines_.reject("a name of more than 512 bytes is too long");
        std::string wanted = as_utf8(name);
        const auto is_control = [](unsigned char byte) { return byte < 0x20 || byte == 0x7F; };
        std::replace_if(wanted.begin(), wanted.end(), is_control, ' ');
        if (wanted.empty()) wanted = name_of_unnamed(geometry_.parts.size());
        std::string path = wanted;
        for (std::size_t number = 2; !paths_.insert(path).second; ++number)
            path = wanted + "#" + std::to_string(number);
        geometry_.parts.push_back({path, {}});
    }

    /// Returns whether the solid goes on.
    bool read_in_solid() {
        if (!lines_.next()) {
            remark(geometry_, "unfinished-file",
                   geometry_.file + " ends without 'endsolid': a part of it may be missing",
                   "write the file again");
            return false;
        }
        const std::string word = lower_case(lines_.word());
        if (is_end(word, "solid")) return false;
        if (word == "color" || word == "colour") return has_colours_ = true;
        if (word != "facet")
            lines_.reject("expected 'facet' or 'endsolid', not " + in_quotes(word));
        read_facet();
        return true;
    }

    /// After the word `facet`.
    void read_facet() {
        const std::uint32_t line = lines_.line();
        go_on("outer loop");
        std::uint32_t corners = 0;
        for (;; ++corners) {
            const char* const due = corners < 3 ? "vertex" : "endloop";
            if (!lines_.next())
                lines_.reject(std::string("the file ends where '") + due + "' should follow");
            const std::string word = lower_case(lines_.word());
            if (corners >= 3 && is_end(word, "loop")) break;
            if (word != "vertex")
                lines_.reject(std::string("expected '") + due + "', not " + in_quotes(word));
            geometry_.vertices.push_back(lines_.point(largest_file_coordinate));
        }
        if (!lines_.next()) lines_.reject("the file ends where 'endfacet' should follow");
        if (const std::string word = lower_case(lines_.word()); !is_end(word, "facet"))
            lines_.reject("expected 'endfacet', not " + in_quotes(word));
        add_face(geometry_, corners, line);
    }

    /// "endloop", or "end" and "loop" after it.
    bool is_end(const std::string& word, const std::string& of) {
        return word == "end" + of || (word == "end" && lower_case(lines_.word()) == of);
    }

    void expect(std::string_view words) {
        for (std::string_view left = words; !left.empty();) {
            const std::string_view word = left.substr(0, left.find(' '));
            left.remove_prefix(std::min(word.size() + 1, left.size()));
            if (const std::string_view found = lines_.word(); lower_case(found) != word)
                lines_.reject("expected " + in_quotes(words) + ", not " +
                              (found.empty() ? "the end of the line" : in_quotes(found)));
        }
    }

    void go_on(std::string_view expected) {
        if (!lines_.next())
            lines_.reject("the file ends where " + in_quotes(expected) + " should follow");
        expect(expected);
    }

    TextLines lines_;
    ImportedGeometry& geometry_;
    std::unordered_set<std::string> paths_;
    bool has_colours_ = false;
};

}  // namespace

ImportedGeometry read_stl(const std::filesystem::path& path, const std::string& file) {
    const std::string bytes = read_file_bytes(path, file);
    refuse_wide_text(bytes, file);
    ImportedGeometry geometry;
    geometry.file = file;
    geometry.materials.emplace_back();
    if (is_text(bytes) && !bytes.empty())
        TextReader(bytes, geometry).read();
    else
        read_binary(bytes, geometry);
    std::erase_if(geometry.parts, [](const FilePart& part) { return part.faces.empty(); });
    if (geometry.parts.empty()) throw InputError(file, "has no triangles");
    return geometry;
}

}  // namespace patchlight::server
