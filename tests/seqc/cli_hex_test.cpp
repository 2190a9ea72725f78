// seqc and GNU objcopy exchange tables.
#include "cli_support.h"

namespace nplc::seqc {
namespace {

namespace fs = std::filesystem;

using test::Cli;

const char* const kGood = "PROGRAM P STEP S: OWN ERROR; END_STEP END_PROGRAM\n";

/// objcopy ends its lines with CR LF.
std::string without_returns(std::string text) {
    std::erase(text, '\r');
    return text;
}

class CliHex : public Cli {
  protected:
    void SetUp() override {
        Cli::SetUp();
        const auto example = fs::path(SEQC_EXAMPLES) / "pick_and_place.seq";
        ASSERT_EQ(run("build '" + example.string() + "' -o a.bin --quiet"), 0) << read("err");
        ASSERT_EQ(run("build '" + example.string() + "' -o a.hex --quiet"), 0) << read("err");
    }
};

TEST_F(CliHex, ObjcopyTakesIt) {
    ASSERT_EQ(shell("objcopy -I ihex -O binary a.hex b.bin"), 0);
    EXPECT_EQ(read("b.bin"), read("a.bin"));
}

TEST_F(CliHex, ObjcopyWritesTheSame) {
    ASSERT_EQ(shell("objcopy -I binary -O ihex a.bin b.hex"), 0);
    EXPECT_EQ(without_returns(read("b.hex")), read("a.hex"));
    ASSERT_EQ(run("disasm a.bin --symbols a.sym -o a.txt"), 0) << read("err");
    ASSERT_EQ(run("disasm b.hex --symbols a.sym -o b.txt"), 0) << read("err");
    EXPECT_EQ(read("b.txt").replace(read("b.txt").find("PROGRAM b"), 9, "PROGRAM a"), read("a.txt"));
}

TEST_F(CliHex, ObjcopysFlashAddresses) {
    // Below 1 MiB objcopy writes segment addresses, above it linear ones; a table across a border takes two.
    for (const char* base : {"0xFFF8", "0xF0000", "0x08010000"}) {
        SCOPED_TRACE(base);
        ASSERT_EQ(shell(std::string("objcopy -I binary -O ihex --change-addresses ") + base + " a.bin b.hex"),
                  0);
        ASSERT_EQ(run("disasm b.hex"), 0) << read("err");
        ASSERT_EQ(
            run("build '" SEQC_EXAMPLES "/pick_and_place.seq' -o c.ihx --base-address " + std::string(base)),
            0)
            << read("err");
        ASSERT_EQ(shell("objcopy -I ihex -O binary c.ihx c.bin"), 0);
        EXPECT_EQ(read("c.bin"), read("a.bin"));
    }
    EXPECT_NE(read("out").find("c.ihx: 6 steps of 61, "), std::string::npos) << read("out");
    EXPECT_NE(read("out").find(" bytes at 8010000h; names in c.sym\n"), std::string::npos) << read("out");
}

TEST_F(CliHex, TheFormatOverridesTheName) {
    write("p.seq", kGood);
    ASSERT_EQ(run("build p.seq --format hex"), 0) << read("err");
    // C0 00 00 01 80 to step 1, then the end; 10 + C0 + 01 + 80 + 3F = 190 -> 70
    EXPECT_EQ(read("p.hex"), ":10000000C0000001800000003F0000000000000070\n:00000001FF\n");
    ASSERT_EQ(run("build p.seq -o q.dat --format hex"), 0);
    EXPECT_EQ(read("q.dat"), read("p.hex"));
    ASSERT_EQ(run("disasm q.dat"), 0) << read("err");
    ASSERT_EQ(run("build p.seq -o q.HEX"), 0);
    EXPECT_EQ(read("q.HEX"), read("p.hex"));
    ASSERT_EQ(run("build p.seq -o r.hex --format bin"), 0);
    EXPECT_EQ(read("r.hex").size(), 16U);
    EXPECT_EQ(run("disasm r.hex"), 2) << "a .hex must be Intel HEX";
}

TEST_F(CliHex, WrongFormatsAndAddresses) {
    write("p.seq", kGood);
    const std::pair<const char*, const char*> wrong[] = {
        {"--format elf", "write bin or hex"},
        {"--base-address 0x100", "a raw table has no address"},
        {"-o p.hex --base-address x", "write a number"},
        {"-o p.hex --base-address 0x100000000", "write a number"},
        {"-o p.hex --base-address -1", "write a number"},
        {"-o p.hex --base-address 0xFFFFFFF1", "beyond 4 GiB"},  // 16 bytes from there: one too many
    };
    for (const auto& [options, says] : wrong) {
        EXPECT_EQ(run(std::string("build p.seq ") + options), 2) << options;
        EXPECT_NE(read("err").find(says), std::string::npos) << read("err");
        EXPECT_FALSE(exists("p.hex"));
        EXPECT_FALSE(exists("p.bin"));
        EXPECT_FALSE(exists("p.sym"));
    }
    EXPECT_EQ(run("build p.seq -o p.hex --base-address 0xFFFFFFF0"), 0) << read("err");
}

TEST_F(CliHex, MistakesAreToldWithFileAndLine) {
    const std::string good = read("a.hex");
    std::string bad = good;
    bad[bad.find('\n') - 1] ^= 1;  // the last digit of the first checksum
    write("b.hex", bad);
    EXPECT_EQ(run("disasm b.hex"), 2);
    EXPECT_TRUE(read("err").starts_with("seqc: b.hex:1: the checksum is ")) << read("err");
    write("b.hex", good.substr(0, good.size() - 12));
    EXPECT_EQ(run("disasm b.hex"), 2);
    EXPECT_NE(read("err").find("the end record (:00000001FF) is missing"), std::string::npos) << read("err");
    write("b.hex", ":01000000AA55\n:00000001FF\n");
    EXPECT_EQ(run("disasm b.hex"), 2);
    EXPECT_NE(read("err").find("b.hex: 1 bytes hold 0 whole terms"), std::string::npos) << read("err");
    EXPECT_EQ(read("out"), "");
}

}  // namespace
}  // namespace nplc::seqc
