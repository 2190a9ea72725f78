#include <algorithm>

#include "cli_support.h"

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

using test::Cli;

const char* const kNamedProgram =
    "PROGRAM Blink MOTOR MAC140; VAR_INPUT Go AT IN1; END_VAR VAR_OUTPUT Lamp AT OUT0; END_VAR\n"
    "STEP Off: OWN ERROR; IF Go THEN NEXT := Lit; END_IF END_STEP\n"
    "STEP Lit: OWN ERROR; OUT Lamp; IF NOT Go THEN NEXT := Off; END_IF END_STEP\n"
    "END_PROGRAM\n";
// A term to the first step, one a step, the end: 4 terms of 8 bytes.
const char* const kSummary = "2 steps of 61, 4 terms, 32 bytes";

class CliSymbols : public Cli {
  protected:
    void SetUp() override {
        Cli::SetUp();
        write("a.seq", kNamedProgram);
    }
    bool disassembly_has(const std::string& arguments, const std::string& text) const {
        EXPECT_EQ(run("disasm " + arguments), 0) << read("err");
        return read("out").find(text) != std::string::npos;
    }
};

TEST_F(CliSymbols, BuildSaysWhatItWrote) {
    EXPECT_EQ(run("build a.seq"), 0) << read("err");
    EXPECT_EQ(read("out"), std::string("a.bin: ") + kSummary + "; names in a.sym\n");
    EXPECT_EQ(run("build a.seq --no-symbols -o b.bin"), 0);
    EXPECT_EQ(read("out"), std::string("b.bin: ") + kSummary + "\n");
    EXPECT_FALSE(exists("b.sym"));
    EXPECT_EQ(run("build a.seq --quiet"), 0);
    EXPECT_EQ(read("out"), "");
    write("s.seq", "PROGRAM P STEP S: OWN ERROR; END_STEP END_PROGRAM");
    EXPECT_EQ(run("build s.seq"), 0);
    EXPECT_EQ(read("out"), "s.bin: 1 step of 61, 2 terms, 16 bytes; names in s.sym\n");
    write("t.seq", "PROGRAM T TERM 16#C0, 0, 0, 1, 16#80, 0, 0, 0; END_PROGRAM");
    EXPECT_EQ(run("build t.seq"), 0);
    EXPECT_EQ(read("out"), "t.bin: 2 terms, 16 bytes; names in t.sym\n");
}

TEST_F(CliSymbols, StandBesideTheTableOrWhereOneWants) {
    fs::create_directory(folder_ / "sub");
    EXPECT_EQ(run("build a.seq -o sub/t.hex"), 0) << read("err");
    EXPECT_TRUE(exists("sub/t.sym"));
    EXPECT_EQ(run("build a.seq --symbols names.json -o b.bin"), 0) << read("err");
    EXPECT_EQ(read("names.json"), read("sub/t.sym"));
    EXPECT_FALSE(exists("b.sym"));
    EXPECT_NE(read("out").find("names in names.json"), std::string::npos);
}

TEST_F(CliSymbols, WithErrorsNothingIsWritten) {
    write("a.seq", "PROGRAM P STEP S: OWN ERROR; NEXT := Q; END_STEP END_PROGRAM\n");
    EXPECT_EQ(run("build a.seq"), 1);
    EXPECT_FALSE(exists("a.bin"));
    EXPECT_FALSE(exists("a.sym"));
    EXPECT_EQ(read("out"), "");
}

