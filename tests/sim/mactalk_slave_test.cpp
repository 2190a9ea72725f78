// The motor as its MacTalk line shows it (001 §5.1, §3.1, §4.4.16).
#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

using registers::Model;
using ByteList = std::vector<std::uint8_t>;

ByteList bytes(const std::string& text) {
    std::istringstream stream(text);
    ByteList result;
    for (unsigned value = 0; stream >> std::hex >> value;) result.push_back(static_cast<std::uint8_t>(value));
    return result;
}

class Bench {
  public:
    explicit Bench(Model model = Model::mac140, std::uint8_t address = 8,
                   Servo::Depth depth = Servo::Depth::current_loop)
        : motor(model, {.address = address, .depth = depth}) {}

    ByteList ask(const ByteList& request) {
        for (const std::uint8_t byte : request) motor.receive_mactalk(byte, false);
        ByteList answer;
        while (const auto byte = motor.transmit_mactalk()) answer.push_back(*byte);
        return answer;
    }
    ByteList ask(const std::string& request) { return ask(bytes(request)); }

    void samples(int count) {
        for (int i = 0; i < count; ++i) motor.sample();
    }

    MacMotor motor;
};

const ByteList kAccept = bytes("11 11 11");
const ByteList kNothing;

// 001 §5.1: parameter 7 holds 4711h, parameter 8 holds 0000h; the unit is 13h.
TEST(MacTalkSlave, AnswersTheManualsRead) {
    Bench bench(Model::mac140, 0x13);
    bench.motor.write(7, 0x4711, false);
    bench.motor.write(8, 0, false);
    EXPECT_EQ(bench.ask("50 50 50 13 EC 07 F8 AA AA"),
              bytes("52 52 52 00 FF 07 F8 04 FB 11 EE 47 B8 00 FF 00 FF AA AA"));
}

TEST(MacTalkSlave, TakesTheManualsWrites) {
    Bench ten(Model::mac140, 0x10);
    EXPECT_EQ(ten.ask("52 52 52 10 EF 08 F7 02 FD 22 DD 33 CC AA AA"), kAccept);
    EXPECT_EQ(ten.motor.read(8) & 0xFFFF, 0x3322);
    Bench bench;
    EXPECT_EQ(bench.ask("52 52 52 08 F7 05 FA 02 FD 58 A7 02 FD AA AA"), kAccept);
    EXPECT_EQ(bench.motor.read(5), 600);
    EXPECT_EQ(bench.ask("50 50 50 08 F7 05 FA AA AA").at(9), 0x58);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 02 FD 02 FD 01 FE 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.motor.mode(), 1);
    Bench seven(Model::mac140, 7);
    EXPECT_EQ(seven.ask("52 52 52 07 F8 03 FC 04 FB 70 8F 82 7D 03 FC 00 FF AA AA"), kAccept);
    EXPECT_EQ(seven.motor.read(3), 230'000);
}

// 002 §5.7.4: ERR_STAT = 0010h means "in position"; P_IST was 245,000.
TEST(MacTalkSlave, AnswersTheQuickGuidesReads) {
    Bench bench;
    bench.motor.write(35, 0x10, false);
    EXPECT_EQ(bench.ask("50 50 50 08 F7 23 DC AA AA"),
              bytes("52 52 52 00 FF 23 DC 04 FB 10 EF 00 FF 03 FC 20 DF AA AA"))
        << "registers 35 and 36: CNTRL_BITS is 3, and 1 of the hall elements (bits 13 to 15)";
    bench.motor.write(10, 245'000, true);
    EXPECT_EQ(bench.ask("50 50 50 08 F7 0A F5 AA AA"),
              bytes("52 52 52 00 FF 0A F5 04 FB 08 F7 BD 42 03 FC 00 FF AA AA"));
}

TEST(MacTalkSlave, Mac800TakesTheManualsLongwords) {
    Bench bench(Model::mac800);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 05 FA 04 FB D3 2C 0A F5 00 FF 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.motor.read(5), 2771);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 05 FA 02 FD 58 A7 02 FD AA AA"), kNothing) << "no words on MAC800";
    EXPECT_EQ(bench.motor.read(5), 2771);
    bench.motor.write(35, 0x10);
    EXPECT_EQ(bench.ask("50 50 50 08 F7 23 DC AA AA"),
              bytes("52 52 52 00 FF 23 DC 04 FB 10 EF 00 FF 00 FF 00 FF AA AA"));
}

