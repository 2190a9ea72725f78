#include <algorithm>
#include <chrono>

#include "cli_support.h"

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

const char* const kRaw = "program P step S: own error;end_step end_program";
const char* const kFormatted = "PROGRAM P\nSTEP S: OWN ERROR; END_STEP\nEND_PROGRAM\n";
const char* const kBroken = "PROGRAM P STEP S: OWN ERROR END_STEP END_PROGRAM\n";

class FmtCli : public test::Cli {
  protected:
    /// Makes the file old, so that a rewriting would show.
    fs::file_time_type age(const std::string& name) const {
        const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1000);
        fs::last_write_time(folder_ / name, old);
        return fs::last_write_time(folder_ / name);
    }
};

TEST_F(FmtCli, PrintsTheProgramAndLeavesTheFile) {
    write("a.seq", kRaw);
    EXPECT_EQ(run("fmt a.seq"), 0) << read("err");
    EXPECT_EQ(read("out"), kFormatted);
    EXPECT_EQ(read("err"), "");
    EXPECT_EQ(read("a.seq"), kRaw);
    EXPECT_EQ(run("fmt a.seq -o -"), 0);
    EXPECT_EQ(read("out"), kFormatted);
    EXPECT_FALSE(exists("-"));
}

TEST_F(FmtCli, MinusIsStandardInput) {
    write("a.seq", kRaw);
    EXPECT_EQ(run("fmt - <a.seq"), 0) << read("err");
    EXPECT_EQ(read("out"), kFormatted);
    write("b.seq", kBroken);
    EXPECT_EQ(run("fmt - <b.seq"), 1);
    EXPECT_EQ(read("out"), "");
    EXPECT_NE(read("err").find("<stdin>:1:"), std::string::npos) << read("err");
    EXPECT_EQ(run("fmt --check - <a.seq"), 1);
    EXPECT_EQ(read("out"), "<stdin>\n");
    EXPECT_EQ(run("fmt - -o c.seq <a.seq"), 0);
    EXPECT_EQ(read("c.seq"), kFormatted);
    EXPECT_EQ(run("fmt - <&-"), 2);
    EXPECT_NE(read("err").find("standard input"), std::string::npos) << read("err");
}

TEST_F(FmtCli, WritesToAFile) {
    write("a.seq", kRaw);
    EXPECT_EQ(run("fmt a.seq -o b.seq"), 0) << read("err");
    EXPECT_EQ(read("b.seq"), kFormatted);
    EXPECT_EQ(read("out"), "");
    EXPECT_EQ(run("fmt a.seq --output no/such/b.seq"), 2);
    EXPECT_EQ(run("fmt a.seq -o ./a.seq"), 2);
    EXPECT_NE(read("err").find("--in-place"), std::string::npos) << read("err");
    EXPECT_EQ(read("a.seq"), kRaw);
}

TEST_F(FmtCli, RewritesInPlaceOnlyWhatIsNotFormatted) {
    write("a.seq", kRaw);
    write("b.seq", kFormatted);
    const auto old = age("b.seq");
    EXPECT_EQ(run("fmt -i a.seq b.seq"), 0) << read("err");
    EXPECT_EQ(read("a.seq"), kFormatted);
    EXPECT_EQ(read("b.seq"), kFormatted);
    EXPECT_EQ(fs::last_write_time(folder_ / "b.seq"), old);
    EXPECT_EQ(read("out"), "");
    const auto formatted = age("a.seq");
    EXPECT_EQ(run("fmt --in-place a.seq a.seq"), 0);
    EXPECT_EQ(fs::last_write_time(folder_ / "a.seq"), formatted);
}

