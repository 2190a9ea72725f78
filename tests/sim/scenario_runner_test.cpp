#include "sim/scenario_runner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;

/// A machine without any behaviour: the test sets its values.
class Bench final : public Stage {
  public:
    explicit Bench(const std::string& text, const Names& names = {})
        : names_(names),
          parsed_(parse_scenario(text, "x.scn", names_)),
          runner_(parsed_.scenario, names_, *this) {
        for (const Mistake& mistake : parsed_.mistakes)
            ADD_FAILURE() << mistake.line << ": " << mistake.message;
    }

    /// Goes on to `time`, from 0 at first, stopping at what the scenario planned.
    void run_to(Time time) {
        if (!std::exchange(begun_, true)) run_to(Time(0));
        while (true) {
            const auto due = runner_.next_due();
            const Time next = due && *due < time ? *due : time;
            s.time = next;
            while (runner_.observe(s)) s.orders.clear();
            s.orders.clear();
            if (next == time) return;
        }
    }

    void set_outputs(Time at, std::uint8_t levels) {
        run_to(at);
        s.outputs = levels;
        run_to(at);
    }

    bool passes() {
        runner_.finish(s);
        return runner_.failures() == 0;
    }
    std::string seen() const { return runner_.outcomes().front().seen; }
    bool ended() const { return runner_.ended(); }

    void set_input(unsigned index, bool level) override {
        s.inputs = static_cast<std::uint8_t>(level ? s.inputs | 1U << index : s.inputs & ~(1U << index));
        did("IN" + std::to_string(index) + "=" + std::to_string(static_cast<int>(level)));
    }
    void toggle_input(unsigned index) override { set_input(index, (s.inputs >> index & 1) == 0); }
    void cut_line(bool cut) override { did(cut ? "cut" : "restored"); }
    void spoil_line(const action::SpoilLine& faults) override {
        did("drop " + std::to_string(static_cast<int>(100 * faults.drop.value_or(-1))));
    }
    void seed(std::uint64_t value) override { did("seed " + std::to_string(value)); }
    void fail_motor() override { did("error"); }
    void power_motor(bool on) override { did(on ? "on" : "off"); }
    void act(const action::OnMotor& what) override {
        std::visit([this](const auto& one) { did(text_of(one)); }, what);
    }
    void set_points(const action::SetPoints& asked) override { did(asked.text); }
    void gateway(action::Gateway what) override { did("gateway " + std::to_string(static_cast<int>(what))); }
    void log(const std::string& text) override { did(text); }

    static std::string text_of(const action::LoadMotor& a) { return "load " + std::to_string(a.torque); }
    static std::string text_of(const action::MotorBrake& a) { return "brake " + std::to_string(a.torque); }
    static std::string text_of(const action::StopMotor& a) {
        return (a.above ? "stop above " : "stop below ") + std::to_string(a.counts) + " spring " +
               std::to_string(std::lround(1000 * a.torque_per_count));
    }
    static std::string text_of(const action::FreeMotor&) { return "free"; }
    static std::string text_of(const action::MotorSensor& a) {
        return (a.on_above ? "sensor above " : "sensor below ") + std::to_string(a.counts);
    }
    static std::string text_of(const action::SetDriveInput& a) {
        return "drive input " + std::to_string(static_cast<int>(a.input)) + (a.active ? " on" : " off");
    }
    static std::string text_of(const action::DriveSwitch& a) {
        return "switch " + std::to_string(static_cast<int>(a.input)) + (a.on_above ? " above " : " below ") +
               std::to_string(a.counts);
    }
    static std::string text_of(const action::MotorAnalogue& a) {
        return "analogue " + std::to_string(std::lround(10 * a.volts));
    }
    static std::string text_of(const action::MotorPulses& a) {
        return (a.with_direction ? "steps " : "pulses ") + std::to_string(a.per_second);
    }
    static std::string text_of(const action::MotorSupply& a) {
        return (a.logic ? "logic " : "supply ") + std::to_string(std::lround(10 * a.volts));
    }
    static std::string text_of(const action::MotorTemperature& a) {
        return "temperature " + std::to_string(a.celsius);
    }
    static std::string text_of(const action::BreakEncoder&) { return "encoder"; }

