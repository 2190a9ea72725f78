#include "diagnostics/codes.h"
#include "diagnostics/explanations.h"

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

/// Codes that stand as literals in the compiler's sources, the table's own left out.
std::set<std::string> codes_in_sources() {
    std::set<std::string> found;
    const std::regex literal("\"([EW][0-9]{3})\"");
    for (const auto& entry : fs::recursive_directory_iterator(SEQC_SOURCES)) {
        if (entry.path().extension() != ".cpp" || entry.path().parent_path().filename() == "diagnostics")
            continue;
        std::stringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        const std::string source = text.str();
        for (std::sregex_iterator i(source.begin(), source.end(), literal), end; i != end; ++i)
            found.insert((*i)[1]);
    }
    return found;
}

/// The files that programs of explanations include.
Compilation compile_with_files(const std::string& source) {
    const TextReader reader = {[](const std::string& name) -> SourceText {
                                   if (name == "wiring.seqi")
                                       return {name, "VAR_INPUT Start AT IN0; END_VAR"};
                                   if (name == "itself.seqi") return {name, "INCLUDE 'itself.seqi';"};
                                   return {name, {}, "cannot read '" + name + "'"};
                               },
                               [](const std::string& name) { return name; }};
    return compile(Sources({"p.seq", source}, reader));
}

TEST(Catalog, HoldsWhatTheSourcesCanSayAndNothingElse) {
    std::set<std::string> explained;
    for (const Explanation& info : explanations())
        EXPECT_TRUE(explained.emplace(info.code).second) << info.code;
    std::set<std::string> in_table;
    for (const CodeRow& row : kCodes) in_table.emplace(row.code);
    EXPECT_EQ(explained, in_table);
    std::erase_if(explained, [](const std::string& code) { return code.starts_with("V"); });
    EXPECT_EQ(explained, codes_in_sources());
}

TEST(Catalog, IsInOrderAndWhole) {
    const std::vector<Explanation> all = explanations();
    EXPECT_TRUE(std::is_sorted(kCodes.begin(), kCodes.end(),
                               [](const CodeRow& a, const CodeRow& b) { return a.code < b.code; }));
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                               [](const Explanation& a, const Explanation& b) { return a.code < b.code; }));
    for (const Explanation& info : all) {
        EXPECT_FALSE(info.title.empty()) << info.code;
        EXPECT_LT(info.title.size(), 70U) << info.code;
        EXPECT_GT(info.text.size(), 60U) << info.code;
        std::istringstream lines{std::string(info.text)};
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 140U) << line;
    }
}

// E099 means that the compiler's bytes do something else than the program says. If a program were known that
// gives it, the compiler would be mended instead; verify_test.cpp feeds the check wrong bytes by hand.
TEST(Catalog, WrongProgramsGiveTheirCodeAndNoOther) {
    for (const Explanation& info : explanations()) {
        if (info.code == "E099" || info.code.starts_with("V")) continue;
        const std::string source = whole_program(info.wrong);
        const Compilation result = compile_with_files(source);
        EXPECT_EQ(test::codes(result), info.code) << test::shown(result, source);
        EXPECT_EQ(result.ok, info.code[0] == 'W');
    }
}

TEST(Catalog, RightProgramsGiveNothing) {
    for (const Explanation& info : explanations()) {
        if (info.code == "E099" || info.code.starts_with("V")) continue;
        const std::string source = whole_program(info.right);
        const Compilation result = compile_with_files(source);
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
