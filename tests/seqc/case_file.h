#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nplc::seqc::test {

/// One case of a .cases file: a line `=== name`, the input, a line `--- expected`, what must come of it.
/// `=== name in base`: the input is base.seq of the same folder, changed as the lines below it say, in its
/// order:
/// `-` takes a line out, ` ` names one that stays, `+` adds one behind the last that was named (at first: on
/// top).
/// `--- 3 times text` stands for three lines.
struct Case {
    std::string name;
    std::string input;
    std::string expected;
    std::string as_written;  // what stands between `=== ` and `--- expected`
};

std::vector<Case> read_cases(const std::filesystem::path& path);
void write_cases(const std::filesystem::path& path, const std::vector<Case>& cases);

std::string text_of_file(const std::filesystem::path& path);

}  // namespace nplc::seqc::test
