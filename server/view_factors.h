#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace patchlight::server {

/// What view factors are told between: objects, faces or patches.
struct ViewFactorGroups {
    std::vector<std::string> names;  // empty: they are known by their index
    std::vector<double> areas;       // [m²]
};

/// View factors from one group to some others: the share of the light leaving `from` that arrives
/// directly at each of `to` [1]. All three have the same length.
struct ViewFactorRow {
    std::uint32_t from = 0;
    std::span<const std::uint32_t> to;
    std::span<const double> factor;
    std::span<const double> error;  // one standard error, absolute; NaN where it is not known
};

using TakeViewFactorRow = std::function<void(const ViewFactorRow&)>;

/// Hands its rows to whoever takes them, one after another; called once. Factors that are 0 in
/// single precision are not written.
using ViewFactorRows = std::function<void(const TakeViewFactorRow&)>;

}  // namespace patchlight::server
