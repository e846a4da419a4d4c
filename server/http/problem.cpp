#include "server/http/problem.h"

#include <algorithm>
#include <cmath>

namespace patchlight::server {

HttpAnswer answer_of(const Problem& problem) {
    nlohmann::ordered_json document{{"type", "urn:patchlight:" + problem.kind},
                                    {"title", problem.title},
                                    {"status", problem.status},
                                    {"detail", problem.detail}};
    if (!problem.members.empty()) document.update(problem.members);
    HttpAnswer answer;
    answer.status = problem.status;
    answer.content_type = "application/problem+json";
    answer.body =
        document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    return answer;
}

Problem wrong_parameter(const std::string& parameter, const std::string& detail) {
    return {
        422, "wrong-parameter", "A query parameter is wrong", detail, {{"parameter", parameter}}};
}

HttpAnswer try_again_later(const Problem& problem, double seconds) {
    constexpr double longest = 3600.0;
    const double wait = std::ceil(std::clamp(seconds, 1.0, longest));
    HttpAnswer answer = answer_of(problem);
    answer.fields.emplace_back("Retry-After", std::to_string(static_cast<int>(wait)));
    return answer;
}

}  // namespace patchlight::server
