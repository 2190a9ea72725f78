#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_support.h"

namespace nplc::seqc {
namespace {

using JsonOutput = test::Cli;
using Json = nlohmann::json;

TEST_F(JsonOutput, ADiagnosticWithItsPlaceAndNotes) {
    // The comment's two umlauts are one character each: s is character 6, S 6 too.
    write("a.seq",
          "PROGRAM P (* \xC3\xA4\xC3\xB6 *)\nSTEP S: OWN ERROR; END_STEP\nSTEP s: OWN ERROR; "
          "END_STEP\nEND_PROGRAM\n");
    EXPECT_EQ(run("check --json a.seq"), 1);
    EXPECT_EQ(read("err"), "");
    const Json document = Json::parse(read("out"));
    EXPECT_EQ(document["file"], "a.seq");
    EXPECT_EQ(document["ok"], false);
    EXPECT_EQ(document["errors"], 1);
    EXPECT_EQ(document["warnings"], 0);
    EXPECT_EQ(document["more"], false);
    EXPECT_EQ(document["diagnostics"],
              Json::parse(R"([{"severity": "error", "code": "E020", "message": "step 's' stands twice",
                               "help": "give one of them another name", "file": "a.seq",
                               "line": 3, "column": 6, "end_line": 3, "end_column": 7,
                               "notes": [{"message": "the first one is here", "file": "a.seq",
                                          "line": 2, "column": 6, "end_line": 2, "end_column": 7}]}])"));
}

TEST_F(JsonOutput, AGoodProgramHasNoneAndIsBuilt) {
    write("a.seq", "PROGRAM P MOTOR MAC140; STEP S: OWN ERROR; END_STEP END_PROGRAM\n");
    EXPECT_EQ(run("build --json a.seq"), 0);
    const Json document = Json::parse(read("out"));
    EXPECT_EQ(document["ok"], true);
    EXPECT_EQ(document["diagnostics"], Json::array());
    EXPECT_TRUE(exists("a.bin"));
    EXPECT_EQ(read("err"), "");
}

TEST_F(JsonOutput, AWarningIsNoError) {
    write("a.seq",
          "PROGRAM P MOTOR MAC140; STEP S: OWN ERROR; END_STEP STEP T: OWN ERROR; END_STEP END_PROGRAM\n");
    EXPECT_EQ(run("check --json a.seq"), 0);
    const Json document = Json::parse(read("out"));
    EXPECT_EQ(document["ok"], true);
    EXPECT_EQ(document["warnings"], 1);
    EXPECT_EQ(document["diagnostics"][0]["severity"], "warning");
}

TEST_F(JsonOutput, AFileThatCannotBeReadOrWritten) {
    EXPECT_EQ(run("check --json missing.seq"), 2);
    EXPECT_EQ(Json::parse(read("out"))["ok"], false);
    EXPECT_NE(Json::parse(read("out"))["error"].get<std::string>().find("missing.seq"), std::string::npos);
    EXPECT_EQ(read("err"), "");
    write("a.seq", "PROGRAM P STEP S: OWN ERROR; END_STEP END_PROGRAM\n");
    for (const char* target : {"no/such/a.bin", "a.seq", "-"}) {
        EXPECT_EQ(run(std::string("build --json a.seq -o ") + target), 2) << target;
        EXPECT_FALSE(Json::parse(read("out"))["error"].get<std::string>().empty());
        EXPECT_EQ(read("err"), "");
    }
}

// A value is shown as it was written, with what stands inside of it.
TEST_F(JsonOutput, BytesThatAreNoUtf8AreReplaced) {
    write("a.seq",
          "PROGRAM P MOTOR MAC140; VAR_MOTOR a AT A1 := - (* \xFF\xC3 *) 5; END_VAR STEP S: OWN ERROR; "
          "END_STEP END_PROGRAM");
    EXPECT_EQ(run("check --json a.seq"), 1);
    const Json document = Json::parse(read("out"));
    EXPECT_EQ(document["diagnostics"][0]["code"], "E042");
    EXPECT_NE(document["diagnostics"][0]["message"].get<std::string>().find("\xEF\xBF\xBD"),
              std::string::npos);
}

TEST_F(JsonOutput, SaysWhenThereAreMore) {
    std::string source = "PROGRAM P\n";
    for (int i = 0; i < 500; ++i) source += "STEP S: IF Q THEN NEXT := Z; END_IF END_STEP\n";
    write("a.seq", source + "END_PROGRAM");
    EXPECT_EQ(run("check --json a.seq"), 1);
    EXPECT_EQ(Json::parse(read("out"))["more"], true);
    EXPECT_EQ(Json::parse(read("out"))["errors"], 100);
}

}  // namespace
}  // namespace nplc::seqc