    std::vector<std::string> done;  ///< `milliseconds: action`
    Snapshot s;

  private:
    void did(const std::string& what) { done.push_back(std::to_string(s.time / 1ms) + ": " + what); }

    bool begun_ = false;
    Names names_;
    ParsedScenario parsed_;
    ScenarioRunner runner_;
};

using Done = std::vector<std::string>;

TEST(ScenarioRunner, ActsAtItsTimes) {
    Bench bench(
        "seed 7\nat 20 ms IN1 := 1, after 5 ms IN1 := 0\nat 10 ms pulse IN0 30 ms\nat 50 ms line cut");
    bench.run_to(100ms);
    EXPECT_EQ(bench.done, (Done{"0: seed 7", "10: IN0=1", "20: IN1=1", "25: IN1=0", "40: IN0=0", "50: cut"}));
}

Names names_with(std::string_view motor) {
    const registers::DriveModel* model = registers::find_drive(motor);
    Names names;
    names.motor = model->map;
    if (model->family->is_translated()) names.drive = model;
    return names;
}

// 8000 counts a revolution; 2000 of torque a revolution is 0.25 a count.
TEST(ScenarioRunner, DrivesThePlantAroundTheMotor) {
    Bench bench(R"scn(
        motor stop below -2 rev
        motor stop above 500 counts spring 2000 per rev
        motor stop none
        motor sensor on below -1 rev
        motor sensor off below 0.5 rev
        motor analogue -7.5 V
        motor pulses -5000 per s
        motor steps 300 per s
        motor supply 20.5 V
        motor logic 15 V
        motor temperature -10
        motor encoder broken
        motor load -80
        motor brake 300
    )scn",
                names_with("MAC800"));
    bench.run_to(1ms);
    EXPECT_EQ(bench.done, (Done{"0: stop below -16000 spring 0", "0: stop above 500 spring 250", "0: free",
                                "0: sensor below -8000", "0: sensor above 4000", "0: analogue -75",
                                "0: pulses -5000", "0: steps 300", "0: supply 205", "0: logic 150",
                                "0: temperature -10", "0: encoder", "0: load -80", "0: brake 300"}));
}

// Upper stop 0, lower stop 1, reference 2, security 3; 4096 counts a revolution.
TEST(ScenarioRunner, DrivesTheInputsOfAMidiModule) {
    Bench bench(R"scn(
        at 1 ms motor upper_stop on for 2 ms, motor security 1
        at 5 ms motor reference on below 0 rev, motor lower_stop off above -2 rev, motor upper_stop on above 8192
        at 6 ms motor power off for 1 ms
    )scn",
                names_with("MAC34-1"));
    bench.run_to(10ms);
    EXPECT_EQ(bench.done, (Done{"1: drive input 0 on", "1: drive input 3 on", "3: drive input 0 off",
                                "5: switch 2 below 0", "5: switch 1 below -8192", "5: switch 0 above 8192",
                                "6: off", "7: on"}));
}

TEST(ScenarioRunner, LooksAtShaftAndTorque) {
    Bench bench("expect at 5 ms SHAFT = -0.5 rev +- 1 counts and TORQUE < 300");
    bench.s.shaft = -2049;
    bench.s.torque = 299;
    bench.run_to(10ms);
    EXPECT_TRUE(bench.passes());
    Bench other("expect at 5 ms SHAFT = 0 and TORQUE < 300");
    other.s.torque = 300;
    other.run_to(10ms);
    EXPECT_FALSE(other.passes());
    EXPECT_EQ(other.seen(), "at 5.000 ms SHAFT = 0, TORQUE = 300");
}

