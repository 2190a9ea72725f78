// The numbers of causes, against the causes themselves and the document.
#include "causes/codes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "causes.h"

namespace nplc::macreg {
namespace {

TEST(Codes, EachCauseHasANumber) {
    for (const Case& one : cases()) EXPECT_NE(number_of(one.code), 0) << one.code;
    for (const char* code : {"moves", "unknown", "gateway_link_down", "gateway_safe", "gateway_held",
                             "gateway_stopped", "gateway_runs"})
        EXPECT_NE(number_of(code), 0) << code;
}

TEST(Codes, NumbersRiseAndNamesAreDifferent) {
    std::set<std::string_view> names;
    std::uint16_t last = 0;
    for (const Code& code : codes()) {
        EXPECT_GT(code.number, last);
        last = code.number;
        EXPECT_TRUE(names.insert(code.name).second) << code.name;
        EXPECT_EQ(find_code(code.number)->name, code.name);
    }
}

/// What a PLC was written for stays.
TEST(Codes, TheseStayForGood) {
    EXPECT_EQ(number_of("moves"), 1);
    EXPECT_EQ(number_of("gateway_safe"), 11);
    EXPECT_EQ(number_of("torque_zero"), 39);
    EXPECT_EQ(number_of("error_i2t_err"), 54);
    EXPECT_EQ(number_of("at_target"), 104);
}

TEST(Codes, TheDocumentHasThem) {
    std::ifstream file(CAUSES_FOLDER "/README.md");
    std::stringstream text;
    text << file.rdbuf();
    std::string table = "| code | name | says |\n| --- | --- | --- |\n";
    for (const Code& code : codes())
        table += std::to_string(code.number).insert(0, "| ") + " | " + std::string(code.name) + " | " +
                 std::string(code.text) + " |\n";
    EXPECT_NE(text.str().find(table), std::string::npos) << table;
}

}  // namespace
}  // namespace nplc::macreg
