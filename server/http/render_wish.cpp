#include "server/http/render_wish.h"

#include "server/http/base64.h"
#include "server/http/media_type.h"
#include "server/result_json.h"
#include "server/result_text.h"
#include "server/wording.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace patchlight::server {
namespace {

constexpr const char* scene_type = "application/json";
const std::array<std::string, 3> answer_types{"image/png", "image/x-exr", "application/json"};

std::optional<HttpAnswer> refused_body(const HttpRequest& request) {
    const auto coding = request.field("Content-Encoding");
    const auto type = request.field("Content-Type");
    const bool is_plain = !coding || same_field(*coding, "identity");
    if (is_plain && type && media_type(*type) == scene_type) return std::nullopt;
    HttpAnswer answer = answer_of(
        {415,
         "unsupported-media-type",
         "The body must be a scene as JSON",
         is_plain ? "send it as application/json; with curl: -H 'Content-Type: application/json' "
                    "--data-binary @scene.json"
                  : "send it as it is, without Content-Encoding",
         {}});
    answer.fields.emplace_back("Accept-Post", scene_type);
    return answer;
}

HttpAnswer not_acceptable() {
    return answer_of({406,
                      "not-acceptable",
                      "No such answer can be given",
                      "Accept must take one of `available`",
                      {{"available", answer_types}}});
}

/// From -100 to 100, as on the command line; NaN is refused.
std::optional<double> exposure_in(const std::string& text) {
    constexpr double most = 100.0;
    double exposure = 0.0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, exposure);
    const bool is_right = read.ec == std::errc() && read.ptr == end && std::abs(exposure) <= most;
    return is_right ? std::optional(exposure) : std::nullopt;
}

std::optional<Problem> read_parameter(const std::string& name, const std::string& value,
                                      RenderWish& wish) {
    if (name == "camera") {
        if (wish.camera) return wrong_parameter(name, "is given twice");
        wish.camera = value;
        return std::nullopt;
    }
    if (name != "exposure")
        return wrong_parameter(name, "unknown parameter " + in_quotes(name) +
                                         suggestion(name, {"camera", "exposure"}));
    if (wish.exposure) return wrong_parameter(name, "is given twice");
    wish.exposure = exposure_in(value);
    if (!wish.exposure)
        return wrong_parameter(
            name, "must be a number of stops from -100 to 100, not " + in_quotes(value));
    if (wish.content_type == "image/x-exr")
        return wrong_parameter(name, "image/x-exr holds linear light, which is not exposed");
    return std::nullopt;
}

ImageFormat format_of(const RenderWish& wish) {
    return wish.content_type == "image/x-exr" ? ImageFormat::exr : ImageFormat::png;
}

void add_status(const Solution& solution, HttpAnswer& answer) {
    answer.fields.emplace_back("Patchlight-Status", name_of(solution.status));
    if (solution.error.estimate)
        answer.fields.emplace_back("Patchlight-Error-Estimate",
                                   number_text(*solution.error.estimate));
    if (solution.error.algebraic_bound)
        answer.fields.emplace_back("Patchlight-Algebraic-Bound",
                                   number_text(*solution.error.algebraic_bound));
}

}  // namespace

std::variant<RenderWish, HttpAnswer> read_wish(const HttpRequest& request) {
    if (request.has_body)  // else the empty body is what there is to complain about
        if (auto refusal = refused_body(request)) return std::move(*refusal);
    const auto type = negotiated_type(request.field("Accept"), answer_types);
    if (!type) return not_acceptable();
    RenderWish wish{*type, {}, {}};
    for (const auto& [name, value] : request.query)
        if (const auto problem = read_parameter(name, value, wish)) return answer_of(*problem);
    return wish;
}

std::variant<std::vector<PictureRequest>, Problem> wished_pictures(const RenderWish& wish,
                                                                   const Job& job) {
    const bool wants_all = wish.content_type == scene_type && !wish.camera;
    std::vector<PictureRequest> pictures;
    std::vector<std::string> known;
    for (const NamedCamera& camera : job.cameras) {
        known.push_back(camera.name);
        const bool is_wished =
            wish.camera ? camera.name == *wish.camera : wants_all || pictures.empty();
        if (is_wished) pictures.push_back({camera, {format_of(wish)}, wish.exposure});
    }
    if (pictures.empty())
        return wrong_parameter("camera", "the scene has no camera " + in_quotes(*wish.camera) +
                                             suggestion(*wish.camera, known));
    return pictures;
}

HttpAnswer render_answer(const RenderWish& wish, JobResult& result) {
    HttpAnswer answer;
    answer.content_type = wish.content_type;
    add_status(result.solution, answer);
    if (wish.content_type != scene_type) {
        answer.body = std::move(result.images.at(0).bytes);
        return answer;
    }
    for (std::size_t k = 0; k < result.images.size(); ++k) {
        result.document["images"].at(k)["data"] = base64(result.images[k].bytes);
        result.images[k].bytes.clear();
    }
    answer.body = result_text(result.document);
    return answer;
}

}  // namespace patchlight::server
