#include "server/http/scene_problem.h"

#include "server/input_errors.h"
#include "server/json_document.h"

#include <stdexcept>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

std::string kind_of(JsonFault fault) {
    switch (fault) {
        case JsonFault::syntax:
            return "json-syntax";
        case JsonFault::encoding:
            return "json-encoding";
        case JsonFault::number_range:
            return "json-number-range";
        case JsonFault::duplicate_key:
            return "json-duplicate-key";
        case JsonFault::too_deep:
            return "json-too-deep";
        case JsonFault::too_large:
            return "json-too-large";
    }
    throw std::logic_error("a fault without a kind");
}

Problem json_problem(const JsonError& error) {
    Problem problem{
        400, kind_of(error.fault()), "The body is not JSON as it has to be", error.what(), {}};
    if (!error.pointer().empty()) problem.members["pointer"] = error.pointer();
    if (error.line() > 0) {
        problem.members["offset"] = error.offset();
        problem.members["line"] = error.line();
        problem.members["column"] = error.column();
    }
    return problem;
}

Json error_list(const InputError& error) {
    Json list = Json::array();
    for (const InputFault& fault : faults_of(error))
        list.push_back({{"pointer", fault.pointer}, {"detail", fault.detail}});
    return list;
}

}  // namespace

Problem problem_of(const InputError& error) {
    if (const auto* const json = dynamic_cast<const JsonError*>(&error)) return json_problem(*json);
    return {422,
            "scene-invalid",
            "The scene cannot be solved as it is",
            error.what(),
            {{"pointer", error.pointer()}, {"errors", error_list(error)}}};
}

}  // namespace patchlight::server
