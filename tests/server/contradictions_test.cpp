#include "server/run_job.h"
#include "server/scene_file.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::server::contradictions_test {
namespace {

using Document = nlohmann::ordered_json;

/// What the parts of one result say of each other. Particles may differ from what is displayed by
/// the estimate and 4 of their standard errors: 3 in 100 000 by chance, and seeds are fixed.
void expect_no_contradiction(const Document& result, double target) {
    const Document& error = result.at("error");
    ASSERT_TRUE(error.contains("estimate"));
    const double estimate = error.at("estimate");
    if (!result.contains("energy")) {
        EXPECT_EQ(estimate, 1.0) << "the work ended before there was light";
        EXPECT_EQ(result.at("status"), "limit");
        return;
    }
    const double energy = result.at("energy").at("defect"),
                 bound = error.value("algebraic_bound", 0.0);
    const double law =
        bound + std::hypot(error.value("form_factors", 0.0), error.value("mesh", 0.0));
    EXPECT_GE(estimate, law * (1.0 - 1e-9));
    EXPECT_EQ(error.at("met").get<bool>(), result.at("status") == "converged");
    if (error.at("met").get<bool>()) {
        EXPECT_LE(estimate, target);
        EXPECT_LE(energy - 2.0 * result.at("energy").value("standard_error", 0.0), target);
    }
    if (!error.contains("transport_check")) {
        EXPECT_EQ(estimate, 1.0) << "no light was found";
        return;
    }
    const Document& check = error.at("transport_check");
    const double difference = check.at("difference"), noise = check.at("standard_error");
    EXPECT_LE(check.at("proven").get<double>(), estimate);
    EXPECT_LE(difference, estimate + 4.0 * noise);
    EXPECT_GE(check.at("particles").get<std::uint64_t>(), 4096u);
}

void expect_none_in(Job job, double target) {
    job.settings.accuracy = target;
    const JobResult result = run_job(job, {}, 0.0, {});
    expect_no_contradiction(result.document, target);
    // What the report says of energy, its terms say.
    const EnergyReport& energy = result.solution.energy;
    const double worst = (energy.missing().abs() / energy.emitted.max(1e-300)).maxCoeff();
    EXPECT_NEAR(energy.defect, worst, 1e-9 + 1e-6 * worst);
}

const char* const examples[] = {"cornell_box.json", "CornellBox-Original.obj",
                                "grey_room.json",   "courtyard.json",
                                "alcove.obj",       "lantern.gltf"};

TEST(Contradictions, AreNoneInExamples) {
    for (const char* const name : examples)
        for (const Method method : {Method::gauss_seidel, Method::shooting}) {
            SCOPED_TRACE(std::string(name) + (method == Method::shooting ? " shooting" : ""));
            Job job = read_scene_file(PATCHLIGHT_EXAMPLES "/" + std::string(name));
            job.settings.method = method;
            expect_none_in(job, 0.05);
        }
}

/// A coarse solution that stopped early is an error, too.
TEST(Contradictions, AreNoneWhereTheCoarseSolutionStopsEarly) {
    for (const double tolerance : {0.9, 0.1})
        for (const Method method : {Method::gauss_seidel, Method::shooting}) {
            SCOPED_TRACE(tolerance);
            Job job = read_scene_file(PATCHLIGHT_EXAMPLES "/grey_room.json");
            job.settings.method = method;
            job.settings.tolerance = tolerance;
            expect_none_in(job, 0.03);
        }
}

/// Where a limit ends the work, what is reported is of what is displayed. A slow machine may have
/// nothing to display by then.
TEST(Contradictions, AreNoneWhereALimitEndsTheWork) {
    Job job = read_scene_file(PATCHLIGHT_EXAMPLES "/cornell_box.json");
    job.settings.accuracy = 1e-4;
    for (const double seconds : {0.001, 0.05, 0.5, 2.0}) {
        SCOPED_TRACE(seconds);
        job.settings.time_limit = seconds;
        const JobResult result = run_job(job, {}, 0.0, {});
        expect_no_contradiction(result.document, 1e-4);
    }
}

}  // namespace
}  // namespace patchlight::server::contradictions_test
