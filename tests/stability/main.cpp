#include "solver/solve_scene.h"
#include "tests/stability/judgement.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace {

const std::string document_path = PATCHLIGHT_STABILITY_DOCUMENT;

std::string read_document() {
    std::ifstream file(document_path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// After a whole run: what was found is what the document says, and no mode is left out.
class TheTablesOfTheDocument : public testing::Environment {
  public:
    void TearDown() override {
        using namespace patchlight::stability;
        if (testing::GTEST_FLAG(filter) != "*") return;
        for (const std::string& mode : modes_not_judged())
            ADD_FAILURE() << mode << " is judged by no test";
        const std::string document = read_document();
        for (const auto& [name, found] : found_tables()) {
            // Which rows there are follows from the verdicts.
            const Rows rows = name == "degrades" ? Rows::may_differ : Rows::must_be_the_same;
            for (const std::string& told :
                 disagreements(table_in(document, name), found.table, found.keys, rows))
                ADD_FAILURE() << "README.md, table " << name << ": " << told
                              << "\nIf that is right, run this program with --write";
        }
    }
};

/// Puts the tables that were found into the document.
void write_document() {
    std::string document = read_document();
    for (const auto& [name, found] : patchlight::stability::found_tables())
        document = with_table(document, name, found.table);
    std::ofstream(document_path, std::ios::binary) << document;
    std::cout << "written to " << document_path << "\n";
}

}  // namespace

/// Runs the suite and holds what it finds against README.md beside this file; with --write, puts
/// it there.
int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const bool write = argc > 1 && std::string(argv[1]) == "--write";
    if (!write) testing::AddGlobalTestEnvironment(new TheTablesOfTheDocument);
    const int failed = RUN_ALL_TESTS();
    if (write && failed == 0) write_document();
    return failed;
}
