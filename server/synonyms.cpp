#include "server/synonyms.h"

#include <array>

namespace patchlight::server {
namespace {

struct Synonym {
    std::string_view asked;  // in small letters, with _ between words
    std::string_view known;
};

/// What other programs call a thing. Of several lines for one word, the first that is known counts.
constexpr std::array synonyms{Synonym{"albedo", "reflectance"},
                              Synonym{"color", "reflectance"},
                              Synonym{"colour", "reflectance"},
                              Synonym{"diffuse", "reflectance"},
                              Synonym{"diffuse_color", "reflectance"},
                              Synonym{"base_color", "reflectance"},
                              Synonym{"basecolor", "reflectance"},
                              Synonym{"kd", "reflectance"},
                              Synonym{"rho", "reflectance"},
                              Synonym{"rgb", "reflectance"},
                              Synonym{"reflectivity", "reflectance"},
                              Synonym{"emission", "exitance"},
                              Synonym{"emissive", "exitance"},
                              Synonym{"emittance", "exitance"},
                              Synonym{"emit", "exitance"},
                              Synonym{"emitted", "exitance"},
                              Synonym{"emissivity", "exitance"},
                              Synonym{"light", "exitance"},
                              Synonym{"ke", "radiance"},
                              Synonym{"luminance", "radiance"},
                              Synonym{"brightness", "radiance"},
                              Synonym{"intensity", "radiance"},
                              Synonym{"doublesided", "two_sided"},
                              Synonym{"double_sided", "two_sided"},
                              Synonym{"power", "flux"},
                              Synonym{"lumens", "flux"},
                              Synonym{"lumen", "flux"},
                              Synonym{"watts", "flux"},
                              Synonym{"watt", "flux"},
                              Synonym{"position", "eye"},
                              Synonym{"from", "eye"},
                              Synonym{"origin", "eye"},
                              Synonym{"location", "eye"},
                              Synonym{"location", "position"},
                              Synonym{"point", "position"},
                              Synonym{"target", "look_at"},
                              Synonym{"lookat", "look_at"},
                              Synonym{"center", "look_at"},
                              Synonym{"to", "look_at"},
                              Synonym{"interest", "look_at"},
                              Synonym{"fov", "vertical_fov"},
                              Synonym{"yfov", "vertical_fov"},
                              Synonym{"field_of_view", "vertical_fov"},
                              Synonym{"angle", "vertical_fov"},
                              Synonym{"resolution", "size"},
                              Synonym{"film", "size"},
                              Synonym{"direction", "normal"},
                              Synonym{"orientation", "normal"},
                              Synonym{"vertices", "polygon"},
                              Synonym{"points", "polygon"},
                              Synonym{"corners", "polygon"},
                              Synonym{"points", "vertices"},
                              Synonym{"positions", "vertices"},
                              Synonym{"coordinates", "vertices"},
                              Synonym{"coordinates", "polygon"},
                              Synonym{"indices", "faces"},
                              Synonym{"triangles", "faces"},
                              Synonym{"polygons", "faces"},
                              Synonym{"translate", "translation"},
                              Synonym{"position", "translation"},
                              Synonym{"offset", "translation"},
                              Synonym{"rotate", "rotation"},
                              Synonym{"quaternion", "rotation"},
                              Synonym{"transform", "matrix"},
                              Synonym{"path", "file"},
                              Synonym{"filename", "file"},
                              Synonym{"src", "file"},
                              Synonym{"url", "file"},
                              Synonym{"group", "children"},
                              Synonym{"id", "name"},
                              Synonym{"openings", "holes"},
                              Synonym{"windows", "holes"},
                              Synonym{"inner", "holes"},
                              Synonym{"shapes", "objects"},
                              Synonym{"surfaces", "objects"},
                              Synonym{"geometry", "objects"},
                              Synonym{"meshes", "objects"},
                              Synonym{"camera", "cameras"},
                              Synonym{"view", "cameras"},
                              Synonym{"views", "cameras"},
                              Synonym{"sensor", "sensors"},
                              Synonym{"detectors", "sensors"},
                              Synonym{"settings", "solve"},
                              Synonym{"options", "solve"},
                              Synonym{"method", "solver"},
                              Synonym{"iterations", "max_iterations"},
                              Synonym{"samples", "rays"},
                              Synonym{"timeout", "time_limit"},
                              Synonym{"error", "accuracy"},
                              Synonym{"precision", "accuracy"},
                              Synonym{"metre", "m"},
                              Synonym{"meter", "m"},
                              Synonym{"metres", "m"},
                              Synonym{"meters", "m"},
                              Synonym{"millimetre", "mm"},
                              Synonym{"millimeter", "mm"},
                              Synonym{"millimetres", "mm"},
                              Synonym{"millimeters", "mm"},
                              Synonym{"centimetre", "cm"},
                              Synonym{"centimeter", "cm"},
                              Synonym{"centimetres", "cm"},
                              Synonym{"centimeters", "cm"},
                              Synonym{"inch", "in"},
                              Synonym{"inches", "in"},
                              Synonym{"feet", "ft"},
                              Synonym{"foot", "ft"},
                              Synonym{"orthographic", "parallel"},
                              Synonym{"ortho", "parallel"}};

}  // namespace

const std::string* synonym_of(std::string_view asked, const std::vector<std::string>& known) {
    for (const Synonym& synonym : synonyms)
        if (synonym.asked == asked)
            for (const std::string& candidate : known)
                if (candidate == synonym.known) return &candidate;
    return nullptr;
}

}  // namespace patchlight::server
