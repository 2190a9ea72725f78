#include "cli_support.h"

#include <algorithm>

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

using test::Cli;

const char* const kShortProgram = "PROGRAM P STEP S: OWN ERROR; END_STEP END_PROGRAM\n";

TEST_F(Cli, BuildsAndTakesApart) {
    write("a.seq", kShortProgram);
    EXPECT_EQ(run("build a.seq -o a.bin --listing a.lst"), 0) << read("err");
    EXPECT_EQ(read("a.bin").size(), 16U);
    EXPECT_NE(read("a.lst").find("C0 00 00 01 80 00 00 00"), std::string::npos);
    EXPECT_EQ(run("disasm a.bin -o b.seq"), 0) << read("err");
    EXPECT_EQ(run("build b.seq"), 0) << read("err");
    EXPECT_EQ(read("b.bin"), read("a.bin"));
    EXPECT_EQ(run("disasm a.bin"), 0);
    EXPECT_EQ(read("out"), read("b.seq").replace(read("b.seq").find("PROGRAM a"), 9, "PROGRAM a"));
}

TEST_F(Cli, WritesNothingForAProgramWithErrors) {
    write("a.seq", "PROGRAM P STEP S: OWN ERROR; NEXT := Q; END_STEP END_PROGRAM\n");
    write("a.bin", "before");
    EXPECT_EQ(run("build a.seq -o a.bin --listing a.lst"), 1);
    EXPECT_EQ(read("a.bin"), "before");
    EXPECT_FALSE(exists("a.lst"));
    EXPECT_NE(read("err").find("a.seq:1:38: error E021"), std::string::npos) << read("err");
    EXPECT_EQ(run("check a.seq"), 1);
}

TEST_F(Cli, CheckWritesNothing) {
    write("a.seq", kShortProgram);
    EXPECT_EQ(run("check a.seq"), 0);
    EXPECT_FALSE(exists("a.bin"));
}

TEST_F(Cli, CheckTakesSeveralPrograms) {
    write("a.seq", kShortProgram);
    write("b.seq", "PROGRAM P STEP S: OWN ERROR; NEXT := Q; END_STEP END_PROGRAM\n");
    EXPECT_EQ(run("check a.seq a.seq"), 0);
    EXPECT_EQ(run("check b.seq a.seq"), 1);
    EXPECT_NE(read("err").find("b.seq:1:38: error E021"), std::string::npos) << read("err");
    EXPECT_EQ(run("check b.seq none.seq b.seq"), 2);
    EXPECT_NE(read("err").find("none.seq"), std::string::npos) << read("err");
    EXPECT_EQ(run("check --json a.seq b.seq none.seq"), 2);
    const std::string json = read("out");
    EXPECT_EQ(json.front(), '[');
    for (const char* part : {"\"file\": \"a.seq\"", "\"file\": \"b.seq\"", "\"code\": \"E021\"", "none.seq"})
        EXPECT_NE(json.find(part), std::string::npos) << part << json;
}

TEST_F(Cli, FileAndUsageProblemsAreTwo) {
    write("a.seq", kShortProgram);
    write("short.bin", "\x3F");
    EXPECT_EQ(run("build missing.seq -o a.bin"), 2);
    EXPECT_NE(read("err").find("missing.seq"), std::string::npos);
    EXPECT_EQ(run("build . -o a.bin"), 2);
    EXPECT_EQ(run("build a.seq -o no/such/folder/a.bin"), 2);
    EXPECT_EQ(run("build a.seq -o a.seq"), 2);
    EXPECT_EQ(read("a.seq"), kShortProgram);
    EXPECT_EQ(run("build a.seq -o ./x.bin --listing x.bin"), 2);
    EXPECT_EQ(run("disasm short.bin"), 2);
    EXPECT_EQ(run("disasm missing.bin"), 2);
    EXPECT_EQ(run(""), 2);
    EXPECT_EQ(run("make a.seq"), 2);
    EXPECT_EQ(run("build"), 2);
    EXPECT_EQ(run("--help"), 0);
    EXPECT_NE(read("out").find("Exit codes"), std::string::npos);
}

