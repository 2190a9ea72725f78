// Recordings: the CSV, conditions, and the sample buffer of a virtual motor on good and bad lines.
#include "macreg/recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/bytes.h"
#include "macreg/recorder.h"
#include "sampling_unit.h"

namespace nplc::macreg {
namespace {

using registers::Model;

std::string error_of(const std::string& text) {
    return from_csv(text, "a.csv").error;
}

TEST(RecordingCsv, WrittenAndReadBack) {
    Recording recording{.model = "MAC140", .address = 8, .rate_hz = 7812.5, .start = "now"};
    recording.time_s = {0, 0.000128};
    recording.columns = {
        {"P_IST", "counts", {4660, -1}}, {"V_IST", "rpm", {7.63, 0}}, {"MODE_REG", "", {2, 2}}};
    const std::string csv = to_csv(recording);
    EXPECT_EQ(csv,
              "# macreg recording 1\n# model MAC140\n# address 8\n# rate 7812.5 Hz\n# start now\n"
              "time_s,P_IST [counts],V_IST [rpm],MODE_REG\n"
              "0.000000,4660,7.63,2\n0.000128,-1,0,2\n");
    const auto reading = from_csv(csv, "a.csv");
    EXPECT_EQ(reading.error, "");
    EXPECT_EQ(to_csv(reading.recording), csv);
}

TEST(RecordingCsv, AnInterruptedOneIsMarked) {
    Recording recording{.model = "MAC140", .start = "now", .incomplete = "interrupted"};
    recording.time_s = {0};
    recording.columns = {{"V_IST", "rpm", {1}}};
    const auto reading = from_csv(to_csv(recording), "a.csv");
    EXPECT_EQ(reading.recording.incomplete, "interrupted");
}

TEST(RecordingCsv, ErrorsSayWhereAndWhat) {
    EXPECT_EQ(error_of(""),
              "a.csv:1: there is no header; a recording of `macreg record` has one that begins with time_s");
    EXPECT_NE(error_of("time,A\n0,1\n").find("a.csv:1: the header begins with 'time'"), std::string::npos);
    EXPECT_EQ(error_of("time_s,A [rpm\n0,1\n"), "a.csv:1: 'A [rpm': the unit's ] is missing");
    EXPECT_NE(error_of("# x\ntime_s,A\n0,1\n1\n").find("a.csv:4: 1 fields where the header has 2"),
              std::string::npos);
    EXPECT_EQ(error_of("time_s,A\n0,1\n1,x\n"), "a.csv:3: 'x' in column 2 is no number");
    EXPECT_EQ(error_of("time_s,A\n0,nan\n"), "a.csv:2: 'nan' in column 2 is no number");
    EXPECT_EQ(error_of("time_s,A\n1,1\n1,2\n"), "a.csv:3: the time 1 is not after 1 of the row before");
    EXPECT_NE(error_of("time_s,A\n").find("there are no samples"), std::string::npos);
}

TEST(Conditions, AreRead) {
    const auto raw = [](const char* text) {
        const auto reading = read_condition(text, Model::mac140);
        EXPECT_EQ(reading.error, "") << text;
        return reading.condition;
    };
    EXPECT_EQ(raw("V_IST>100").raw, 100);
    // 4096 counts/rev and 520.8333 samples/s: 100 rpm are 13.1072 counts/sample.
    EXPECT_EQ(raw("V_IST >= 100 rpm").raw, 13);
    EXPECT_TRUE(raw("V_IST>100").holds(101));
    EXPECT_FALSE(raw("V_IST>100").holds(100));
    EXPECT_TRUE(raw("V_IST<=-5").holds(-5));
    EXPECT_TRUE(raw("MODE_REG=P_MODE").holds(2));
    EXPECT_TRUE(raw("MODE_REG!=P_MODE").holds(0));
    EXPECT_TRUE(raw("ERR_STAT & IN_POS").holds(0x11));
    EXPECT_FALSE(raw("ERR_STAT & IN_POS").holds(0x0F));
    EXPECT_EQ(condition_words(raw("P_IST<10"), Model::mac140), "P_IST < 10 counts");
}

TEST(Conditions, WhatIsNoneIsRefused) {
    for (const char* text : {"", "V_IST", "V_IST>", ">5", "V_ISR>5", "V_IST>5 V", "V_IST>99999"}) {
        const auto reading = read_condition(text, Model::mac140);
        EXPECT_NE(reading.error, "") << text;
        EXPECT_EQ(reading.error.find('\n'), std::string::npos);
    }
}

struct RecorderTest : testing::Test {
    explicit RecorderTest(Model model = Model::mac140) : unit(model), motor(master, 8, model) {}