TEST(ScenarioRunner, EveryRepeatsFromAndUntil) {
    Bench bench("every 10 ms from 15 ms until 40 ms toggle IN0");
    bench.run_to(100ms);
    EXPECT_EQ(bench.done, (Done{"15: IN0=1", "25: IN0=0", "35: IN0=1"}));
}

TEST(ScenarioRunner, WhenActsEachTimeAndOnceOnlyOnce) {
    Bench bench("when OUT0 rises after 10 ms log \"each\"\nonce OUT0 rises log \"once\"");
    bench.run_to(5ms);
    for (int i = 0; i < 2; ++i) {
        bench.s.outputs = 1;
        bench.run_to(bench.s.time + 5ms);
        bench.s.outputs = 0;
        bench.run_to(bench.s.time + 20ms);
    }
    EXPECT_EQ(bench.done, (Done{"10: once", "20: each", "45: each"}));
}

TEST(ScenarioRunner, AConditionTrueFromTheStartCountsButDoesNotRise) {
    Bench bench("when not OUT0 log \"is\"\nwhen not OUT0 rises log \"rises\"");
    bench.run_to(5ms);
    EXPECT_EQ(bench.done, (Done{"0: is"}));
}

TEST(ScenarioRunner, OrdersAreMoments) {
    Bench bench("when ordered \"position( p2 )\" log \"go\"");
    bench.run_to(1ms);
    bench.s.orders = {{.command = 0x41}};
    bench.run_to(2ms);
    bench.s.orders = {{.command = 0x41}};
    bench.run_to(3ms);
    EXPECT_EQ(bench.done, (Done{"2: go", "3: go"}));
}

TEST(ScenarioRunner, RulesThatSetEachOtherOffAreStopped) {
    Bench bench("when IN0 rises IN0 := 0\nwhen IN0 falls IN0 := 1\nat 1 ms IN0 := 1");
    try {
        bench.run_to(2ms);
        FAIL() << "no EndlessRules";
    } catch (const EndlessRules& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("x.scn:")) << error.what();
    }
}

TEST(ScenarioRunner, EndsAtItsTimeAndOnItsCondition) {
    Bench by_time("end at 10 ms");
    by_time.run_to(9ms);
    EXPECT_FALSE(by_time.ended());
    by_time.run_to(10ms);
    EXPECT_TRUE(by_time.ended());
    Bench by_condition("end when step = 3 after 2 ms");
    by_condition.s.step = 3;
    by_condition.run_to(1ms);
    EXPECT_FALSE(by_condition.ended());
    by_condition.run_to(2ms);
    EXPECT_TRUE(by_condition.ended());
}

TEST(ScenarioRunner, ExpectAtATime) {
    Bench good("expect at 10 ms step = 3");
    good.s.step = 3;
    good.run_to(10ms);
    good.s.step = 4;
    good.run_to(20ms);
    EXPECT_TRUE(good.passes());
    Bench bad("expect at 10 ms step = 3 and OUT1");
    bad.run_to(20ms);
    EXPECT_FALSE(bad.passes());
    EXPECT_EQ(bad.seen(), "at 10.000 ms step = 0, OUT1 = 0");
}

TEST(ScenarioRunner, ExpectAtTheEnd) {
    Bench good("expect P_IST = 100 +- 2");
    good.s.p_ist = 102;
    good.run_to(10ms);
    EXPECT_TRUE(good.passes());
    Bench bad("expect P_IST = 100 +- 2");
    bad.s.p_ist = 103;
    bad.run_to(10ms);
    EXPECT_FALSE(bad.passes());
}

TEST(ScenarioRunner, ARunThatEndsTooEarlyFails) {
    Bench bench("expect at 10 ms not OUT0");
    bench.run_to(9ms);
    EXPECT_FALSE(bench.passes());
    EXPECT_EQ(bench.seen(), "the run ended at 9.000 ms, before that time");
}

