#include "solver/findings/merge.h"

#include <algorithm>
#include <map>
#include <utility>

namespace patchlight {

namespace {

constexpr std::size_t most_of_a_kind = 5;
constexpr std::size_t objects_named = 10;

void take_in(Finding& rest, const Finding& finding) {
    for (const std::string& name : finding.objects)
        if (rest.objects.size() < objects_named &&
            std::find(rest.objects.begin(), rest.objects.end(), name) == rest.objects.end())
            rest.objects.push_back(name);
    rest.count += finding.count;
}

}  // namespace

std::vector<Finding> merge_alike(std::vector<Finding> findings) {
    std::map<std::string, std::size_t> of_kind;
    for (const Finding& finding : findings) ++of_kind[finding.kind];
    std::map<std::string, std::size_t> seen, place_of_rest;
    std::vector<Finding> merged;
    for (Finding& finding : findings) {
        const std::string kind = finding.kind;
        if (of_kind[kind] <= most_of_a_kind + 1 || seen[kind]++ < most_of_a_kind) {
            merged.push_back(std::move(finding));
            continue;
        }
        const auto [place, is_new] = place_of_rest.emplace(kind, merged.size());
        if (is_new)
            merged.push_back({kind,
                              {},
                              "the same of " + std::to_string(of_kind[kind] - most_of_a_kind) +
                                  " more, these objects among them",
                              finding.remedy,
                              0});
        take_in(merged[place->second], finding);
    }
    return merged;
}

}  // namespace patchlight
