#include "case_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace nplc::seqc::test {
namespace {

constexpr std::string_view kCaseLine = "=== ";
constexpr std::string_view kExpectedLine = "--- expected";
constexpr std::string_view kFileLine = "--- file ";

/// Lines `--- 3 times text` written out.
std::string repeated(const std::string& text) {
    static const std::regex kTimes("--- (\\d+) times (.*)");
    std::string result;
    std::istringstream lines(text);
    std::smatch found;
    for (std::string line; std::getline(lines, line);) {
        const bool several = std::regex_match(line, found, kTimes);
        for (int left = several ? std::stoi(found[1]) : 1; left > 0; --left)
            result += (several ? found[2].str() : line) + "\n";
    }
    return result;
}

/// The files that it includes stay as they are written.
std::string changed(const std::string& base, const std::string& changes, const std::string& name) {
    std::istringstream program(base);
    std::istringstream lines(changes);
    std::string result;
    std::string files;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kFileLine) || !files.empty()) {
            files += line + "\n";
        } else if (line.starts_with("+")) {
            result += line.substr(1) + "\n";
        } else if (line.starts_with("-") || line.starts_with(" ")) {
            std::string other;
            while (std::getline(program, other) && other != line.substr(1)) result += other + "\n";
            EXPECT_TRUE(program) << name << ": not in the program that it changes, or not here: " << line;
            if (line.starts_with(" ")) result += other + "\n";
        } else {
            ADD_FAILURE() << name << ": neither +, - nor a space: " << line;
        }
    }
    for (std::string line; std::getline(program, line);) result += line + "\n";
    return result + files;
}

Case case_of(const std::string& written, const std::filesystem::path& folder) {
    constexpr std::string_view kIn = " in ";
    const std::string title = written.substr(0, written.find('\n'));
    const std::string input = repeated(written.substr(title.size() + 1));
    const std::size_t in = title.find(kIn);
    if (in == std::string::npos) return {title, input, {}, written};
    const std::string name = title.substr(0, in);
    const std::string base = text_of_file(folder / (title.substr(in + kIn.size()) + ".seq"));
    return {name, changed(base, input, name), {}, written};
}

}  // namespace

std::string text_of_file(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    EXPECT_FALSE(text.str().empty()) << path;
    return text.str();
}

std::vector<Case> read_cases(const std::filesystem::path& path) {
    std::vector<Case> cases;
    std::string written;
    bool in_input = false;
    std::istringstream lines(text_of_file(path));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(kCaseLine)) {
            EXPECT_FALSE(in_input) << path << ": nothing is expected of " << written;
            written = line.substr(kCaseLine.size()) + "\n";
            in_input = true;
        } else if (line == kExpectedLine && in_input) {
            cases.push_back(case_of(written, path.parent_path()));
            in_input = false;
        } else if (in_input) {
            written += line + "\n";
        } else if (!cases.empty()) {
            cases.back().expected += line + "\n";
        } else {
            ADD_FAILURE() << path << " does not begin with a case";
        }
    }
    EXPECT_FALSE(in_input) << path << ": nothing is expected of " << written;
    EXPECT_FALSE(cases.empty()) << path;
    return cases;
}

void write_cases(const std::filesystem::path& path, const std::vector<Case>& cases) {
    std::ofstream file(path, std::ios::binary);
    for (const Case& one : cases)
        file << kCaseLine << one.as_written << kExpectedLine << "\n" << one.expected;
}

}  // namespace nplc::seqc::test