TEST(ScenarioRunner, NeverAndAlways) {
    Bench good("never OUT0 and OUT1\nalways not ERROR until 5 ms");
    good.s.outputs = 2;
    good.run_to(5ms);
    good.s.error = true;
    good.run_to(10ms);
    EXPECT_TRUE(good.passes());
    Bench bad("never OUT0 and OUT1");
    bad.run_to(5ms);
    bad.s.outputs = 3;
    bad.run_to(6ms);
    bad.s.outputs = 0;
    bad.run_to(10ms);
    EXPECT_FALSE(bad.passes());
    EXPECT_EQ(bad.seen(), "at 6.000 ms OUT0 = 1, OUT1 = 1");
}

TEST(ScenarioRunner, EventuallyAndBy) {
    Bench good("expect eventually OUT0");
    good.run_to(5ms);
    good.s.outputs = 1;
    good.run_to(6ms);
    good.s.outputs = 0;
    good.run_to(9ms);
    EXPECT_TRUE(good.passes());
    Bench late("expect OUT0 by 5 ms");
    late.run_to(6ms);
    late.s.outputs = 1;
    late.run_to(9ms);
    EXPECT_FALSE(late.passes());
}

TEST(ScenarioRunner, WithinATimeAfterAnEvent) {
    constexpr const char* kText = "expect OUT1 within 20 ms after IN0 rises\nat 10 ms IN0 := 1";
    Bench good(kText);
    good.run_to(30ms);
    good.s.outputs = 2;
    good.run_to(30ms);
    EXPECT_FALSE(good.passes()) << "at the limit it was still 0";
    Bench in_time(kText);
    in_time.run_to(29ms);
    in_time.s.outputs = 2;
    in_time.run_to(60ms);
    EXPECT_TRUE(in_time.passes());
    Bench too_late(kText);
    too_late.run_to(31ms);
    too_late.s.outputs = 2;
    too_late.run_to(60ms);
    EXPECT_FALSE(too_late.passes());
    EXPECT_EQ(too_late.seen(), "at 30.000 ms OUT1 = 0, 20 ms after IN0 rises (10.000 ms)");
    Bench never("expect OUT1 within 20 ms after IN1 rises");
    never.run_to(60ms);
    EXPECT_FALSE(never.passes());
}

TEST(ScenarioRunner, ATimeAfterAnEvent) {
    Bench good("expect OUT1 20 ms after IN0 rises\nat 10 ms IN0 := 1");
    good.run_to(29ms);
    good.s.outputs = 2;
    good.run_to(60ms);
    EXPECT_TRUE(good.passes());
    Bench bad("expect OUT1 20 ms after IN0 rises\nat 10 ms IN0 := 1");
    bad.s.outputs = 2;
    bad.run_to(29ms);
    bad.s.outputs = 0;
    bad.run_to(60ms);
    EXPECT_FALSE(bad.passes());
}

TEST(ScenarioRunner, WaitsUntilAnEventHasHappenedSoOften) {
    Bench bench(
        "every 10 ms toggle IN0\nonce IN0 rises 2 times after 3 ms log \"second\"\nend when IN0 3 times");
    bench.run_to(55ms);  // rises at 10, 30, 50 ms
    EXPECT_EQ(bench.done,
              (Done{"10: IN0=1", "20: IN0=0", "30: IN0=1", "33: second", "40: IN0=0", "50: IN0=1"}));
    EXPECT_TRUE(bench.ended());
}

TEST(ScenarioRunner, CountsEvents) {
    const auto passes = [](const std::string& text) {
        Bench bench("every 10 ms toggle IN0\n" + text);
        bench.run_to(55ms);  // rises at 10, 30, 50 ms
        return bench.passes();
    };
    EXPECT_TRUE(passes("expect IN0 rises 3 times"));
    EXPECT_FALSE(passes("expect IN0 rises 2 times"));
    EXPECT_FALSE(passes("expect IN0 rises 4 times"));
    EXPECT_TRUE(passes("expect IN0 rises 2 times by 45 ms"));
    EXPECT_TRUE(passes("expect IN0 falls at least 2 times"));
    EXPECT_TRUE(passes("expect IN0 falls at most 2 times"));
    EXPECT_FALSE(passes("expect IN0 falls at most 1 times"));
    EXPECT_TRUE(passes("expect INPUTS changes 5 times"));
    EXPECT_TRUE(passes("expect IN1 rises 0 times"));
    EXPECT_FALSE(passes("expect IN1 rises"));
}