TEST_F(FmtCli, AFileWithASyntaxErrorIsLeftAloneAndTheOthersAreDone) {
    write("a.seq", kBroken);
    write("b.seq", kRaw);
    const auto old = age("a.seq");
    EXPECT_EQ(run("fmt -i a.seq b.seq"), 1);
    EXPECT_EQ(read("a.seq"), kBroken);
    EXPECT_EQ(fs::last_write_time(folder_ / "a.seq"), old);
    EXPECT_EQ(read("b.seq"), kFormatted);
    EXPECT_NE(read("err").find("a.seq:1:28: error E010"), std::string::npos) << read("err");
    EXPECT_EQ(run("fmt a.seq -o c.seq"), 1);
    EXPECT_FALSE(exists("c.seq"));
    EXPECT_EQ(run("fmt -i missing.seq a.seq"), 2);
    for (const auto& entry : fs::directory_iterator(folder_)) EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST_F(FmtCli, AProgramWithOtherErrorsIsFormatted) {
    write("a.seq", "program P step S: next := Nowhere; end_step end_program\n");
    EXPECT_EQ(run("check a.seq"), 1);
    EXPECT_EQ(run("fmt a.seq"), 0) << read("err");
    EXPECT_EQ(read("out"), "PROGRAM P\nSTEP S: NEXT := Nowhere; END_STEP\nEND_PROGRAM\n");
    EXPECT_EQ(read("err"), "");
}

TEST_F(FmtCli, CheckListsWhatIsNotFormatted) {
    write("a.seq", kRaw);
    write("b.seq", kFormatted);
    write("c.seq", std::string(kFormatted) + "\n");
    write("d.seq", kBroken);
    EXPECT_EQ(run("fmt --check b.seq"), 0);
    EXPECT_EQ(read("out"), "");
    EXPECT_EQ(run("fmt --check a.seq b.seq c.seq"), 1);
    EXPECT_EQ(read("out"), "a.seq\nc.seq\n");
    EXPECT_EQ(read("a.seq"), kRaw);
    EXPECT_EQ(run("fmt --check b.seq d.seq"), 1);
    EXPECT_EQ(read("out"), "");
    EXPECT_NE(read("err").find("d.seq:1:28"), std::string::npos) << read("err");
    EXPECT_EQ(run("fmt --check a.seq missing.seq"), 2);
    EXPECT_EQ(read("out"), "a.seq\n");
}

TEST_F(FmtCli, WrongUsageIsOneLineAndTwo) {
    write("a.seq", kRaw);
    write("b.seq", kRaw);
    for (const char* arguments : {"fmt", "fmt a.seq b.seq", "fmt -i a.seq --check", "fmt -i a.seq -o c.seq",
                                  "fmt --check a.seq -o c.seq", "fmt -i -", "fmt --check - -",
                                  "fmt missing.seq", "fmt .", "fmt a.seq --wrong"}) {
        EXPECT_EQ(run(std::string(arguments) + " <a.seq"), 2) << arguments;
        const std::string err = read("err");
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << arguments << err;
        EXPECT_TRUE(err.starts_with("seqc: ")) << err;
        EXPECT_EQ(read("out"), "") << arguments;
    }
    EXPECT_EQ(read("a.seq"), kRaw);
    EXPECT_FALSE(exists("c.seq"));
    EXPECT_EQ(run("fmt --help"), 0);
}

TEST_F(FmtCli, InPlaceKeepsPermissionsAndLinks) {
    write("a.seq", kRaw);
    fs::permissions(folder_ / "a.seq", fs::perms(0751));
    fs::create_symlink("a.seq", folder_ / "link.seq");
    EXPECT_EQ(run("fmt -i link.seq"), 0) << read("err");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.seq"));
    EXPECT_EQ(read("a.seq"), kFormatted);
    EXPECT_EQ(fs::status(folder_ / "a.seq").permissions(), fs::perms(0751));
}

TEST_F(FmtCli, WhatItPrintsBuildsTheSameTable) {
    const std::string example = std::string("'") + SEQC_EXAMPLES + "/fill_and_count.seq'";
    EXPECT_EQ(run("build " + example + " -o a.bin"), 0) << read("err");
    EXPECT_EQ(run("fmt " + example + " -o b.seq"), 0) << read("err");
    EXPECT_EQ(run("build b.seq"), 0) << read("err");
    EXPECT_EQ(read("b.bin"), read("a.bin"));
}

}  // namespace
}  // namespace nplc::seqc