TEST_F(Cli, UsageErrorsAreOneLine) {
    for (const char* arguments : {"", "make a.seq", "build", "build a.seq --wrong", "build a.seq -o -"}) {
        EXPECT_EQ(run(arguments), 2) << arguments;
        const std::string err = read("err");
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
        EXPECT_TRUE(err.starts_with("seqc: ")) << err;
    }
    EXPECT_EQ(run("--version"), 0);
    EXPECT_TRUE(read("out").starts_with("seqc ")) << read("out");
}

TEST_F(Cli, MinusIsStandardOutputForDisasmOnly) {
    write("a.seq", kShortProgram);
    EXPECT_EQ(run("build a.seq -o -"), 2);
    EXPECT_FALSE(exists("-"));
    EXPECT_EQ(run("build a.seq"), 0);
    EXPECT_EQ(run("disasm a.bin -o -"), 0);
    EXPECT_NE(read("out").find("TERM"), std::string::npos);
    EXPECT_FALSE(exists("-"));
}

TEST_F(Cli, DecompilesAndCompilesToTheSame) {
    write("a.seq", kShortProgram);
    EXPECT_EQ(run("build a.seq --no-symbols"), 0) << read("err");
    EXPECT_EQ(run("decompile a.bin -o b.seq"), 0) << read("err");
    EXPECT_TRUE(read("b.seq").starts_with("// Decompiled from a.bin: 1 terms")) << read("b.seq");
    EXPECT_EQ(run("build b.seq"), 0) << read("err");
    EXPECT_EQ(read("b.bin"), read("a.bin"));
    EXPECT_EQ(run("decompile a.bin --motor mac800"), 0);
    EXPECT_NE(read("out").find("STEP S1:"), std::string::npos) << read("out");
    EXPECT_EQ(run("decompile a.seq"), 0);
    EXPECT_NE(read("out").find("STEP S:"), std::string::npos) << "a program's own names";
}

TEST_F(Cli, AStepWithTheNumberNoughtCounts) {
    write("a.seq",
          "PROGRAM P STEP S AT 0: OWN ERROR; IF IN0 THEN NEXT := T; END_IF END_STEP STEP T: OWN ERROR; "
          "END_STEP END_PROGRAM\n");
    EXPECT_EQ(run("build a.seq"), 0) << read("err");
    EXPECT_TRUE(read("out").starts_with("a.bin: 2 steps of 62, ")) << read("out");
}

TEST_F(Cli, DecompileRefusesWhatItCannotDo) {
    write("a.seq", kShortProgram);
    EXPECT_EQ(run("build a.seq"), 0);
    const std::string table = read("a.bin");
    write("short.bin", "\x3F");
    for (const char* arguments :
         {"decompile missing.bin", "decompile short.bin", "decompile a.bin --motor MAC1",
          "decompile a.bin -o ./a.bin", "decompile", "decompile a.bin -o no/such/b.seq"}) {
        EXPECT_EQ(run(arguments), 2) << arguments;
        const std::string err = read("err");
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
        EXPECT_EQ(read("out"), "") << arguments;
    }
    EXPECT_EQ(read("a.bin"), table);
}

TEST_F(Cli, ALinksTargetIsWritten) {
    write("a.seq", kShortProgram);
    fs::create_directory(folder_ / "sub");
    fs::create_symlink("sub/real.bin", folder_ / "link.bin");  // leads nowhere yet
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(run("build a.seq -o link.bin"), 0) << read("err");
        EXPECT_TRUE(fs::is_symlink(folder_ / "link.bin"));
        EXPECT_EQ(fs::file_size(folder_ / "sub/real.bin"), 16U);
    }
}

TEST_F(Cli, ManyMistakesEndWithALine) {
    std::string source = "PROGRAM P\n";
    for (int i = 0; i < 500; ++i) source += "STEP S: IF Q THEN NEXT := Z; END_IF END_STEP\n";
    write("a.seq", source + "END_PROGRAM");
    EXPECT_EQ(run("check a.seq"), 1);
    EXPECT_NE(read("err").find("there are more; only 100 are shown"), std::string::npos);
}

TEST_F(Cli, LeavesNoTemporaryFiles) {
    write("a.seq", kShortProgram);
    run("build a.seq -o a.bin");
    run("build a.seq -o no/such/a.bin");
    for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST_F(Cli, ADeviceIsWrittenToNotReplaced) {
    write("a.seq", kShortProgram);
    EXPECT_EQ(run("build a.seq -o /dev/null"), 0);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace nplc::seqc