// --- what reacts, and for how long
// -----------------------------------------------------------------------------

TEST(ScenarioRunner, WhenOneRisesWhileAnotherIs) {
    Bench bench("when OUT0 rises and OUT1 log \"both\"");
    bench.run_to(5ms);
    for (const int outputs : {1, 0, 2, 3, 1, 3, 0}) {  // OUT0 rises without OUT1, then with it, then stays
        bench.s.outputs = static_cast<std::uint8_t>(outputs);
        bench.run_to(bench.s.time + 5ms);
    }
    EXPECT_EQ(bench.done, (Done{"25: both"}));
}

TEST(ScenarioRunner, WhatLastsForATimeHappensOnceAStretch) {
    Bench bench("when OUT0 for 20 ms log \"lasts\"\nwhen OUT0 falls and not OUT1 for 10 ms log \"gone\"");
    bench.set_outputs(5ms, 1);
    bench.set_outputs(24ms, 0);
    bench.set_outputs(40ms, 1);
    bench.set_outputs(100ms, 0);
    bench.set_outputs(105ms, 2);  // not long enough without OUT1
    bench.run_to(150ms);
    EXPECT_EQ(bench.done, (Done{"34: gone", "60: lasts"}));
}

TEST(ScenarioRunner, AWindowOpensAndCloses) {
    Bench bench("every 10 ms toggle IN0\nwhen IN0 rises from 20 ms until 50 ms log \"in\"");
    bench.run_to(100ms);  // rises at 10, 30, 50, 70, 90 ms
    Done in;
    for (const std::string& done : bench.done) {
        if (done.ends_with("in")) in.push_back(done);
    }
    EXPECT_EQ(in, (Done{"30: in", "50: in"}));
}

TEST(ScenarioRunner, CancelDropsWhatRulesPlannedBefore) {
    Bench bench(R"scn(
        when OUT0 rises after 20 ms IN1 := 1, log "kept"
        when OUT0 falls cancel IN1, after 5 ms IN1 := 0
        at 30 ms IN1 := 1
    )scn");
    bench.set_outputs(5ms, 1);
    bench.set_outputs(10ms, 0);
    bench.run_to(50ms);
    EXPECT_EQ(bench.done, (Done{"15: IN1=0", "25: kept", "30: IN1=1"}))
        << "what it plans itself stays, and what has a time of its own";
}

TEST(ScenarioRunner, CancelAtATimeDropsWhatRulesPlannedUntilThen) {
    Bench bench(R"scn(
        when OUT0 rises after 20 ms IN1 := 1
        every 8 ms from 8 ms after 6 ms IN2 := 1
        at 10 ms cancel IN1, cancel IN2, after 1 ms IN3 := 1
    )scn");
    bench.set_outputs(5ms, 1);  // IN1 at 25 ms
    bench.run_to(23ms);         // IN2 at 14 ms, which is dropped, and at 22 ms
    EXPECT_EQ(bench.done, (Done{"11: IN3=1", "22: IN2=1"}));
}

TEST(ScenarioRunner, CancelAllLeavesTheEnd) {
    Bench bench(
        "end when OUT0 after 20 ms\nwhen OUT0 after 10 ms log \"late\", motor load 5\nat 5 ms line cut for 2 "
        "ms\n"
        "when OUT1 cancel all");
    bench.s.outputs = 1;
    bench.set_outputs(1ms, 3);
    bench.run_to(20ms);
    EXPECT_EQ(bench.done, (Done{"5: cut", "7: restored"}));
    EXPECT_TRUE(bench.ended());
}