TEST_F(CliSymbols, AllFilesOrNone) {
    write("a.bin", "before");
    for (const char* where : {"--symbols no/such/a.sym", "--symbols .", "--listing no/such/a.lst"}) {
        EXPECT_EQ(run(std::string("build a.seq ") + where), 2) << where;
        EXPECT_EQ(read("a.bin"), "before");
        EXPECT_FALSE(exists("a.sym"));
        EXPECT_EQ(read("out"), "");
    }
    for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST_F(CliSymbols, NoTwoFilesAreOne) {
    write("p.sym", kNamedProgram);
    for (const char* arguments :
         {"a.seq -o a.sym", "a.seq --symbols a.bin", "a.seq --symbols a.lst --listing ./a.lst",
          "a.seq --symbols a.seq", "p.sym", "a.seq --symbols -", "a.seq --symbols x --no-symbols"}) {
        EXPECT_EQ(run(std::string("build ") + arguments), 2) << arguments;
        const std::string err = read("err");
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
    }
    EXPECT_EQ(read("p.sym"), kNamedProgram);
    EXPECT_EQ(read("a.seq"), kNamedProgram);
    EXPECT_FALSE(exists("a.bin"));
}

TEST_F(CliSymbols, WhatSomebodyElseWroteIsNotReplaced) {
    write("a.sym", "my notes");
    EXPECT_EQ(run("build a.seq"), 2);
    EXPECT_NE(read("err").find("'a.sym' is there and was not written by seqc"), std::string::npos)
        << read("err");
    EXPECT_EQ(read("a.sym"), "my notes");
    EXPECT_FALSE(exists("a.bin"));
    EXPECT_EQ(run("build a.seq --no-symbols"), 0);
    EXPECT_EQ(run("build a.seq --symbols a.sym"), 0) << "named, so meant";
    EXPECT_EQ(run("build a.seq"), 0) << "seqc's own is replaced";
}

TEST_F(CliSymbols, ADeviceHasNothingBesideIt) {
    EXPECT_EQ(run("build a.seq -o /dev/null"), 0) << read("err");
    EXPECT_EQ(read("out"), "");
    EXPECT_FALSE(fs::exists("/dev/null.sym"));
    EXPECT_EQ(shell("'" SEQC_PROGRAM "' build a.seq -o /dev/stdout | cat >b.bin"), 0);
    EXPECT_EQ(read("b.bin").size(), 32U) << "the table and nothing else";
}

TEST_F(CliSymbols, DisasmTakesNamesThatFit) {
    EXPECT_EQ(run("build a.seq"), 0);
    EXPECT_TRUE(disassembly_has("a.bin", "Off: IF Go AND NOT ERROR THEN OUT Lamp; NEXT := Lit"));
    EXPECT_EQ(read("err"), "");
    fs::rename(folder_ / "a.sym", folder_ / "b.sym");
    EXPECT_TRUE(disassembly_has("a.bin", "step 1: IF IN1 AND NOT ERROR THEN OUT OUT0; NEXT := step 2"));
    EXPECT_EQ(read("err"), "");
    EXPECT_TRUE(disassembly_has("a.bin --symbols b.sym", "Off: IF Go"));
    EXPECT_TRUE(disassembly_has("a.seq", "Off: IF Go")) << "a program brings its names";
    EXPECT_EQ(run("disasm a.seq --symbols b.sym"), 2);
}

TEST_F(CliSymbols, BytesAfterTheEndDoNotMatter) {
    EXPECT_EQ(run("build a.seq"), 0);
    write("b.bin", read("a.bin") + "rubbish");
    EXPECT_TRUE(disassembly_has("b.bin --symbols a.sym", "Off: IF Go"));
}

TEST_F(CliSymbols, NamesThatDoNotFitAreLeftOut) {
    EXPECT_EQ(run("build a.seq"), 0);
    const std::string symbols = read("a.sym");
    std::string table = read("a.bin");
    table[8] ^= 0x40;
    write("a.bin", table);
    EXPECT_TRUE(disassembly_has("a.bin", "step 1: IF IN1"));
    EXPECT_TRUE(read("err").starts_with("seqc: a.sym: it belongs to another table (32 bytes, CRC-32 "))
        << read("err");
    EXPECT_TRUE(read("err").ends_with("; names are left out\n")) << read("err");
    EXPECT_EQ(run("disasm a.bin --symbols a.sym"), 2);
    EXPECT_EQ(read("out"), "");
    EXPECT_EQ(run("disasm a.bin --symbols no.sym"), 2);
    write("a.sym", "{");
    EXPECT_TRUE(disassembly_has("a.bin", "step 1: IF IN1"));
    EXPECT_NE(read("err").find("a.sym: this is not JSON"), std::string::npos) << read("err");
    fs::remove(folder_ / "a.sym");
    fs::create_directory(folder_ / "a.sym");
    EXPECT_TRUE(disassembly_has("a.bin", "step 1: IF IN1")) << "a folder is no symbol file";
}

}  // namespace
}  // namespace nplc::seqc
