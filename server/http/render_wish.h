#pragma once

#include "server/http/http_message.h"
#include "server/http/problem.h"
#include "server/job.h"
#include "server/run_job.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace patchlight::server {

/// What a client of /v1/render wants to get back, apart from the scene.
struct RenderWish {
    std::string content_type;  // of the answer
    std::optional<std::string> camera;
    std::optional<double> exposure;  // of PNG [stops]
};

/// From Content-Type, Accept and the query. What is wrong with them is an answer already.
std::variant<RenderWish, HttpAnswer> read_wish(const HttpRequest& request);

/// The pictures to take: one, or for JSON one of each camera.
std::variant<std::vector<PictureRequest>, Problem> wished_pictures(const RenderWish& wish,
                                                                   const Job& job);

/// The answer to a request that was carried out: a picture, or the result with pictures in it.
HttpAnswer render_answer(const RenderWish& wish, JobResult& result);

}  // namespace patchlight::server