    std::vector<const registers::Register*> named(std::initializer_list<const char*> names) {
        std::vector<const registers::Register*> found;
        for (const char* name : names) found.push_back(motor.find(std::string_view(name)));
        return found;
    }
    std::vector<std::int64_t> settings() {
        std::vector<std::int64_t> all;
        for (const char* name : {"SAMPLE1", "SAMPLE2", "SAMPLE3", "SAMPLE4", "CNTRL_BITS"})
            all.push_back(motor.read(name));
        all.back() &= 0x1FFF;  // above it the hall elements' state
        return all;
    }
    /// Position mode at a gentle speed.
    void make_ready() {
        motor.write(*motor.find("V_SOLL"), 500);
        motor.write(*motor.find("A_SOLL"), 50);
        motor.write(*motor.find("MODE_REG"), 2);
    }

    SamplingUnit unit;
    mactalk_client::SimWire wire{unit, 19'200, 1};
    mactalk_client::Master master{wire, {.attempts = 10}};
    Motor motor;
};

TEST_F(RecorderTest, AMoveAtThePositionLoopsRate) {
    make_ready();
    for (int i = 0; i < 4; ++i) motor.write(*motor.find("SAMPLE" + std::to_string(i + 1)), 20 + i);
    const auto before = settings();
    const auto recording = record_buffer(motor, {.registers = named({"P_IST", "V_IST"}), .then = [&] {
                                                     motor.write(*motor.find("P_SOLL"), 70'000);
                                                 }});
    EXPECT_EQ(recording.size(), 895U);
    // 001 §3.2.5: 520.83 Hz, 1/15 of 7812.5 Hz.
    EXPECT_NEAR(recording.rate_hz, 7812.5 / 15, 1e-9);
    EXPECT_NEAR(recording.time_s.back(), 894 * 15 / 7812.5, 1e-9);
    const auto& position = recording.columns[0].values;
    EXPECT_EQ(recording.columns[0].unit, "counts");
    EXPECT_EQ(recording.columns[1].unit, "rpm");
    EXPECT_GT(position.back(), 20'000);
    // 500/16 counts a sample: no two samples are further apart, as they would be if one were left out. The
    // servo may overshoot a little.
    for (std::size_t i = 1; i < position.size(); ++i)
        EXPECT_LT(std::abs(position[i] - position[i - 1]), 60) << i;
    EXPECT_EQ(settings(), before);
}

TEST_F(RecorderTest, FastIsTheCurrentLoopsRate) {
    make_ready();
    const auto recording =
        record_buffer(motor, {.registers = named({"VF_OUT", "V_IST"}), .fast = true, .samples = 100});
    EXPECT_EQ(recording.size(), 100U);
    EXPECT_DOUBLE_EQ(recording.rate_hz, 7812.5);
}

TEST_F(RecorderTest, ALineThatLosesBytesLosesNoSample) {
    make_ready();
    const auto options = RecordOptions{.registers = named({"P_IST", "V_IST"}), .samples = 300, .then = [&] {
                                           motor.write(*motor.find("P_SOLL"), 30'000);
                                           wire.set_faults({.drop = 0.0005, .damage = 0.0005});
                                       }};
    const auto recording = record_buffer(motor, options);
    wire.set_faults({});
    EXPECT_GT(master.counters().timeouts, 3U) << "the line was bad, seed 1";
    ASSERT_EQ(recording.size(), 300U);
    // The same buffer again, over a good line and from its start.
    motor.write(*motor.find("CNTRL_BITS"), motor.read("CNTRL_BITS") | 1 << 7);
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const auto position = static_cast<std::int32_t>(base::load_u32(master.read_sample(8, 8).data()));
        ASSERT_EQ(recording.columns[0].values[i], position) << i;
    }
}

TEST_F(RecorderTest, WaitsForACondition) {
    make_ready();
    int asked = 0;
    RecordOptions options{.registers = named({"V_IST"}), .samples = 50};
    options.when = read_condition("V_IST>10", Model::mac140).condition;
    options.progress = [&](const RecordProgress& progress) {
        if (progress.phase == RecordProgress::Phase::waiting && ++asked == 5)
            unit.motor.write(registers::P_SOLL, 1'000'000, true);
    };
    const auto recording = record_buffer(motor, options);
    EXPECT_GE(asked, 5);
    EXPECT_GT(recording.columns[0].values.front(), 10 / 0.131072 - 8) << "rpm";
    EXPECT_EQ(recording.start, "when V_IST > 76.3 rpm") << "10 / 0.131072";
}

TEST_F(RecorderTest, PutsEverythingBackWhenItIsEnded) {
    make_ready();
    const auto before = settings();
    struct Enough {};
    RecordOptions options{.registers = named({"P_IST", "V_IST"}), .fast = true};
    for (const auto phase : {RecordProgress::Phase::recording, RecordProgress::Phase::reading}) {
        options.progress = [&](const RecordProgress& progress) {
            if (progress.phase == phase) throw Enough{};
        };
        EXPECT_THROW(record_buffer(motor, options), Enough);
        EXPECT_EQ(settings(), before);
    }
    options.progress = [](const RecordProgress&) {};
    options.when = read_condition("V_IST>10", Model::mac140).condition;
    options.within = base::Milliseconds{300};
    EXPECT_THROW(record_buffer(motor, options), CannotRecord);
    EXPECT_EQ(settings(), before);
}

TEST_F(RecorderTest, WhatWasReadIsKeptWhenItBreaksOff) {
    make_ready();
    const auto whole = record_buffer(motor, {.registers = named({"P_IST", "V_IST"}), .samples = 100});
    struct Enough {};
    RecordOptions options{.registers = named({"P_IST", "V_IST"}), .samples = 100};
    options.progress = [](const RecordProgress& progress) {
        if (progress.phase == RecordProgress::Phase::reading && progress.done == 40) throw Enough{};
    };
    Recording broken;
    EXPECT_THROW(record_buffer(motor, options, &broken), Enough);
    ASSERT_EQ(broken.size(), 40U);
    EXPECT_EQ(broken.columns[1].values.size(), 40U);
    EXPECT_EQ(broken.time_s.back(), whole.time_s[39]);
    EXPECT_EQ(broken.model, "MAC50-141") << "which of them is not known by its answers";
}

// 001 §4.4.9: SAMPLE1 = 145, UA_VAL; SAMPLE2 = 139, IC_IST; 7812 Hz; 11 sampling periods; then INIT_MODE.
// UA_VAL = UMEAS.
TEST_F(RecorderTest, FetchesWhatTheVoltageTestLeft) {
    motor.write(*motor.find("UMEAS"), 50);
    motor.write(*motor.find("MODE_REG"), 8);
    while (motor.read("MODE_REG") != 0) {
    }
    const auto before = settings();
    const auto recording = fetch_buffer(motor, {.samples = 0});
    ASSERT_EQ(recording.size(), 11U);
    EXPECT_DOUBLE_EQ(recording.rate_hz, 7812.5);
    EXPECT_EQ(recording.columns[0].name, "UA_VAL");
    EXPECT_EQ(recording.columns[1].name, "IC_IST");
    for (std::size_t i = 1; i < 11; ++i)
        EXPECT_GT(recording.columns[0].values[i], 0) << "the step is there, " << i;
    EXPECT_EQ(settings(), before);
    EXPECT_EQ(to_csv(fetch_buffer(motor, {.samples = 0})), to_csv(recording)) << "it is still there";
}

// 001 §4.4.10: SAMPLE1 = 7, T_SOLL; SAMPLE2 = 12, V_IST; 520.8 Hz; 11 sampling periods; BREAK_MODE,
// INIT_MODE.
TEST_F(RecorderTest, FetchesWhatTheAccelerationTestLeft) {
    motor.write(*motor.find("T_SOLL"), 200);
    motor.write(*motor.find("MODE_REG"), 9);
    while (motor.read("MODE_REG") != 0) {
    }
    const auto recording = fetch_buffer(motor, {.samples = 11});
    ASSERT_EQ(recording.size(), 11U);
    EXPECT_NEAR(recording.rate_hz, 520.83, 0.01);
    ASSERT_EQ(recording.columns.size(), 2U) << "SAMPLE3 and SAMPLE4 are 0";
    EXPECT_EQ(recording.columns[0].name, "T_SOLL");
    EXPECT_EQ(recording.columns[1].name, "V_IST");
    EXPECT_GT(recording.columns[1].values[10], recording.columns[1].values[1]) << "it speeds up";
}

/// P_IST is 10 and 11, so SAMPLE1 and 2 are one value; half of P_SOLL, 3, is a plain word.
TEST_F(RecorderTest, FetchesNumbersThatBelongTogetherAsOneValue) {
    make_ready();
    for (const auto& [name, number] :
         {std::pair{"SAMPLE1", 10}, {"SAMPLE2", 11}, {"SAMPLE3", 3}, {"SAMPLE4", 12}})
        motor.write(*motor.find(name), number);
    motor.write(*motor.find("CNTRL_BITS"), motor.read("CNTRL_BITS") | 1 << 6);
    EXPECT_THROW(fetch_buffer(motor, {.samples = 0}), CannotRecord) << "it is recording";
    while ((motor.read("CNTRL_BITS") & 1 << 6) != 0) {
    }
    const auto recording = fetch_buffer(motor, {.samples = 20});
    ASSERT_EQ(recording.columns.size(), 3U);
    EXPECT_EQ(recording.columns[0].name, "P_IST");
    EXPECT_EQ(recording.columns[1].name, "P_SOLL low word");
    EXPECT_EQ(recording.columns[2].name, "V_IST");
    EXPECT_EQ(recording.size(), 20U);
}

TEST_F(RecorderTest, AnEmptyBufferIsSaid) {
    EXPECT_THROW(fetch_buffer(motor, {.samples = 0}), CannotRecord);
}

TEST_F(RecorderTest, WhatDoesNotFitIsRefusedAndNothingIsSent) {
    const std::size_t sent = wire.sent().size();
    try {
        record_buffer(motor, {.registers = named({"P_IST", "P_SOLL", "V_IST"})});
        FAIL();
    } catch (const CannotRecord& error) {
        EXPECT_STREQ(
            error.what(),
            "a sample has 4 words, and these registers need 5 (P_IST takes 2, P_SOLL takes 2, V_IST takes "
            "1); name fewer, or use --poll");
    }
    EXPECT_THROW(record_buffer(motor, {.registers = named({"V_IST"}), .samples = 896}), CannotRecord);
    EXPECT_THROW(record_buffer(motor, {}), CannotRecord);
    EXPECT_EQ(wire.sent().size(), sent);
}

TEST_F(RecorderTest, PollingTakesAnything) {
    make_ready();
    Recording recording;
    record_polling(motor,
                   {.registers = named({"P_IST", "P_SOLL", "V_IST", "ERR_STAT", "MODE_REG"}), .samples = 20},
                   recording);
    EXPECT_EQ(recording.size(), 20U);
    EXPECT_EQ(recording.columns[4].values.back(), 2) << "P_MODE";
    EXPECT_TRUE(std::is_sorted(recording.time_s.begin(), recording.time_s.end()));
    EXPECT_EQ(from_csv(to_csv(recording), "x").error, "");
}

struct LargeRecorderTest : RecorderTest {
    LargeRecorderTest() : RecorderTest(Model::mac800) {}
};

// 004: every register is a longword, so P_IST takes one.
TEST_F(LargeRecorderTest, FourLongwords) {
    const auto recording =
        record_buffer(motor, {.registers = named({"P_IST", "P_SOLL", "V_IST", "FLWERR"}), .samples = 40});
    EXPECT_EQ(recording.size(), 40U);
    EXPECT_EQ(recording.columns.size(), 4U);
}

}  // namespace
}  // namespace nplc::macreg
