#include "server/health_command.h"

#include "server/http/health_probe.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace patchlight::server {

CLI::App* HealthCommand::add_to(CLI::App& program) {
    CLI::App* command = program.add_subcommand("health", "Ask a server whether it is alive");
    command->add_option("--host", host_, "where it listens")
        ->type_name("ADDRESS")
        ->capture_default_str();
    command->add_option("--port", port_, "where it listens")
        ->capture_default_str()
        ->type_name("N")
        ->check(CLI::Range(1, 65535).description(""));
    return command;
}

int HealthCommand::run() const {
    const std::string problem = health_problem(host_, port_);
    if (problem.empty()) return 0;
    std::cerr << "patchlight: not alive: " << problem << "\n";
    return 1;
}

}  // namespace patchlight::server
