// report, graph and diff as a user runs them.
#include <algorithm>

#include "cli_support.h"

namespace nplc::seqc {
namespace {

class ViewsCli : public test::Cli {
  protected:
    void SetUp() override {
        Cli::SetUp();
        write("a.seq", text("1000"));
        write("b.seq", text("2000"));
        write("bad.seq", "PROGRAM P STEP S: END_STEP\n");
        write("short.bin", "\x3F");
        write("refused.bin", std::string("\xC0\0\0\x3F\x80\0\0\0\x3F\0\0\0\0\0\0\0", 16));  // NEXT_STATE 3Fh
    }
    static std::string text(const std::string& speed) {
        return "PROGRAM P MOTOR MAC140; VAR_MOTOR Fast AT V1 := " + speed +
               "; END_VAR POWER_UP INIT(Fast); NEXT := S; END_POWER_UP STEP S: OWN ERROR; END_STEP "
               "END_PROGRAM\n";
    }
    bool failed_in_one_line(const std::string& arguments, const std::string& says) {
        const int code = run(arguments);
        const std::string err = read("err");
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
        EXPECT_NE(err.find(says), std::string::npos) << err;
        EXPECT_EQ(read("out"), "");
        return code == 2;
    }
};

TEST_F(ViewsCli, Report) {
    EXPECT_EQ(run("report a.seq"), 0) << read("err");
    EXPECT_NE(read("out").find("program P, MAC140"), std::string::npos);
    EXPECT_EQ(run("report a.seq --json --rapid --baud 115200 -o r.json"), 0) << read("err");
    EXPECT_EQ(read("out"), "");
    EXPECT_NE(read("r.json").find("\"baud\": 115200"), std::string::npos);
    EXPECT_TRUE(failed_in_one_line("report refused.bin", "refused.bin: term 0: NEXT_STATE is 3Fh"));
    EXPECT_TRUE(failed_in_one_line("report short.bin", "short.bin"));
    EXPECT_TRUE(failed_in_one_line("report a.seq --baud 0", "--baud"));
    EXPECT_TRUE(failed_in_one_line("report a.seq -o a.seq", "name another output"));
    EXPECT_EQ(read("a.seq"), text("1000"));
    EXPECT_EQ(run("report bad.seq"), 1);
}

TEST_F(ViewsCli, Diff) {
    EXPECT_EQ(run("diff a.seq a.seq"), 0);
    EXPECT_EQ(read("out"), "the same bytes\n");
    EXPECT_EQ(run("diff a.seq b.seq"), 1);
    EXPECT_TRUE(read("out").starts_with("Fast: 1000 -> 2000 ("));
    EXPECT_EQ(run("build a.seq"), 0);
    EXPECT_EQ(run("diff a.bin a.seq"), 0);
    EXPECT_EQ(run("diff a.seq b.seq --json"), 1);
    EXPECT_TRUE(read("out").starts_with("{"));
    EXPECT_EQ(run("diff a.seq bad.seq"), 2);  // 1 would mean "different"
    EXPECT_EQ(run("diff bad.seq a.seq"), 2);
    EXPECT_TRUE(failed_in_one_line("diff a.seq missing.bin", "missing.bin"));
    EXPECT_TRUE(failed_in_one_line("diff a.seq", "B"));
}

TEST_F(ViewsCli, GraphGoesByTheOutputsName) {
    EXPECT_EQ(run("graph a.seq -o a.dot"), 0) << read("err");
    EXPECT_TRUE(read("a.dot").starts_with("digraph \"P\""));
    EXPECT_EQ(run("graph a.seq --format dot"), 0);
    EXPECT_EQ(read("out"), read("a.dot"));
    EXPECT_EQ(run("graph a.seq"), 0) << read("err");
    EXPECT_NE(read("out").find("<svg"), std::string::npos);
    EXPECT_EQ(run("graph a.seq -o a.png"), 0) << read("err");
    EXPECT_TRUE(read("a.png").starts_with("\x89PNG"));
    EXPECT_EQ(run("graph a.seq -o a.pdf"), 0) << read("err");
    EXPECT_TRUE(read("a.pdf").starts_with("%PDF"));
    EXPECT_EQ(run("graph a.seq -o a.json"), 0) << read("err");
    EXPECT_TRUE(read("a.json").starts_with(R"({"format":"nanoplc-graph","version":1,)")) << read("a.json");
    EXPECT_EQ(run("graph a.seq --format svg -o odd.name"), 0) << read("err");
    EXPECT_NE(read("odd.name").find("<svg"), std::string::npos);
    EXPECT_TRUE(failed_in_one_line("graph a.seq -o odd.txt", "--format"));
    EXPECT_TRUE(failed_in_one_line("graph a.seq --format gif", "--format"));
    EXPECT_TRUE(failed_in_one_line("graph refused.bin", "no gateway takes"));
    EXPECT_EQ(run("graph bad.seq -o bad.svg"), 1);
    EXPECT_FALSE(exists("bad.svg"));
}

TEST_F(ViewsCli, GraphIsTheSameEachTime) {
    EXPECT_EQ(run("graph a.seq -o 1.svg"), 0);
    EXPECT_EQ(run("graph a.seq -o 2.svg"), 0);
    EXPECT_EQ(read("1.svg"), read("2.svg"));
}

TEST_F(ViewsCli, WithoutGraphvizItSaysWhatToDo) {
    const std::string seqc = "cd '" + folder_.string() + "' && PATH=/nowhere '" SEQC_PROGRAM "' graph a.seq ";
    EXPECT_EQ(WEXITSTATUS(std::system((seqc + "-o a.png 2>err").c_str())), 2);
    EXPECT_NE(read("err").find("apt-get install graphviz"), std::string::npos) << read("err");
    EXPECT_NE(read("err").find("--format svg"), std::string::npos) << read("err");
    EXPECT_FALSE(exists("a.png"));
    for (const char* const needs_none : {"-o a.svg", "-o a.json", "-o a.dot"})
        EXPECT_EQ(WEXITSTATUS(std::system((seqc + needs_none + " 2>err").c_str())), 0) << read("err");
}

// A dot that fails, and one that is killed.
TEST_F(ViewsCli, AGraphvizThatFailsIsReported) {
    write("dot", "#!/bin/sh\necho 'no such luck' >&2\nexit 3\n");
    std::filesystem::permissions(folder_ / "dot", std::filesystem::perms::owner_all);
    const std::string seqc =
        "cd '" + folder_.string() + "' && PATH=.:$PATH '" SEQC_PROGRAM "' graph a.seq -o a.png 2>err";
    EXPECT_EQ(WEXITSTATUS(std::system(seqc.c_str())), 2);
    EXPECT_NE(read("err").find("'dot' failed: no such luck"), std::string::npos) << read("err");
    write("dot", "#!/bin/sh\nkill -9 $$\n");
    EXPECT_EQ(WEXITSTATUS(std::system(seqc.c_str())), 2);
    EXPECT_FALSE(exists("a.png"));
}

}  // namespace
}  // namespace nplc::seqc