TEST(ScenarioRunner, AnInputFollowsTheMachine) {
    Bench bench("IN2 follows OUT0 after 30 ms back after 10 ms\nIN3 follows not OUT0");
    bench.run_to(5ms);
    EXPECT_EQ(bench.s.inputs, 8) << "IN3 is where it belongs from the beginning";
    bench.set_outputs(20ms, 1);  // too short
    bench.set_outputs(40ms, 0);
    bench.set_outputs(100ms, 1);
    bench.set_outputs(300ms, 0);
    bench.run_to(400ms);
    EXPECT_EQ(bench.done, (Done{"0: IN3=1", "20: IN3=0", "40: IN3=1", "100: IN3=0", "130: IN2=1",
                                "300: IN3=1", "310: IN2=0"}));
}

TEST(ScenarioRunner, APartAppearsAndDisappears) {
    Bench bench(R"scn(
        IN0 appears every 20 ms until 40 ms
        IN0 disappears 5 ms after IN0 rises
        IN1 appears for 3 ms 10 ms after OUT0 rises
        IN2 appears at 50 ms
    )scn");
    bench.set_outputs(31ms, 1);
    bench.run_to(100ms);
    EXPECT_EQ(bench.done, (Done{"20: IN0=1", "25: IN0=0", "40: IN0=1", "41: IN1=1", "44: IN1=0", "45: IN0=0",
                                "50: IN2=1"}));
}

TEST(ScenarioRunner, WhatIsSetForATimeGoesBack) {
    Bench bench("at 10 ms IN0 := 1 for 5 ms, after 20 ms line cut for 2 ms");
    bench.run_to(100ms);
    EXPECT_EQ(bench.done, (Done{"10: IN0=1", "15: IN0=0", "30: cut", "32: restored"}));
}

// OUT1 is on from 15 ms to 39 ms; IN0 rises at 10 ms.
bool passes_with_out1(const std::string& text) {
    Bench bench("at 10 ms IN0 := 1\n" + text);
    bench.set_outputs(15ms, 2);
    bench.set_outputs(39ms, 0);
    bench.run_to(60ms);
    return bench.passes();
}

TEST(ScenarioRunner, ExpectationsOfATime) {
    EXPECT_TRUE(passes_with_out1("expect OUT1 from 16 ms until 38 ms"));
    EXPECT_FALSE(passes_with_out1("expect OUT1 from 13 ms until 39 ms"));
    EXPECT_FALSE(passes_with_out1("expect OUT1 from 15 ms until 41 ms"));
    EXPECT_FALSE(passes_with_out1("expect not OUT1 for 4 ms after IN0 rises until 9 ms")) << "no event";
    EXPECT_TRUE(passes_with_out1("expect not OUT1 for 4 ms after IN0 rises"));
    EXPECT_FALSE(passes_with_out1("expect not OUT1 for 6 ms after IN0 rises"));
    EXPECT_TRUE(passes_with_out1("expect OUT1 for 20 ms within 25 ms after IN0 rises"));
    EXPECT_FALSE(passes_with_out1("expect OUT1 for 20 ms within 24 ms after IN0 rises"));
    EXPECT_TRUE(passes_with_out1("expect OUT1 for 20 ms by 35 ms"));
    EXPECT_FALSE(passes_with_out1("expect OUT1 for 30 ms by 60 ms"));
    EXPECT_TRUE(passes_with_out1("expect OUT1 for 10 ms at 25 ms"));
    EXPECT_FALSE(passes_with_out1("expect OUT1 for 10 ms at 24 ms"));
    EXPECT_TRUE(passes_with_out1("expect OUT1 for 20 ms 1 times"));
    EXPECT_TRUE(passes_with_out1("expect OUT1 for 30 ms 0 times"));
    EXPECT_TRUE(passes_with_out1("expect OUT1 rises 1 times from 15 ms until 20 ms"));
    EXPECT_TRUE(passes_with_out1("expect OUT1 rises 0 times from 16 ms"));
    EXPECT_TRUE(passes_with_out1("expect not OUT1 for 10 ms"));
    EXPECT_FALSE(passes_with_out1("expect not OUT1 for 30 ms"));
}

