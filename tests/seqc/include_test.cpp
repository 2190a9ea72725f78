#include <gtest/gtest.h>
#include <sys/stat.h>

#include "cli_support.h"
#include "seqc/seqc.h"
#include "support.h"

namespace nplc::seqc {
namespace {

constexpr const char* kWiring =
    "VAR_INPUT Start AT IN0 : BOOL; END_VAR\n"
    "VAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR\n";
constexpr const char* kSteps =
    "STEP Work: OUT Lamp; IF NOT Start THEN NEXT := Idle; END_IF END_STEP\n"
    "STEP Fault: OWN ERROR; IF ANY ERROR AND Start THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP\n";

std::string including(const std::string& files) {
    return "PROGRAM P\nMOTOR MAC140;\nON ERROR NEXT := Fault;\n" + files +
           "\nSTEP Idle: IF Start THEN NEXT := Work; END_IF END_STEP\nEND_PROGRAM\n";
}

class Include : public test::Cli {
  protected:
    /// That of `seqc check p.seq`, one line of it at the most an error.
    std::string error_of(const std::string& program) const {
        write("p.seq", program);
        EXPECT_EQ(run("check p.seq"), 1);
        const std::string said = read("err");
        EXPECT_NE(said.find("p.seq: 1 error, 0 warnings"), std::string::npos) << said;
        return said.substr(0, said.find('\n'));
    }
};

TEST_F(Include, IsAsIfItWereWrittenThere) {
    write("wiring.seqi", kWiring);
    write("steps.seqi", kSteps);
    write("p.seq", including("INCLUDE 'wiring.seqi';\nINCLUDE 'steps.seqi';"));
    write("q.seq", including(std::string(kWiring) + kSteps));
    ASSERT_EQ(run("build p.seq"), 0) << read("err");
    ASSERT_EQ(run("build q.seq"), 0) << read("err");
    EXPECT_EQ(read("p.bin"), read("q.bin"));
    EXPECT_EQ(run("diff p.seq q.seq"), 0);
}

TEST_F(Include, PropertiesOfBothFilesAreProved) {
    write("all.seqi", "PROPERTY Lit: NEVER STEP = Work AND NOT Lamp;\n" + std::string(kWiring) + kSteps);
    write("p.seq", including("INCLUDE 'all.seqi';\nPROPERTY Dark: NEVER Lamp AND STEP = Idle;"));
    EXPECT_EQ(run("verify p.seq"), 0) << read("err");
    EXPECT_NE(read("out").find("proved    Lit: NEVER STEP = Work AND NOT Lamp"), std::string::npos)
        << read("out");
    EXPECT_NE(read("out").find("proved    Dark: NEVER Lamp AND STEP = Idle"), std::string::npos)
        << read("out");
}

TEST_F(Include, CountsOnceByWhateverNameAndWay) {
    fs::create_directory(folder_ / "plant");
    write("wiring.seqi", kWiring);
    write("plant/steps.seqi", std::string("INCLUDE '../wiring.seqi';\n") + kSteps);
    fs::create_symlink("wiring.seqi", folder_ / "other.seqi");
    write("p.seq", including("INCLUDE 'plant/steps.seqi'; INCLUDE 'wiring.seqi';\n"
                             "INCLUDE './plant/../wiring.seqi'; INCLUDE 'other.seqi';"));
    EXPECT_EQ(run("check p.seq"), 0) << read("err");
}

TEST_F(Include, NamesCountFromTheFileThatHasThemNotFromWhereSeqcRuns) {
    fs::create_directories(folder_ / "line/press");
    write("line/wiring.seqi", kWiring);
    write("line/press/steps.seqi", std::string("INCLUDE '../wiring.seqi';\n") + kSteps);
    write("line/p.seq", including("INCLUDE 'press/steps.seqi';"));
    EXPECT_EQ(run("check line/p.seq"), 0) << read("err");
    EXPECT_EQ(run("check '" + (folder_ / "line/p.seq").string() + "'"), 0) << read("err");
}

TEST_F(Include, ListingAndSymbolsNameTheFileOfALine) {
    write("wiring.seqi", kWiring);
    write("steps.seqi", kSteps);
    write("p.seq", including("INCLUDE 'wiring.seqi';\nINCLUDE 'steps.seqi';"));
    ASSERT_EQ(run("build p.seq --listing p.lst"), 0);
    const std::string listed = read("p.lst");
    EXPECT_NE(listed.find("includes wiring.seqi\nincludes steps.seqi\n"), std::string::npos) << listed;
    EXPECT_NE(listed.find(" steps.seqi:1  "), std::string::npos) << listed;  // Work's own branch
    EXPECT_NE(read("p.sym").find("\"name\":\"Work\",\"line\":1,\"outputs\":1,\"file\":\"steps.seqi\""),
              std::string::npos)
        << read("p.sym");
}

TEST_F(Include, NothingIsWrittenOverAnIncludedFile) {
    write("wiring.seqi", std::string(kWiring) + kSteps);
    write("p.seq", including("INCLUDE 'wiring.seqi';"));
    for (const char* option : {"-o wiring.seqi", "--listing ./wiring.seqi", "--symbols wiring.seqi"}) {
        EXPECT_EQ(run(std::string("build p.seq ") + option), 2);
        EXPECT_NE(read("err").find("wiring.seqi' is a file that the program includes"), std::string::npos)
            << read("err");
        EXPECT_EQ(read("wiring.seqi"), std::string(kWiring) + kSteps);
    }
}

TEST_F(Include, WhatIsNoTextGetsOneMessage) {
    write("binary.seqi", std::string("a\0b", 3));
    write("control.seqi", "VAR_INPUT\x01\x02\x03\xFF");
    write("huge.seqi", std::string(5U << 20U, ' '));
    fs::create_symlink("turn_2", folder_ / "turn_1");
    fs::create_symlink("turn_1", folder_ / "turn_2");
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    const std::pair<const char*, const char*> cases[] = {
        {"binary.seqi", "it is no text, for it holds zeros"},
        {"control.seqi", "it is not a text: it contains control characters"},
        {"huge.seqi", "it has more than"},
        {"turn_1", "Too many levels of symbolic links"},
        {"pipe", "it is a pipe"},
        {"/dev/zero", "it has more than"},
    };
    for (const auto& [name, why] : cases) {
        const std::string said = error_of(including(std::string("INCLUDE '") + name + "';\n" + kSteps));
        EXPECT_TRUE(said.starts_with("p.seq:4:9: error E024: ")) << said;
        EXPECT_NE(said.find(why), std::string::npos) << said;
    }
}

TEST_F(Include, AChainOfFilesEndsSomewhere) {
    for (int i = 1; i <= 30; ++i)
        write("f" + std::to_string(i) + ".seqi", "INCLUDE 'f" + std::to_string(i + 1) + ".seqi';\n");
    // the program and f1 to f19 are twenty deep
    EXPECT_TRUE(error_of(including("INCLUDE 'f1.seqi';")).starts_with("f19.seqi:1:9: error E025: "));
    write("f20.seqi", "");
    write("f19.seqi", kWiring + std::string(kSteps));
    EXPECT_EQ(run("check p.seq"), 0) << read("err");
}

TEST_F(Include, AFileIsLaidOutByItself) {
    write("wiring.seqi", "var_input start at in0:bool;end_var include 'a.seqi';const a:=3;\n");
    EXPECT_EQ(run("fmt wiring.seqi"), 0) << read("err");
    EXPECT_EQ(read("out"), "VAR_INPUT start AT IN0 : BOOL; END_VAR\nINCLUDE 'a.seqi';\nCONST a := 3;\n");
}

TEST_F(Include, AProgramWithoutItsFirstLineIsNoSuchFile) {
    write("p.seq", "MOTOR MAC140;\nSTEP S: OWN ERROR; END_STEP\nEND_PROGRAM\n");
    EXPECT_EQ(run("fmt p.seq"), 1);
    EXPECT_TRUE(read("err").starts_with("p.seq:1:1: error E010: expected PROGRAM at the start"))
        << read("err");
}

TEST_F(Include, PropertiesOfAFileAreProvedAndTheirMistakesAreAtTheirLines) {
    write("wiring.seqi", kWiring + std::string("PROPERTY Dark: NEVER Lamp AND STEP = Idle;\n"));
    write("steps.seqi", kSteps);
    write("p.seq", including("INCLUDE 'wiring.seqi'; INCLUDE 'steps.seqi';"));
    EXPECT_EQ(run("verify p.seq"), 0) << read("err");
    EXPECT_NE(read("out").find("Dark"), std::string::npos) << read("out");
    write("wiring.seqi", kWiring + std::string("PROPERTY Dark: NEVER Lmp AND STEP = Idle;\n"));
    EXPECT_EQ(run("verify p.seq"), 2);
    EXPECT_NE(read("err").find("wiring.seqi:3:22: error E021"), std::string::npos) << read("err");
}

TEST(Sources, AFileCanStandFirstAndTheProgramMeansTheSame) {
    const TextReader reader = {[](const std::string& name) {
                                   return SourceText{name, name == "w.seqi" ? kWiring : kSteps};
                               },
                               [](const std::string& name) { return name; }};
    const std::string program = including("INCLUDE 'w.seqi'; INCLUDE 's.seqi';");
    const Sources as_usual({"p.seq", program}, reader);
    const Sources steps_first({"s.seqi", kSteps}, {"p.seq", program}, reader);
    EXPECT_TRUE(steps_first.has_first());
    EXPECT_EQ(compile(steps_first).table, compile(as_usual).table);
    EXPECT_EQ(steps_first.file_at(0).name, "s.seqi");
    EXPECT_FALSE(Sources({"x.seqi", ""}, {"p.seq", program}, reader).has_first());
}

TEST(Sources, APlaceIsInTheFileWhoseTextItIs) {
    const TextReader reader = {[](const std::string& name) {
                                   return SourceText{name, "a\nb"};
                               },
                               [](const std::string& name) { return name; }};
    const Sources sources({"p.seq", "INCLUDE 'x';\n"}, reader);
    const Places places(sources);
    EXPECT_EQ(places.line_text(0), "1");
    EXPECT_EQ(places.line_text(13), "2");  // the end of the program's text
    EXPECT_EQ(places.line_text(14), "x:1");
    EXPECT_EQ(places.line_text(16), "x:2");
}

}  // namespace
}  // namespace nplc::seqc
