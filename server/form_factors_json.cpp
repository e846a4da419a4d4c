#include "server/form_factors_json.h"

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

Json closure_of(const ClosureReport& closure) {
    return {{"row_sum",
             {{"min", closure.row_sum_min},
              {"max", closure.row_sum_max},
              {"mean", closure.row_sum_mean}}},
            {"closure_max", closure.closure_max},
            {"reciprocity_max", closure.reciprocity_max}};
}

}  // namespace

Json form_factors_block(const FormFactorReport& form_factors) {
    Json block = closure_of(form_factors.repaired);
    block["rays"] = form_factors.rays;
    block["open"] = form_factors.open;
    block["repair"] = {{"before", closure_of(form_factors.measured)},
                       {"after", closure_of(form_factors.repaired)}};
    if (const auto& hemicube = form_factors.hemicube)
        block["hemicube"] = {{"proximity", hemicube->proximity},
                             {"visibility", hemicube->visibility},
                             {"aliasing", hemicube->aliasing}};
    return block;
}

}  // namespace patchlight::server
