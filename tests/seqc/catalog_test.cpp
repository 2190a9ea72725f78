#include "codes/catalog.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "support.h"

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

/// Codes that stand as literals in the compiler's sources, the catalog's own left out.
std::set<std::string> codes_in_sources() {
    std::set<std::string> found;
    const std::regex literal("\"([EW][0-9]{3})\"");
    for (const auto& entry : fs::recursive_directory_iterator(SEQC_SOURCES)) {
        if (entry.path().extension() != ".cpp" || entry.path().parent_path().filename() == "codes") continue;
        std::stringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        const std::string source = text.str();
        for (std::sregex_iterator i(source.begin(), source.end(), literal), end; i != end; ++i)
            found.insert((*i)[1]);
    }
    return found;
}

std::string known_to_the_merge(const std::string& code) {
    return code == "E059" ? "" : code;  // the end of a range in compile.cpp, no code
}

TEST(Catalog, HoldsWhatTheSourcesCanSayAndNothingElse) {
    std::set<std::string> in_sources;
    for (const std::string& code : codes_in_sources()) in_sources.insert(known_to_the_merge(code));
    in_sources.erase("");
    std::set<std::string> in_catalog;
    for (const CodeInfo& info : catalog()) in_catalog.insert(std::string(info.code));
    EXPECT_EQ(in_catalog, in_sources);
}

TEST(Catalog, IsInOrderAndWhole) {
    const std::vector<CodeInfo> all = catalog();
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                               [](const CodeInfo& a, const CodeInfo& b) { return a.code < b.code; }));
    for (const CodeInfo& info : all) {
        EXPECT_FALSE(info.title.empty()) << info.code;
        EXPECT_LT(info.title.size(), 70U) << info.code;
        EXPECT_GT(info.explanation.size(), 60U) << info.code;
        std::istringstream lines{std::string(info.explanation)};
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 140U) << line;
    }
}

// E099 means that the compiler's bytes do something else than the program says. If a program were known that
// gives it, the compiler would be mended instead; verify_test.cpp feeds the check wrong bytes by hand.
TEST(Catalog, WrongProgramsGiveTheirCodeAndNoOther) {
    for (const CodeInfo& info : catalog()) {
        if (info.code == "E099") continue;
        const std::string source = whole_program(info.wrong);
        const Compilation result = compile(source);
        EXPECT_EQ(test::codes(result), info.code) << test::shown(result, source);
        EXPECT_EQ(result.ok, info.code[0] == 'W');
    }
}

TEST(Catalog, RightProgramsGiveNothing) {
    for (const CodeInfo& info : catalog()) {
        if (info.code == "E099") continue;
        const std::string source = whole_program(info.right);
        const Compilation result = compile(source);
        EXPECT_TRUE(result.ok) << info.code;
        EXPECT_EQ(test::codes(result), "") << info.code << "\n" << test::shown(result, source);
    }
}

TEST(Catalog, RepeatedLinesAreWrittenOutOrCutShort) {
    const std::string example = "A\n{2..4}B$ to @;\nC\n";
    EXPECT_EQ(whole_program(example), "A\nB2 to 3;\nB3 to 4;\nB4 to 5;\nC\n");
    EXPECT_EQ(shown_program(example), "A\nB2 to 3;\n// ... 3 such lines in all ...\nB4 to 5;\nC\n");
}

}  // namespace
}  // namespace nplc::seqc
