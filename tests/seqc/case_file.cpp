#include "case_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace nplc::seqc::test {
namespace {

constexpr std::string_view kCaseLine = "=== ";
constexpr std::string_view kExpectedLine = "--- expected";

}  // namespace

std::string text_of_file(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    EXPECT_FALSE(text.str().empty()) << path;
    return text.str();
}

std::vector<Case> read_cases(const std::filesystem::path& path) {
    std::vector<Case> cases;
    std::string* part = nullptr;
    std::istringstream lines(text_of_file(path));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kCaseLine)) {
            part = &cases.emplace_back(Case{line.substr(kCaseLine.size()), {}, {}}).input;
        } else if (line == kExpectedLine && !cases.empty()) {
            part = &cases.back().expected;
        } else if (part != nullptr) {
            *part += line + "\n";
        } else {
            ADD_FAILURE() << path << " does not begin with a case";
        }
    }
    EXPECT_FALSE(cases.empty()) << path;
    return cases;
}

void write_cases(const std::filesystem::path& path, const std::vector<Case>& cases) {
    std::ofstream file(path, std::ios::binary);
    for (const Case& one : cases)
        file << kCaseLine << one.name << "\n" << one.input << kExpectedLine << "\n" << one.expected;
}

}  // namespace nplc::seqc::test
