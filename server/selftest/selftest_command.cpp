#include "server/selftest/selftest_command.h"

#include "server/interrupt.h"
#include "server/output_files.h"
#include "server/output_stream.h"
#include "server/selftest/known_families.h"
#include "server/selftest/selftest_table.h"
#include "server/wording.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>

namespace patchlight::server {
namespace {

constexpr int done = 0, out_of_bound = 1, interrupted = 130;

std::vector<KnownFamily> chosen_families(const std::vector<std::string>& names) {
    std::vector<std::string> known;
    for (const KnownFamily& family : known_families()) known.emplace_back(family.name);
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw WrongInput("--only: there are no cases " + in_quotes(name) +
                             suggestion(name, known));
    std::vector<KnownFamily> chosen;
    for (const KnownFamily& family : known_families())
        if (names.empty() || std::find(names.begin(), names.end(), family.name) != names.end())
            chosen.push_back(family);
    return chosen;
}

}  // namespace

CLI::App* SelftestCommand::add_to(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "selftest", "Solve scenes of known answer; say how far off this build is, and how quick");
    command
        ->add_option("--only", only_,
                     "cases to run: view-factors, furnaces, cubes, plates, cie-171, penumbra, "
                     "rooms; may repeat")
        ->type_name("NAME")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
    command->add_option("--output", output_, "the table as .csv or .json; standard output keeps it")
        ->type_name("FILE");
    return command;
}

int SelftestCommand::run() const {
    const std::vector<KnownFamily> families = chosen_families(only_);
    if (output_) {
        require_ending("--output", *output_, {".csv", ".json"});
        require_writable("--output", *output_);
    }
    catch_interrupts();
    const auto start = std::chrono::steady_clock::now();
    std::vector<KnownAnswer> answers;
    const auto take = [&](const KnownAnswer& answer) {
        answers.push_back(answer);
        std::cout << selftest_line(answer) << std::flush;
    };
    const Observer observe = [](const Progress&) {
        return is_interrupted() ? Verdict::stop : Verdict::go_on;
    };
    std::cout << build_and_machine() << "\n" << selftest_head();
    try {
        AnswerSheet sheet(take, observe);
        for (const KnownFamily& family : families) family.answer(sheet);
        sheet.finish();
    } catch (const SelftestInterrupted&) {
        std::cerr << "patchlight: interrupted: no verdict\n";
        return interrupted;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << selftest_verdict(answers, seconds.count());
    if (output_)
        write_output(*output_, [&](const TextSink& sink) {
            if (has_ending(*output_, ".json"))
                write_selftest_json(answers, seconds.count(), sink);
            else
                write_selftest_csv(answers, sink);
        });
    return all_within(answers) ? done : out_of_bound;
}

}  // namespace patchlight::server
