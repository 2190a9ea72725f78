#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nplc::seqc::test {

/// One case of a .cases file: a line `=== name`, the input, a line `--- expected`, what must come of it.
struct Case {
    std::string name;
    std::string input;
    std::string expected;
};

std::vector<Case> read_cases(const std::filesystem::path& path);
void write_cases(const std::filesystem::path& path, const std::vector<Case>& cases);

std::string text_of_file(const std::filesystem::path& path);

}  // namespace nplc::seqc::test
