#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "codes/catalog.h"

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
    std::stringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// What `seqc check` says about a program beside which it stands.
std::string said_about(const fs::path& program) {
    const std::string command =
        "cd '" SEQC_GOLDEN "' && '" SEQC_PROGRAM "' check '" + program.filename().string() + "' 2>&1";
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string text;
    std::array<char, 4096> part{};
    while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
    pclose(pipe);
    return text;
}

std::set<fs::path> golden_programs() {
    std::set<fs::path> found;
    for (const auto& entry : fs::directory_iterator(SEQC_GOLDEN)) {
        if (entry.path().extension() == ".seq") found.insert(entry.path());
    }
    return found;
}

std::string code_of(const fs::path& program) {
    return program.stem().string().substr(0, 4);
}

TEST(Golden, EachProgramIsAnsweredAsWritten) {
    const bool update = std::getenv("SEQC_UPDATE_GOLDEN") != nullptr;
    for (const fs::path& program : golden_programs()) {
        const std::string said = said_about(program);
        const fs::path expected = fs::path(program).replace_extension(".txt");
        if (update) std::ofstream(expected, std::ios::binary) << said;
        EXPECT_EQ(said, content(expected)) << program;
    }
}

TEST(Golden, EachProgramHasTheMistakeItIsNamedAfterAndNoOther) {
    for (const fs::path& program : golden_programs()) {
        std::istringstream lines(content(fs::path(program).replace_extension(".txt")));
        int with_the_code = 0;
        for (std::string line; std::getline(lines, line);) {
            const bool is_error = line.find(": error ") != std::string::npos;
            const bool is_warning = line.find(": warning ") != std::string::npos;
            if (!line.starts_with(program.filename().string() + ":") || !(is_error || is_warning)) continue;
            const bool expected = line.find(" " + code_of(program) + ": ") != std::string::npos;
            with_the_code += expected ? 1 : 0;
            EXPECT_TRUE(expected || is_warning) << line;
        }
        EXPECT_GT(with_the_code, 0) << program;
    }
}

// E099 is the compiler's own fault and no program is known that gives it.
TEST(Golden, EveryCodeHasAProgram) {
    std::set<std::string> with_program;
    for (const fs::path& program : golden_programs()) with_program.insert(code_of(program));
    for (const CodeInfo& info : catalog()) {
        const bool has_program = with_program.contains(std::string(info.code));
        EXPECT_EQ(has_program, info.code != "E099") << info.code;
    }
}

}  // namespace
}  // namespace nplc::seqc