// 001 §3.1: a register is 16 bits wide and the upper half of a longword stands in the next number.
TEST(MacTalkSlave, ALongwordOverwritesTheNextRegister) {
    Bench bench;
    EXPECT_EQ(bench.ask("52 52 52 08 F7 05 FA 04 FB E8 17 03 FC 40 BF 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.motor.read(5), 1000);
    EXPECT_EQ(bench.motor.read(6), 64);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 03 FC 04 FB 70 8F 82 7D 03 FC 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 03 FC 02 FD 01 FE 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.motor.read(3), 0x30001) << "a word into a LongInt is its low half";
}

TEST(MacTalkSlave, OnlyItsOwnAddressAndEveryonesAreTaken) {
    Bench bench;
    EXPECT_EQ(bench.ask("50 50 50 07 F8 05 FA AA AA"), kNothing);
    EXPECT_EQ(bench.ask("52 52 52 00 FF 05 FA 02 FD 01 FE 00 FF AA AA"), kNothing);
    EXPECT_EQ(bench.ask("52 52 52 FF 00 05 FA 02 FD 01 FE 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.motor.read(5), 1);
    EXPECT_EQ(bench.ask("50 50 50 FF 00 05 FA AA AA").size(), 19U);
    Bench last(Model::mac140, 254);
    EXPECT_EQ(last.ask("50 50 50 FE 01 05 FA AA AA").size(), 19U);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 9C 63 02 FD 09 F6 00 FF AA AA"), kAccept) << "MYADDR := 9";
    EXPECT_EQ(bench.ask("50 50 50 08 F7 05 FA AA AA"), kNothing);
    EXPECT_EQ(bench.ask("50 50 50 09 F6 05 FA AA AA").size(), 19U);
}

TEST(MacTalkSlave, PipelinedRequestsAreAnsweredInOrder) {
    Bench bench;
    const ByteList answer = bench.ask(
        "52 52 52 08 F7 05 FA 02 FD 58 A7 02 FD AA AA 50 50 50 08 F7 05 FA AA AA 00 FF 13 50 50 50 08 F7 06 "
        "F9 AA AA");
    ASSERT_EQ(answer.size(), 3U + 19 + 19);
    EXPECT_EQ(answer[3 + 9], 0x58);
    EXPECT_EQ(answer[3 + 19 + 5], 0x06);
}

TEST(MacTalkSlave, AFramingErrorDropsItsMessage) {
    Bench bench;
    const ByteList request = bytes("52 52 52 08 F7 05 FA 02 FD 58 A7 02 FD AA AA");
    const std::int32_t before = bench.motor.read(5);
    for (std::size_t at = 0; at < request.size(); ++at) {
        for (std::size_t i = 0; i < request.size(); ++i) bench.motor.receive_mactalk(request[i], i == at);
        EXPECT_FALSE(bench.motor.transmit_mactalk()) << at;
        EXPECT_EQ(bench.motor.read(5), before) << at;
    }
}

TEST(MacTalkSlave, RegistersNobodyKnowsReadNoughtAndAreKept) {
    Bench bench;
    EXPECT_EQ(bench.ask("50 50 50 08 F7 C8 37 AA AA"),
              bytes("52 52 52 00 FF C8 37 04 FB 00 FF 00 FF 00 FF 00 FF AA AA"));
    EXPECT_EQ(bench.ask("50 50 50 08 F7 FF 00 AA AA").size(), 19U);
}

// R: 64 bytes from the register on, 32 words or 16 longwords.
TEST(MacTalkSlave, ABlockIsSixtyFourBytesOfMemory) {
    Bench bench;
    bench.motor.write(49, 0x01020304, true);
    bench.motor.write(65, 0x1122, false);
    const ByteList answer = bench.ask("51 51 51 08 F7 31 CE AA AA");
    ASSERT_EQ(answer.size(), 3U + 6 + 128 + 2);
    EXPECT_EQ(answer[7], 64);
    const std::size_t data = 9;
    EXPECT_EQ(answer[data], 0x04);
    EXPECT_EQ(answer[data + 6], 0x01);
    EXPECT_EQ(answer[data + 2 * 32], 0x22) << "register 65 is 16 words on";
    Bench big(Model::mac800);
    big.motor.write(52, 0x01020304, true);
    const ByteList longwords = big.ask("51 51 51 08 F7 31 CE AA AA");
    EXPECT_EQ(longwords[data + 2 * 12], 0x04) << "register 52 is three longwords on";
    EXPECT_EQ(bench.ask("51 51 51 08 F7 FF 00 AA AA").size(), 3U + 6 + 128 + 2);
}

TEST(SafeMode, IsEnteredFromInitOnlyAndLeftByMacTalkOnly) {
    Bench bench;
    EXPECT_EQ(bench.ask("52 52 52 08 F7 02 FD 02 FD 01 FE 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.ask("54 54 54 08 F7 AA AA"), kNothing) << "velocity mode";
    EXPECT_EQ(bench.motor.mode(), 1);
    EXPECT_EQ(bench.ask("55 55 55 08 F7 AA AA"), kAccept);
    bench.samples(500);
    EXPECT_EQ(bench.motor.mode(), 0) << "through STOP";
    EXPECT_EQ(bench.ask("54 54 54 08 F7 AA AA"), kAccept);
    EXPECT_EQ(bench.motor.mode(), 15);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 02 FD 02 FD 00 FF 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.motor.mode(), 15) << "MODE_REG does not lead out";
    EXPECT_EQ(bench.ask("55 55 55 08 F7 AA AA"), kAccept);
    EXPECT_EQ(bench.motor.mode(), 0);
    EXPECT_EQ(bench.ask("52 52 52 08 F7 02 FD 02 FD 0F F0 00 FF AA AA"), kAccept);
    EXPECT_EQ(bench.motor.mode(), 0) << "nor in";
}

TEST(SafeMode, FlashIsWrittenThereOnlyAndResets) {
    Bench bench;
    bench.motor.write(65, 777, false);
    EXPECT_EQ(bench.ask("56 56 56 08 F7 AA AA"), kNothing);
    bench.motor.power_cycle();
    EXPECT_NE(bench.motor.read(65), 777) << "not saved outside of SAFE";
    bench.motor.write(65, 777, false);
    bench.motor.write(10, 1234, true);
    bench.ask("54 54 54 08 F7 AA AA");
    EXPECT_EQ(bench.ask("56 56 56 08 F7 AA AA"), kNothing) << "no accept (001 §5.1)";
    EXPECT_EQ(bench.motor.mode(), 0) << "it was reset";
    EXPECT_EQ(bench.motor.read(65), 777);
    EXPECT_EQ(bench.motor.read(10), 0) << "positions are not parameters";
    bench.motor.power_cycle();
    EXPECT_EQ(bench.motor.read(65), 777);
}

// 001 §3.2.1: can be changed, but not in flash.
TEST(SafeMode, ProgVersionIsNotWrittenToFlash) {
    Bench bench;
    const std::int32_t version = bench.motor.read(1);
    bench.motor.write(1, 99, false);
    EXPECT_EQ(bench.motor.read(1), 99);
    bench.ask("54 54 54 08 F7 AA AA");
    bench.ask("56 56 56 08 F7 AA AA");
    EXPECT_EQ(bench.motor.read(1), version);
}

TEST(SafeMode, ResetIsTakenInInitAndSafe) {
    Bench bench;
    bench.motor.write(65, 777, false);
    EXPECT_EQ(bench.ask("57 57 57 08 F7 AA AA"), kNothing);
    EXPECT_NE(bench.motor.read(65), 777);
    bench.motor.write(65, 777, false);
    bench.ask("54 54 54 08 F7 AA AA");
    bench.ask("57 57 57 08 F7 AA AA");
    EXPECT_NE(bench.motor.read(65), 777);
    EXPECT_EQ(bench.motor.mode(), 0);
    bench.motor.write(65, 777, false);
    bench.ask("52 52 52 08 F7 02 FD 02 FD 01 FE 00 FF AA AA");
    bench.ask("57 57 57 08 F7 AA AA");
    EXPECT_EQ(bench.motor.mode(), 1) << "not while it runs";
    EXPECT_EQ(bench.motor.read(65), 777);
}

// 001 §4.4.16: 256 defaults to flash and reset, 257 defaults for now, 258 what was saved last.
TEST(SafeMode, ParametersAreLoadedByModeReg) {
    Bench bench;
    const std::int32_t factory = bench.motor.read(65);
    bench.motor.write(65, 777, false);
    bench.ask("54 54 54 08 F7 AA AA");
    bench.ask("56 56 56 08 F7 AA AA");
    const std::string write_mode = "52 52 52 08 F7 02 FD 02 FD ";
    bench.ask(write_mode + "01 FE 01 FE AA AA");  // 257, not in SAFE
    EXPECT_EQ(bench.motor.read(65), 777);
    bench.ask("54 54 54 08 F7 AA AA");
    bench.ask(write_mode + "01 FE 01 FE AA AA");
    EXPECT_EQ(bench.motor.read(65), factory);
    EXPECT_EQ(bench.motor.mode(), 15);
    bench.ask(write_mode + "02 FD 01 FE AA AA");  // 258
    EXPECT_EQ(bench.motor.read(65), 777);
    EXPECT_EQ(bench.motor.mode(), 15);
    bench.ask(write_mode + "00 FF 01 FE AA AA");  // 256
    EXPECT_EQ(bench.motor.mode(), 0) << "it was reset";
    EXPECT_EQ(bench.motor.read(65), factory);
    bench.motor.power_cycle();
    EXPECT_EQ(bench.motor.read(65), factory);
}

// 001 §3.2.36 bits 0 and 1: only after a write to flash and reset.
TEST(SafeMode, TheUserInterfaceChangesWithAResetOnly) {
    Bench bench;
    const auto talks = [&] { return bench.motor.transmit(base::Instant{}).has_value(); };
    EXPECT_TRUE(talks());
    bench.motor.write(36, 0, false);
    EXPECT_TRUE(talks());
    bench.ask("54 54 54 08 F7 AA AA");
    bench.ask("56 56 56 08 F7 AA AA");
    EXPECT_FALSE(talks());
}

constexpr int kRecord = 1 << 6;
constexpr int kRewind = 1 << 7;
constexpr int kRecordInner = 1 << 8;
constexpr int kUserInterface = 3;

/// Without the hall elements.
std::int32_t control_bits(const Bench& bench) {
    return bench.motor.read(36) & 0x1FFF;
}

std::uint32_t word_of(const ByteList& answer, std::size_t i) {
    return static_cast<std::uint32_t>(answer.at(7 + 4 * i) | (answer.at(9 + 4 * i) << 8));
}

TEST(SampleBuffer, RecordsEightHundredNinetyFiveAndStops) {
    Bench bench;
    bench.motor.write(112, 10, false);  // P_IST's low word
    bench.motor.write(113, 12, false);  // V_IST
    bench.motor.write(36, kUserInterface | kRewind | kRecord, false);
    bench.samples(1);
    EXPECT_EQ(control_bits(bench), kUserInterface | kRecord) << "REWIND resets itself";
    EXPECT_EQ(bench.motor.read(116), 1);
    bench.samples(893);
    EXPECT_EQ(bench.motor.read(116), 894);
    EXPECT_EQ(control_bits(bench), kUserInterface | kRecord);
    bench.samples(1);
    EXPECT_EQ(bench.motor.read(116), 895);
    EXPECT_EQ(control_bits(bench), kUserInterface) << "RECORD resets itself";
    bench.samples(10);
    EXPECT_EQ(bench.motor.read(116), 895);
}

TEST(SampleBuffer, IsReadInOrderAfterARewind) {
    Bench bench;
    bench.motor.write(112, 65, false);
    bench.motor.write(113, 66, false);
    bench.motor.write(114, 67, false);
    bench.motor.write(115, 68, false);
    bench.motor.write(36, kUserInterface | kRewind | kRecord, false);
    for (int i = 0; i < 895; ++i) {
        bench.motor.write(65, i, false);
        bench.motor.write(68, -i, false);
        bench.samples(1);
    }
    bench.motor.write(36, kUserInterface | kRewind, false);
    for (std::uint32_t i = 0; i < 895; ++i) {
        const ByteList answer = bench.ask("53 53 53 08 F7 AA AA");
        ASSERT_EQ(answer.size(), 3U + 4 + 16 + 2)
            << "no register block: 52h x3, address, length, 8 bytes, AAh x2";
        ASSERT_EQ(word_of(answer, 0), i);
        ASSERT_EQ(word_of(answer, 3), (0x10000 - i) & 0xFFFF);
        ASSERT_EQ(bench.motor.read(116), static_cast<std::int32_t>(i + 1)) << "REC_CNT counts on";
    }
    EXPECT_EQ(word_of(bench.ask("53 53 53 08 F7 AA AA"), 0), 0U) << "beyond the end";
    bench.motor.write(36, kUserInterface | kRewind, false);
    bench.samples(1);
    EXPECT_EQ(word_of(bench.ask("53 53 53 08 F7 AA AA"), 0), 0U);
    EXPECT_EQ(word_of(bench.ask("53 53 53 08 F7 AA AA"), 0), 1U) << "from the start again";
}

// 001 §1.2: 7812.5 Hz is fifteen times 520.83 Hz; 895 / 15 = 59.67.
TEST(SampleBuffer, RecordsFifteenTimesAsFastInTheInnerLoop) {
    Bench bench;
    bench.motor.write(36, kUserInterface | kRewind | kRecord | kRecordInner, false);
    bench.samples(1);
    EXPECT_EQ(bench.motor.read(116), 15);
    bench.samples(58);
    EXPECT_EQ(bench.motor.read(116), 59 * 15);
    bench.samples(1);
    EXPECT_EQ(bench.motor.read(116), 895);
    EXPECT_EQ(control_bits(bench), kUserInterface | kRecordInner);
}

// 001 §3.2.36: RECORD is reset when the buffer is full, here at the only rate that there is.
TEST(SampleBuffer, RecordsAtTheOuterRateWithoutAnInnerLoop) {
    Bench bench(Model::mac140, 8, Servo::Depth::outer_loop);
    bench.motor.write(36, kUserInterface | kRewind | kRecord | kRecordInner, false);
    bench.samples(894);
    EXPECT_EQ(bench.motor.read(116), 894);
    EXPECT_EQ(control_bits(bench), kUserInterface | kRecord | kRecordInner);
    bench.samples(1);
    EXPECT_EQ(bench.motor.read(116), 895);
    EXPECT_EQ(control_bits(bench), kUserInterface | kRecordInner);
}

TEST(SampleBuffer, Mac800SamplesAreLongwordsAndItsBitsItsOwn) {
    Bench bench(Model::mac800);
    bench.motor.write(158, 49);
    bench.motor.write(49, 0x01020304);
    bench.motor.write(36, 3);  // RECORD, REWIND (004)
    bench.samples(1);
    EXPECT_EQ(bench.motor.read(162), 1);
    EXPECT_EQ(bench.motor.read(36), 1);
    bench.motor.write(36, 2);
    const ByteList answer = bench.ask("53 53 53 08 F7 AA AA");
    ASSERT_EQ(answer.size(), 3U + 4 + 32 + 2);
    EXPECT_EQ(answer[5], 16);
    EXPECT_EQ(answer[7], 0x04);
    EXPECT_EQ(answer[13], 0x01);
}

// Half a million messages, ten million bytes.
TEST(MacTalkSlave, OneDamagedByteNeverWrites) {
    std::mt19937 random(1);
    Bench bench;
    bench.motor.write(3, 0, true);
    const ByteList good = bytes("52 52 52 08 F7 03 FC 04 FB 70 8F 82 7D 03 FC 00 FF AA AA");  // 230,000
    for (int i = 0; i < 500'000; ++i) {
        ByteList line = good;
        line[random() % line.size()] ^= static_cast<std::uint8_t>(1 + random() % 255);
        for (const std::uint8_t byte : line) bench.motor.receive_mactalk(byte, false);
        ASSERT_FALSE(bench.motor.transmit_mactalk()) << "seed 1, round " << i;
        ASSERT_EQ(bench.motor.read(3), 0) << "seed 1, round " << i;
    }
}

}  // namespace
}  // namespace nplc::sim
