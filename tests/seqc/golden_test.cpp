#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "case_file.h"
#include "cli_support.h"
#include "diagnostics/explanations.h"

namespace fs = std::filesystem;

namespace nplc::seqc {
namespace {

using Golden = test::Cli;

std::map<fs::path, std::vector<test::Case>> golden_files() {
    std::map<fs::path, std::vector<test::Case>> files;
    for (const auto& entry : fs::directory_iterator(SEQC_GOLDEN))
        if (entry.path().extension() == ".cases") files[entry.path()] = test::read_cases(entry.path());
    return files;
}

std::vector<test::Case> golden_cases() {
    std::vector<test::Case> all;
    for (const auto& [path, cases] : golden_files()) all.insert(all.end(), cases.begin(), cases.end());
    return all;
}

std::string code_of(const test::Case& one) {
    return one.name.substr(0, 4);
}

/// The program, and behind lines `--- file NAME` the files that it includes.
std::map<std::string, std::string> files_of(const test::Case& one) {
    constexpr std::string_view kFileLine = "--- file ";
    std::map<std::string, std::string> files;
    std::string* text = &files[one.name + ".seq"];
    std::istringstream lines(one.input);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kFileLine)) {
            text = &files[line.substr(kFileLine.size())];
        } else {
            *text += line + "\n";
        }
    }
    return files;
}

bool is_course(const test::Case& one) {
    return one.name.starts_with("V");
}

TEST_F(Golden, EachProgramIsAnsweredAsWritten) {
    const bool update = std::getenv("SEQC_UPDATE_GOLDEN") != nullptr;
    for (auto& [path, cases] : golden_files()) {
        std::vector<test::Case> answered = cases;
        for (test::Case& one : answered) {
            for (const auto& [name, text] : files_of(one)) write(name, text);
            shell("'" SEQC_PROGRAM "' " + std::string(is_course(one) ? "verify" : "check") + " '" + one.name +
                  ".seq' >out 2>&1");
            const std::string expected = std::exchange(one.expected, read("out"));
            EXPECT_EQ(one.expected, expected) << one.name << " in " << path;
        }
        if (update) test::write_cases(path, answered);
    }
}

TEST_F(Golden, EachProgramHasTheMistakeItIsNamedAfterAndNoOther) {
    for (const test::Case& one : golden_cases()) {
        std::istringstream lines(one.expected);
        int with_the_code = 0;
        for (std::string line; std::getline(lines, line);) {
            const bool is_error = line.find(is_course(one) ? ": fault " : ": error ") != std::string::npos;
            const bool is_warning =
                line.find(is_course(one) ? ": advice " : ": warning ") != std::string::npos;
            const std::string file = line.substr(0, line.find(':'));
            if (!files_of(one).contains(file) || !(is_error || is_warning)) continue;
            const bool expected = line.find(" " + code_of(one) + ": ") != std::string::npos;
            with_the_code += expected ? 1 : 0;
            EXPECT_TRUE(expected || is_warning) << line;
        }
        EXPECT_GT(with_the_code, 0) << one.name;
    }
}

// E099 is the compiler's own fault and no program is known that gives it.
TEST_F(Golden, EveryCodeHasAProgramAndEveryProgramItsOwnName) {
    std::set<std::string> names;
    std::set<std::string> with_program;
    for (const test::Case& one : golden_cases()) {
        EXPECT_TRUE(names.insert(one.name).second) << one.name;
        with_program.insert(code_of(one));
    }
    for (const Explanation& info : explanations()) {
        const bool has_program = with_program.contains(std::string(info.code));
        EXPECT_EQ(has_program, info.code != "E099") << info.code;
    }
}

}  // namespace
}  // namespace nplc::seqc
