#pragma once

#include <cmath>
#include <optional>
#include <string>

namespace patchlight::server {

/// A number this program worked out, beside what it should be.
struct KnownAnswer {
    std::string name;      // of the case
    std::string quantity;  // what was asked, with its unit unless it is a ratio
    std::string method;    // engine and solver, or the accuracy
    double result = 0.0;
    double exact = 0.0;
    double bound = 0.0;                    // largest |result − exact| that the method is allowed
    std::optional<double> published = {};  // as the source printed it
    double seconds = 0.0;                  // of the work since the answer before

    double error() const { return result - exact; }
    bool is_within() const { return std::abs(error()) <= bound; }  // not if it is not a number
};

}  // namespace patchlight::server
