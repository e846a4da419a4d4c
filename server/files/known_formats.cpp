#include "server/files/known_formats.h"

#include <algorithm>
#include <array>

namespace patchlight::server {
namespace {

constexpr std::string_view convert = "convert it to glTF, OBJ or STL";
constexpr std::string_view convert_with_blender = "export it as glTF, with Blender for instance";
constexpr std::string_view from_cad = "export it as glTF, OBJ or STL from the program that made it";
constexpr std::string_view unpack = "unpack it first";
constexpr std::string_view not_a_scene = "it is a result or a picture, not a scene";
constexpr std::string_view lamps =
    "luminaires are not built yet: give a surface that emits, with its `flux`";
constexpr std::string_view write_json =
    "write its surfaces as `objects` of a scene, or convert its geometry to OBJ";

struct Format {
    std::string_view endings;  // with a blank after each
    std::string_view name;
    std::string_view remedy;
};

constexpr std::array formats{
    Format{".ply ", "a PLY mesh", convert},
    Format{".off ", "an OFF mesh", convert},
    Format{".fbx ", "an FBX scene", convert_with_blender},
    Format{".dae ", "a COLLADA scene", convert_with_blender},
    Format{".usd .usda .usdc .usdz ", "a USD scene", convert_with_blender},
    Format{".blend ", "a Blender file", "export it as glTF from Blender"},
    Format{".3ds ", "a 3DS scene", convert_with_blender},
    Format{".max ", "a 3ds Max scene", "export it as OBJ from 3ds Max"},
    Format{".ma .mb ", "a Maya scene", "export it as OBJ from Maya"},
    Format{".c4d ", "a Cinema 4D scene", "export it as glTF or OBJ from Cinema 4D"},
    Format{".lwo .lws ", "a LightWave scene", convert},
    Format{".x3d .wrl .vrml .x3dv ", "an X3D or VRML scene", convert},
    Format{".x ", "a DirectX mesh", convert},
    Format{".abc ", "an Alembic scene", convert_with_blender},
    Format{".3mf .amf ", "a 3MF or AMF model", convert},
    Format{".ifc .ifczip .ifcxml ", "an IFC building model",
           "convert it to glTF or OBJ, with IfcConvert for instance"},
    Format{".step .stp ", "a STEP model", from_cad},
    Format{".iges .igs ", "an IGES model", from_cad},
    Format{".brep .sat .x_t .prt .sldprt .catpart .f3d ", "a CAD model", from_cad},
    Format{".dxf ", "a DXF drawing", convert},
    Format{".dwg ", "a DWG drawing", from_cad},
    Format{".dgn ", "a DGN drawing", from_cad},
    Format{".rvt .rfa ", "a Revit model", from_cad},
    Format{".skp ", "a SketchUp model", "export it as glTF or OBJ from SketchUp"},
    Format{".3dm ", "a Rhino model", "export it as OBJ or glTF from Rhino"},
    Format{".ies ", "an IES photometric file", lamps},
    Format{".ldt .eul ", "an EULUMDAT photometric file", lamps},
    Format{".rad ", "a Radiance scene", "convert it to OBJ, and give `materials` in a scene"},
    Format{".oct ", "a Radiance octree", "convert the scene it was made of to OBJ"},
    Format{".vs3 .vs2 ", "a View3D input", write_json},
    Format{".pbrt ", "a PBRT scene", "export its meshes as OBJ, and give `materials` in a scene"},
    Format{".mitsuba ", "a Mitsuba scene", convert},
    Format{".pov ", "a POV-Ray scene", convert},
    Format{".idf .epjson ", "an EnergyPlus model", write_json},
    Format{".osm ", "an OpenStudio or OpenStreetMap model", write_json},
    Format{".gbxml ", "a gbXML model", write_json},
    Format{".hbjson .dfjson ", "a Honeybee model", write_json},
    Format{".cityjson .citygml .gml ", "a city model", convert},
    Format{".vtk .vtu .vtp .vtm .msh .inp .nas .bdf .unv ", "a simulation mesh", convert},
    Format{".las .laz .pcd .xyz .e57 ", "a cloud of points, which has no surfaces",
           "make a mesh of it first"},
    Format{".mtl ", "a material library of an OBJ file", "name the OBJ file"},
    Format{".bin ", "the data of a glTF file", "name the .gltf file"},
    Format{".png .jpg .jpeg .exr .hdr .pfm .tif .tiff .bmp .tga .webp .gif .svg .pdf ", "a picture",
           not_a_scene},
    Format{".csv .html .htm .txt .xlsx .mtx ", "no scene", not_a_scene},
    Format{".yaml .yml .toml ", "YAML or TOML", "write the scene as JSON"},
    Format{".zip .gz .7z .rar .tar .tgz .bz2 .xz .zst ", "an archive", unpack}};

struct Beginning {
    std::string_view bytes;
    std::string_view ending;  // of the format that begins so
};

constexpr std::array beginnings{Beginning{"ply\n", ".ply "},
                                Beginning{"ply\r", ".ply "},
                                Beginning{"OFF\n", ".off "},
                                Beginning{"OFF\r", ".off "},
                                Beginning{"COFF", ".off "},
                                Beginning{"Kaydara FBX Binary", ".fbx "},
                                Beginning{"; FBX ", ".fbx "},
                                Beginning{";FBX ", ".fbx "},
                                Beginning{"#usda", ".usda "},
                                Beginning{"PXR-USDC", ".usdc "},
                                Beginning{"BLENDER", ".blend "},
                                Beginning{"MM", ".3ds "},
                                Beginning{"//Maya", ".ma "},
                                Beginning{"#VRML", ".wrl "},
                                Beginning{"#X3D", ".x3d "},
                                Beginning{"xof 0", ".x "},
                                Beginning{"AC10", ".dwg "},
                                Beginning{"AutoCAD Binary DXF", ".dxf "},
                                Beginning{"3D Geometry File Format", ".3dm "},
                                Beginning{"IESNA", ".ies "},
                                Beginning{"IESNA:LM-63", ".ies "},
                                Beginning{"#?RADIANCE", ".hdr "},
                                Beginning{"#?RGBE", ".hdr "},
                                Beginning{"# vtk DataFile", ".vtk "},
                                Beginning{"$MeshFormat", ".msh "},
                                Beginning{"LASF", ".las "},
                                Beginning{"# .PCD", ".pcd "},
                                Beginning{"\x89PNG", ".png "},
                                Beginning{"\xFF\xD8\xFF", ".jpg "},
                                Beginning{"\x76\x2F\x31\x01", ".exr "},
                                Beginning{"PF\n", ".pfm "},
                                Beginning{"II*", ".tif "},
                                Beginning{"GIF8", ".gif "},
                                Beginning{"%PDF", ".pdf "},
                                Beginning{"PK\x03\x04", ".zip "},
                                Beginning{"\x1F\x8B", ".gz "},
                                Beginning{"7z\xBC\xAF", ".7z "},
                                Beginning{"Rar!", ".rar "},
                                Beginning{"\xFD"
                                          "7zXZ",
                                          ".xz "},
                                Beginning{"\x28\xB5\x2F\xFD", ".zst "}};

/// What tells formats that begin alike apart, as XML does.
constexpr std::array marks{Beginning{"<COLLADA", ".dae "},       Beginning{"<X3D", ".x3d "},
                           Beginning{"<gbXML", ".gbxml "},       Beginning{"<CityModel", ".gml "},
                           Beginning{":CityModel", ".gml "},     Beginning{"<VTKFile", ".vtu "},
                           Beginning{"<amf", ".amf "},           Beginning{"<ifcXML", ".ifcxml "},
                           Beginning{"<svg", ".svg "},           Beginning{"<scene", ".mitsuba "},
                           Beginning{"<html", ".html "},         Beginning{"<HTML", ".html "},
                           Beginning{"<!DOCTYPE html", ".html "}};

std::string told(const Format& format) {
    std::string text = "is ";
    text.append(format.name).append(", which is not read; ").append(format.remedy);
    return text;
}

std::string told(std::string_view ending) {
    for (const Format& format : formats)
        if (format.endings.find(ending) != std::string_view::npos) return told(format);
    return "";
}

bool holds(std::string_view bytes, std::string_view text) {
    return bytes.find(text) != std::string_view::npos;
}

/// STEP is one syntax for several models.
std::string exchange_file(std::string_view start) {
    return told(holds(start, "IFC") ? ".ifc " : ".step ");
}

/// A word at the beginning of some line: Radiance scenes are lists of "modifier type name".
bool is_radiance(std::string_view start) {
    for (const char* type : {"void plastic ", "void glow ", "void light ", "void metal ",
                             "void trans ", "void glass ", "!genbox ", "!xform ", "!genrbox "})
        if (holds(start, type)) return true;
    return false;
}

bool is_dxf(std::string_view start) {
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
    return start.starts_with("0") && holds(start.substr(0, 40), "SECTION");
}

/// Geometry that would be read under its own name.
std::string misnamed(std::string_view bytes, std::string_view start) {
    constexpr std::string_view rename = " by its content; give its name the ending ";
    const auto as = [&](const char* what, const char* ending) {
        return std::string("is ").append(what).append(rename).append(ending);
    };
    if (bytes.starts_with("glTF")) return as("GLB", ".glb");
    if (start.starts_with("solid") && holds(start, "facet")) return as("STL", ".stl");
    if (holds(start, "\nv ") && (holds(bytes, "\nf ") || holds(start, "mtllib ")))
        return as("OBJ", ".obj");
    if (start.starts_with("newmtl ") || holds(start, "\nnewmtl ")) return told(".mtl ");
    return "";
}

}  // namespace

std::string foreign_content(std::string_view bytes) {
    constexpr std::size_t looked_at = 4096;
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    const std::string_view start = bytes.substr(0, looked_at);
    for (const Beginning& beginning : beginnings)
        if (start.starts_with(beginning.bytes)) return told(beginning.ending);
    if (start.starts_with("ISO-10303-21")) return exchange_file(start);
    if (start
            .substr(start.find_first_not_of(" \t\r\n") == std::string_view::npos
                        ? start.size()
                        : start.find_first_not_of(" \t\r\n"))
            .starts_with("<")) {
        for (const Beginning& mark : marks)
            if (holds(start, mark.bytes)) return told(mark.ending);
        return "is XML, which is not read; write the scene as JSON, or its geometry as glTF, OBJ "
               "or STL";
    }
    if (is_dxf(start)) return told(".dxf ");
    if (is_radiance(start)) return told(".rad ");
    return misnamed(bytes, start);
}

std::string foreign_name(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    for (char& letter : ending)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return ending.empty() ? "" : told(ending + " ");
}

}  // namespace patchlight::server