TEST(ScenarioRunner, WhatIsSeenHasTheUnitAskedFor) {
    const auto seen = [](const std::string& text) {
        Bench bench("expect " + text);
        bench.s.p_ist = 8100;  // 4096 counts a revolution: 1.97754
        bench.s.v_ist = -31;   // 31 x 60 x 520.8333 / 4096 = 236.511
        bench.s.torque = 512;  // of 1023: 50.0489 %
        bench.run_to(1ms);
        EXPECT_FALSE(bench.passes());
        return bench.seen();
    };
    EXPECT_EQ(seen("P_IST = 2 rev +- 10 counts"), "at 1.000 ms P_IST = 1.9775 rev");
    EXPECT_EQ(seen("P_IST = 0 +- 10 counts"), "at 1.000 ms P_IST = 8100 counts");
    EXPECT_EQ(seen("P_IST = 0"), "at 1.000 ms P_IST = 8100");
    EXPECT_EQ(seen("V_IST = 0 +- 1 rpm"), "at 1.000 ms V_IST = -236.5112 rpm");
    EXPECT_EQ(seen("TORQUE < 50 %"), "at 1.000 ms TORQUE = 50.0489 %");
}

/// Estop AT NOT IN2, declared so
Names with_inverted() {
    Names names;
    names.inputs[2] = "Estop";
    names.inverted_inputs = 0x04;
    return names;
}

TEST(ScenarioInvertedInput, ActionsGoByTheName) {
    Bench bench(
        "at 1 ms Estop := 0\nat 2 ms Estop := 1\nat 3 ms IN2 := 1\nat 4 ms Estop := 1 for 2 ms\n"
        "at 8 ms pulse Estop 1 ms\nat 10 ms toggle Estop\nat 11 ms IN2 := 0\nEstop disappears at 12 ms\n"
        "Estop appears at 13 ms\n",
        with_inverted());
    bench.run_to(20ms);
    const std::vector<std::string> levels{"1: IN2=1",  "2: IN2=0",  "3: IN2=1", "4: IN2=0",
                                          "6: IN2=1",  "8: IN2=0",  "9: IN2=1", "10: IN2=0",
                                          "11: IN2=0", "12: IN2=1", "13: IN2=0"};
    EXPECT_EQ(bench.done, levels);
}

TEST(ScenarioInvertedInput, FollowsByTheName) {
    Bench bench("Estop follows OUT0 after 2 ms back after 3 ms\n", with_inverted());
    bench.set_outputs(0ms, 0);
    EXPECT_EQ(bench.s.inputs, 0x04);
    bench.set_outputs(10ms, 1);
    bench.run_to(12ms);
    EXPECT_EQ(bench.s.inputs, 0x00);
    bench.set_outputs(20ms, 0);
    bench.run_to(22ms);
    EXPECT_EQ(bench.s.inputs, 0x00);
    bench.run_to(23ms);
    EXPECT_EQ(bench.s.inputs, 0x04);
}

TEST(ScenarioInvertedInput, ConditionsGoByTheName) {
    Bench bench(
        "when Estop rises log \"pressed\"\nwhen IN2 rises log \"wire on\"\nexpect Estop = 0 and IN2\n"
        "at 5 ms IN2 := 1\nat 9 ms IN2 := 0\nat 15 ms Estop := 0\n",
        with_inverted());
    bench.run_to(20ms);
    const std::vector<std::string> done{"5: IN2=1",   "5: wire on", "9: IN2=0",
                                        "9: pressed", "15: IN2=1",  "15: wire on"};
    EXPECT_EQ(bench.done, done);
    EXPECT_TRUE(bench.passes());
    EXPECT_EQ(bench.seen(), "at 20.000 ms Estop = 0, IN2 = 1");
}

}  // namespace
}  // namespace nplc::sim
