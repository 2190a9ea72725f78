#include "rack.h"

#include <gtest/gtest.h>

#include "protocol/mactalk.h"
#include "sim/midi_stage.h"

namespace nplc::sim {
namespace {

namespace mactalk = protocol::mactalk;
using registers::Model;

constexpr Time kStep = std::chrono::microseconds{250};

Time characters(std::int64_t count, std::int64_t baud = 19'200) {
    return Time{count * 10'000'000'000 / baud};
}

std::vector<std::uint8_t> read_request(std::uint8_t address, std::uint8_t reg) {
    const auto encoded = mactalk::encode({.kind = mactalk::Kind::read, .address = address, .reg = reg});
    return {encoded.view().begin(), encoded.view().end()};
}

/// When the answer was whole.
Time until_answered(Rack& rack, std::size_t bytes) {
    std::size_t got = 0;
    while (got < bytes && rack.now() < std::chrono::seconds{5}) {
        rack.advance(rack.now() + kStep);
        got += rack.received_mactalk().size();
    }
    EXPECT_EQ(got, bytes);
    return rack.now();
}

// 9 characters there and 19 back, 10 bits each.
TEST(Rack, AReadTakesItsTimeOnTheLine) {
    for (const std::uint32_t baud : {9'600U, 19'200U, 38'400U}) {
        Rack rack({.units = {{Model::mac140, 8}}, .mactalk_baud = baud});
        rack.send_mactalk(read_request(8, 10));
        const Time took = until_answered(rack, 19);
        EXPECT_GE(took, characters(28, baud));
        EXPECT_LE(took, characters(28, baud) + 2 * kStep);
    }
}

// 1,920 characters a second.
TEST(Rack, TheFastMacLineIsNeverIdle) {
    Rack rack({});
    rack.advance(std::chrono::seconds{1});
    const auto count = static_cast<int>(rack.received_fastmac().size());
    EXPECT_GE(count, 1918);
    EXPECT_LE(count, 1920);
}

TEST(Rack, MotorsSampleAtTheirOwnRates) {
    Rack rack({.units = {{Model::mac140, 1}, {Model::mac800, 2}}});
    for (std::size_t i = 0; i < 2; ++i) {
        rack.motor(i).write(registers::V_SOLL, 1600);
        rack.motor(i).write(registers::MODE_REG, 1);
    }
    rack.advance(std::chrono::seconds{2});
    // 1600 is 100 counts a sample: 520.83 x 60 / 4096 x 100 = 763 rpm; 770 x 60 / 8000 x 100 = 577.5 rpm.
    EXPECT_NEAR(rack.motor(0).rpm(), 763, 8);
    EXPECT_NEAR(rack.motor(1).rpm(), 577.5, 6);
}

Names alone(Model model, bool beside_fastmac) {
    Names names;
    names.motor = model;
    names.motor_alone = true;
    names.free_pins = !beside_fastmac;
    return names;
}

// 001 §3.2.36, §4.4.3: 52,083 counts a second are 100 a sample of 520.83 Hz; Gear Position mode (3) at 1 / 1
// runs as fast, 763 rpm.
TEST(Rack, WithoutFastMacPulsesDriveAGearMode) {
    const Names names = alone(Model::mac140, false);
    const ParsedScenario parsed =
        parse_scenario("motor pulses 52083 per s\nwhen P_IST > 5 rev motor pulses 0 per s", "x.scn", names);
    ASSERT_TRUE(parsed.mistakes.empty());
    Rack rack({});
    rack.play(parsed.scenario, names);
    EXPECT_EQ(rack.motor(0).read(registers::CNTRL_BITS) & 3, 0);
    rack.motor(0).write(registers::MODE_REG, 3);
    rack.advance(std::chrono::milliseconds{300});
    EXPECT_NEAR(rack.motor(0).read(registers::V_EXT), 100, 1);
    EXPECT_NEAR(rack.motor(0).rpm(), 763, 8);
    rack.advance(std::chrono::seconds{3});
    EXPECT_EQ(rack.motor(0).read(registers::V_EXT), 0);
    EXPECT_EQ(rack.motor(0).v_ist(), 0);
    EXPECT_TRUE(rack.received_fastmac().empty());
}

std::string said(Rack& rack, const std::string& line, const Names& names) {
    ParsedActions parsed = parse_actions(line, names);
    EXPECT_TRUE(parsed.mistake.empty()) << parsed.mistake;
    std::string why = rack.also(std::move(parsed.actions));
    rack.advance(rack.now() + std::chrono::milliseconds{100});
    return why;
}

// What a line of the control port does nothing for. 004: HW_SETUP is 39, NOFILT its bit 5; MODE_REG 2 is
// P_MODE, 3 GP_MODE.
TEST(Rack, PulsesThatTurnNothingAreSaid) {
    const Names names = alone(Model::mac800, true);
    const Scenario nothing;
    Rack rack({.units = {{Model::mac800, 1}}});
    rack.play(nothing, names);
    const auto turned = [&rack] { return rack.motor(0).plant().counts(); };
    EXPECT_EQ(said(rack, "motor pulses 5000 per s", names),
              "the shaft does not follow in INIT, V_EXT counts them; set a gear mode, such as GP_MODE");
    rack.motor(0).write(registers::MODE_REG, 2);
    EXPECT_EQ(
        said(rack, "motor pulses 5000 per s", names),
        "the shaft does not follow in P_MODE, and V_EXT does not count; set a gear mode, such as GP_MODE");
    EXPECT_EQ(turned(), 0);
    rack.motor(0).write(registers::MODE_REG, 3);
    EXPECT_EQ(said(rack, "motor pulses 200000 per s", names),
              "a filter takes more than 124,000 per s; set NOFILT of HW_SETUP");
    EXPECT_EQ(turned(), 0);
    EXPECT_NE(said(rack, "motor steps 5000 per s", names).find("XPRINP of HW_SETUP"), std::string::npos);
    EXPECT_EQ(said(rack, "motor pulses 5000 per s", names), "");
    EXPECT_NEAR(static_cast<double>(turned()), 500, 50) << "0.1 s";
    EXPECT_EQ(said(rack, "motor pulses 0 per s", names), "");
    rack.motor(0).write(registers::GEARF1, 0);
    EXPECT_EQ(said(rack, "motor pulses 5000 per s", names), "GEARF1 is 0: the shaft does not follow");
}

TEST(Rack, PinsThatFastMacHasAreSaid) {
    const Names names = alone(Model::mac140, false);
    const Scenario nothing;
    Rack rack({});
    rack.play(nothing, names);
    rack.motor(0).write(registers::MODE_REG, 3);
    EXPECT_EQ(said(rack, "motor pulses 5000 per s", names).substr(0, 42),
              "FastMAC has the pins of the pulse input (C");
    EXPECT_EQ(rack.motor(0).plant().counts(), 0);
}

TEST(Rack, WhatElseDoesNothingIsSaid) {
    const Names names = alone(Model::mac800, true);
    const Scenario nothing;
    Rack rack({.units = {{Model::mac800, 1}}});
    rack.play(nothing, names);
    EXPECT_EQ(said(rack, "motor power on", names), "it has its supply already");
    EXPECT_EQ(said(rack, "motor stop none", names), "there is no stop");
    EXPECT_EQ(said(rack, "log \"here\"", names), "there is no timeline here");
    EXPECT_EQ(said(rack, "motor brake 300", names), "") << "it is passive";
    rack.motor(0).write(registers::MODE_REG, 2);
    EXPECT_EQ(said(rack, "motor brake 300", names), "the brake is open while the motor is in P_MODE");
    EXPECT_EQ(said(rack, "motor power off", names), "");
    for (const char* line :
         {"motor power off", "motor error", "motor encoder broken", "motor pulses 5000 per s",
          "motor supply 300 V", "motor temperature 40", "motor analogue 5 V"})
        EXPECT_EQ(said(rack, line, names), "it has no supply (motor power off)") << line;
    EXPECT_EQ(said(rack, "motor load 100", names), "") << "it turns the free shaft";
    EXPECT_EQ(said(rack, "motor power on, motor error", names), "");
    EXPECT_EQ(said(rack, "after 1 s motor power on", names), "") << "not now";
}

// 003 §IV: stops and reference act as far as they are enabled, 03h and 07h.
TEST(ModuleAlone, WhatDoesNothingIsSaid) {
    Names names;
    names.drive = registers::find_drive("MAC34-1");
    names.motor_alone = true;
    MidiModule module(MidiModule::Model::mac34_1);
    ModuleAlone stage(module);
    Time now{0};
    const auto told = [&](const std::string& line) {
        ParsedActions parsed = parse_actions(line, names);
        EXPECT_TRUE(parsed.mistake.empty()) << parsed.mistake;
        std::string why = stage.also(std::move(parsed.actions), now);
        stage.observe(now);
        now += std::chrono::milliseconds{1};
        module.advance(now);
        return why;
    };
    EXPECT_EQ(told("motor upper_stop on"), "the stop inputs are not enabled (03h, END_STOPS 1)");
    EXPECT_EQ(told("motor reference on below 0 rev"),
              "the reference input is not enabled (07h, REFERENCE 1)");
    EXPECT_EQ(told("motor upper_stop off"), "");
    ASSERT_TRUE(module.execute(registers::midi::END_STOPS, 0, 1U));
    EXPECT_EQ(told("motor lower_stop on"), "");
    EXPECT_NE(told("cancel motor"), "");
    EXPECT_EQ(told("motor security on for 1 s"), "");
    EXPECT_EQ(told("motor power off"), "");
    EXPECT_EQ(told("motor error"), "it has no supply (motor power off)");
    EXPECT_EQ(told("motor load 100"), "") << "it turns the free shaft";
}

TEST(Rack, BesideFastMacPulsesAreRefusedWithTheReason) {
    const auto mistakes = [](Model model, const std::string& text) {
        return parse_scenario(text, "x.scn", alone(model, true)).mistakes;
    };
    ASSERT_EQ(mistakes(Model::mac140, "motor pulses 1 per s").size(), 1U);
    EXPECT_TRUE(mistakes(Model::mac140, "motor pulses 1 per s")[0].message.starts_with(
        "a MAC140 has FastMAC on the pins of its pulse input"));
    EXPECT_TRUE(mistakes(Model::mac800, "motor pulses 1 per s").empty());
    EXPECT_TRUE(mistakes(Model::mac140, "every 1 s motor load 100, after 100 ms motor load 0").empty());
    for (const std::string line :
         {"IN0 := 1", "line cut", "expect P_IST > 0", "when step = 3 motor error", "end at 1 s",
          "IN2 follows OUT0", "IN2 appears every 2 s", "always TORQUE < 5", "gateway stop"})
        EXPECT_EQ(mistakes(Model::mac140, line).size(), 1U) << line;
}

TEST(Rack, AMotorLosesItsSupplyAndRunsOut) {
    const Names names = alone(Model::mac140, true);
    const ParsedScenario parsed =
        parse_scenario("at 1 s motor power off, after 1 s motor power on", "x.scn", names);
    Rack rack({.units = {{Model::mac140, 1}, {Model::mac95, 2}}});
    rack.play(parsed.scenario, names);
    for (std::size_t i = 0; i < 2; ++i) rack.motor(i).write(registers::MODE_REG, 1);
    rack.advance(std::chrono::milliseconds{1'010});
    EXPECT_GT(rack.motor(0).v_ist(), 50) << "100 counts a sample before";
    rack.advance(std::chrono::milliseconds{1'900});
    EXPECT_EQ(rack.motor(0).v_ist(), 0);
    EXPECT_NEAR(rack.motor(1).v_ist(), 100, 2);
    const auto silent = rack.received_fastmac().size();
    EXPECT_NEAR(static_cast<double>(silent), 1'920, 4) << "a second of them";
    rack.advance(std::chrono::milliseconds{3'000});
    EXPECT_GT(rack.received_fastmac().size(), 1'900U);
    EXPECT_EQ(rack.motor(0).mode(), 0) << "as after power-up";
}

TEST(Rack, EachUnitAnswersForItself) {
    Rack rack({.units = {{Model::mac140, 1}, {Model::mac95, 2}}});
    rack.motor(1).write(registers::V1, 222);
    rack.send_mactalk(read_request(2, registers::V1));
    rack.advance(std::chrono::milliseconds{50});
    const auto answer = rack.received_mactalk();
    ASSERT_EQ(answer.size(), 19U);
    EXPECT_EQ(answer[9], 222);
}

TEST(Rack, AnswersToEveryoneDisturbEachOther) {
    Rack rack({.units = {{Model::mac140, 1}, {Model::mac95, 2}}});
    rack.motor(0).write(registers::V1, 0x0F);
    rack.motor(1).write(registers::V1, 0x3C);
    rack.send_mactalk(read_request(mactalk::kEveryone, registers::V1));
    rack.advance(std::chrono::milliseconds{50});
    const auto answer = rack.received_mactalk();
    ASSERT_EQ(answer.size(), 19U);
    EXPECT_EQ(answer[9], 0x0F & 0x3C);
    EXPECT_EQ(answer[10], (0xFF & ~0x0F) & (0xFF & ~0x3C));
}

TEST(Rack, TheSameCallsGiveTheSameBytes) {
    const auto run = [] {
        Rack rack({.units = {{Model::mac140, 1}, {Model::mac800, 2}}});
        std::vector<std::uint8_t> all;
        for (int i = 0; i < 200; ++i) {
            rack.send_mactalk(read_request(static_cast<std::uint8_t>(1 + i % 3), registers::P_IST));
            rack.advance(rack.now() + std::chrono::microseconds{1 + 997 * i});
            for (const auto& bytes : {rack.received_mactalk(), rack.received_fastmac()})
                all.insert(all.end(), bytes.begin(), bytes.end());
        }
        return all;
    };
    EXPECT_EQ(run(), run());
}

TEST(Rack, AClientThatFloodsLosesBytesAndNothingElse) {
    Rack rack({.units = {{Model::mac140, 8}}, .mactalk_baud = 1'000'000});
    const std::vector<std::uint8_t> noise(200'000, 0x50);
    rack.send_mactalk(noise);
    rack.advance(std::chrono::seconds{2});
    rack.received_mactalk();
    rack.send_mactalk(read_request(8, 10));
    rack.advance(rack.now() + std::chrono::milliseconds{10});
    EXPECT_EQ(rack.received_mactalk().size(), 19U);
}

}  // namespace
}  // namespace nplc::sim
