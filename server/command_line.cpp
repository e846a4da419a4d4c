#include "server/command_line.h"

#include "server/argument_hint.h"
#include "server/chart/chart_command.h"
#include "server/check_command.h"
#include "server/form_factors_command.h"
#include "server/health_command.h"
#include "server/selftest/selftest_command.h"
#include "server/serve_command.h"
#include "server/solve_command.h"
#include "server/version.h"
#include "server/wrong_input.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <system_error>

namespace patchlight::server {
namespace {

constexpr int failed_here = 1;
constexpr int wrong_input = 2;

/// Each thing that is wrong on a line of its own.
int refuse(const WrongInput& error) {
    std::istringstream lines(error.what());
    for (std::string line; std::getline(lines, line);)
        std::cerr << "patchlight: error: " << line << "\n";
    std::cerr.flush();
    return wrong_input;
}

int fail(int code, const std::string& what) {
    std::cerr << "patchlight: error: " << what << std::endl;
    return code;
}

/// Help and version are asked for by way of an exception too.
int answer(const CLI::App& program, const CLI::ParseError& request, const std::string& hint) {
    if (request.get_exit_code() == 0) return program.exit(request);
    return fail(wrong_input,
                (hint.empty() ? request.what() : hint) + "\nRun with --help to see what there is.");
}

int run(int count, const char* const* arguments) {
    CLI::App program("How is this room lit? Radiosity of diffuse scenes.", "patchlight");
    program.set_version_flag("--version", std::string("patchlight ") + program_version());
    program.require_subcommand(1);
    SolveCommand solve;
    CheckCommand check;
    ChartCommand chart;
    FormFactorsCommand form_factors;
    ServeCommand serve;
    HealthCommand health;
    SelftestCommand selftest;
    CLI::App* const solve_asked = solve.add_to(program);
    CLI::App* const factors_asked = form_factors.add_to(program);
    CLI::App* const check_asked = check.add_to(program);
    CLI::App* const chart_asked = chart.add_to(program);
    CLI::App* const serve_asked = serve.add_to(program);
    CLI::App* const health_asked = health.add_to(program);
    CLI::App* const selftest_asked = selftest.add_to(program);
    if (const std::string slip = option_for_value(program, count, arguments); !slip.empty())
        return fail(wrong_input, slip);
    try {
        program.parse(count, arguments);
    } catch (const CLI::ParseError& request) {
        return answer(program, request, unknown_argument(program, count, arguments));
    }
    if (solve_asked->parsed()) return solve.run();
    if (factors_asked->parsed()) return form_factors.run();
    if (check_asked->parsed()) return check.run();
    if (chart_asked->parsed()) return chart.run();
    if (serve_asked->parsed()) return serve.run();
    if (health_asked->parsed()) return health.run();
    if (selftest_asked->parsed()) return selftest.run();
    throw std::logic_error("a command that does nothing");
}

}  // namespace

int run_command_line(int count, const char* const* arguments) {
    try {
        const int code = run(count, arguments);
        std::cout.flush();
        return std::cout ? code : fail(failed_here, "standard output cannot be written to");
    } catch (const WrongInput& error) {
        return refuse(error);
    } catch (const std::bad_alloc&) {
        return fail(failed_here, "out of memory");
    } catch (const std::exception& error) {
        return fail(failed_here, error.what());
    }
}

}  // namespace patchlight::server
