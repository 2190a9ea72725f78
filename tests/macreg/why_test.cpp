// Each cause on a virtual motor in that very condition.
#include "macreg/why.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "causes.h"
#include "registers/gateway.h"

namespace nplc::macreg {
namespace {

const Finding* find(const std::vector<Finding>& findings, std::string_view code) {
    const auto found =
        std::find_if(findings.begin(), findings.end(), [&](const Finding& one) { return one.code == code; });
    return found == findings.end() ? nullptr : &*found;
}

std::string codes(const std::vector<Finding>& findings) {
    std::string all;
    for (const Finding& one : findings) all += one.code + " ";
    return all;
}

std::vector<Finding> judge(Bench& bench) {
    return why(read_condition(bench.motor, false));
}

std::vector<Finding> of_a_motor_that_turns(Model model) {
    Bench bench(model);
    bench.put("MODE_REG", 1);
    bench.run(600ms);
    return judge(bench);
}

TEST(Why, RegistersHaveTheNamesOfTheModel) {
    for (const auto& [model, name] :
         {std::pair{Model::mac140, " STARTMODE is"}, std::pair{Model::mac800, " START_MODE is"}}) {
        Bench bench(model);
        bench.run(300ms);
        const auto findings = judge(bench);
        const Finding* passive = find(findings, "passive");
        ASSERT_NE(passive, nullptr) << codes(findings);
        EXPECT_NE(passive->remedy.find(name), std::string::npos) << passive->remedy;
    }
}

TEST(Why, EachCauseIsFoundAndTold) {
    const auto small = of_a_motor_that_turns(Model::mac140);
    const auto large = of_a_motor_that_turns(Model::mac800);
    for (const Case& one : cases()) {
        if (one.code == std::string_view("mode_unknown")) continue;
        Bench bench(one.model);
        one.condition(bench);
        bench.run(one.for_time);
        const auto findings = judge(bench);
        const Finding* finding = find(findings, one.code);
        ASSERT_NE(finding, nullptr) << one.code << ", but " << codes(findings);
        EXPECT_EQ(finding->severity, one.severity) << one.code;
        EXPECT_GT(finding->sentence.size(), 20U) << one.code;
        EXPECT_GT(finding->remedy.size(), 10U) << one.code;
        EXPECT_EQ((finding->sentence + finding->remedy).find('{'), std::string::npos) << one.code;
        const bool always =
            one.code == std::string_view("moves") || one.code == std::string_view("fastmac_owns");
        EXPECT_EQ(find(one.model == Model::mac800 ? large : small, one.code) != nullptr, always) << one.code;
    }
}

/// What the owner reads first must be what keeps the motor from moving.
TEST(Why, WhatStopsStandsInFront) {
    for (const Case& one : cases()) {
        Bench bench(one.model);
        one.condition(bench);
        bench.run(one.for_time);
        const auto findings = judge(bench);
        const bool moves = findings.front().code == "moves";
        EXPECT_TRUE(
            std::is_sorted(findings.begin() + (moves ? 1 : 0), findings.end(),
                           [](const Finding& a, const Finding& b) { return a.severity < b.severity; }))
            << codes(findings);
    }
}

TEST(Why, AnErrorStandsBeforeThePassiveMode) {
    Bench bench;
    bench.sim.overload();
    bench.run(100ms);
    EXPECT_EQ(judge(bench).front().code, "error_i2t_err");
}

/// A cause before what it leads to.
TEST(Why, TheRegulatorIsAccusedBeforeTheShaft) {
    for (const char* name : {"KVOUT", "KVFX4"}) {
        Bench bench;
        bench.put(name, 0);
        bench.put("P_SOLL", 5000);
        mode(bench, 2);
        bench.run(3000ms);
        const auto findings = judge(bench);
        EXPECT_EQ(findings.front().code,
                  name == std::string_view("KVOUT") ? "load_factor_zero" : "regulator_zero");
        EXPECT_NE(find(findings, "lags"), nullptr) << codes(findings);
    }
}

// 001 §4.5.3: the motor would make itself passive on its way.
TEST(Why, APassiveMotorIsNotSentOutOfItsLimits) {
    Bench bench;
    bench.put("MIN_P_IST", -10'000);
    bench.put("MAX_P_IST", 10'000);
    bench.put("P_SOLL", 20'000);
    bench.run(100ms);
    const auto findings = judge(bench);
    const Finding& passive = *find(findings, "passive");
    EXPECT_TRUE(passive.remedy.starts_with("`macreg set P_SOLL 4096 MODE_REG P_MODE`")) << passive.remedy;
    EXPECT_EQ(passive.remedy.find("V_MODE"), std::string::npos) << passive.remedy;
}

// 001 §3.2.3: +/-67,000,000.
TEST(Why, TheTargetThatIsNamedIsInTheRegistersRange) {
    Bench bench;
    for (const char* name : {"P_SOLL", "P_IST"}) bench.put(name, 66'999'999);
    bench.put("P_FNC", 16 * 66'999'999);
    mode(bench, 2);
    bench.run(300ms);
    const auto findings = judge(bench);
    EXPECT_EQ(findings.front().code, "at_target") << codes(findings);
    EXPECT_NE(findings.front().remedy.find("P_SOLL 66995903"), std::string::npos) << findings.front().remedy;
}

TEST(Why, LimitsThatLeaveNoPlaceAreToldBeforeTheirError) {
    for (const std::int64_t low : {500, 1}) {
        Bench bench;
        bench.put("MIN_P_IST", low);
        bench.put("MAX_P_IST", low == 500 ? -500 : 1);
        bench.run(100ms);
        const auto findings = judge(bench);
        EXPECT_EQ(findings.front().code, "limits_swapped") << codes(findings);
        const Finding* error = find(findings, "error_plim_err");
        ASSERT_NE(error, nullptr);
        EXPECT_EQ(error->remedy.find("Turn the shaft"), std::string::npos) << error->remedy;
    }
}

// 001 §3.2.36: it counts from a reset on.
TEST(Why, AUserInterfaceThatWasSetWithoutAResetDoesNotAct) {
    Bench bench;  // FastMAC, from the box
    bench.sim.terminals().set_pulse_rate(10'000);
    bench.put("CNTRL_BITS", 0);
    mode(bench, 3);
    bench.run(300ms);
    const auto waiting = judge(bench);
    const Finding& pulses = *find(waiting, "no_pulses");
    EXPECT_NE(pulses.remedy.find("after the last reset"), std::string::npos) << pulses.remedy;
    EXPECT_NE(pulses.remedy.find("`macreg flash save --stop`"), std::string::npos) << pulses.remedy;
    free_pulse_pins(bench);
    bench.put("CNTRL_BITS", 3);
    bench.run(100ms);
    const auto findings = judge(bench);  // V_EXT counts in INIT_MODE
    EXPECT_EQ(find(findings, "fastmac_owns"), nullptr) << codes(findings);
    EXPECT_NE(find(findings, "user_interface_waits"), nullptr) << codes(findings);
}

TEST(Why, TheGatewayIsToldBeforeThePassiveMotor) {
    namespace gw = registers::gateway;
    Bench bench;
    bench.run(100ms);
    Condition condition = read_condition(bench.motor, false);
    const auto first = [&](gw::RunState state, std::uint32_t more = gw::kLinkDelivers) {
        condition.gateway = GatewayState{.status = static_cast<std::uint32_t>(state) | more};
        return why(condition).front().code;
    };
    EXPECT_EQ(first(gw::RunState::stopped), "gateway_stopped");
    EXPECT_EQ(first(gw::RunState::held), "gateway_held");
    EXPECT_EQ(first(gw::RunState::stopped, gw::kLinkDelivers | gw::kSafe), "gateway_safe");
    EXPECT_EQ(first(gw::RunState::running, 0), "gateway_link_down");
    condition.now.set(registers::ERR_STAT, 1, {});
    EXPECT_EQ(first(gw::RunState::stopped), "error_i2t_err");
    condition.now.set(registers::ERR_STAT, 0, {});
    condition.now.set(registers::KVOUT, 0, {});
    first(gw::RunState::running);
    EXPECT_NE(why(condition).front().remedy.find("First `nanoctl stop`"), std::string::npos);
}

/// In a fault step the sequence has sent STOP, and an operator must acknowledge: no write to the motor helps.
TEST(Why, ASequenceThatStoppedTheMotorIsNotOverruled) {
    namespace gw = registers::gateway;
    Bench bench;
    mode(bench, 1);
    bench.put("V_SOLL", 0);
    bench.run(100ms);
    Condition condition = read_condition(bench.motor, false);
    const auto first = [&](gw::RunState state, std::uint32_t more = gw::kLinkDelivers) {
        condition.gateway =
            GatewayState{.status = static_cast<std::uint32_t>(state) | more, .safe_reason = 2};
        return why(condition).front();
    };
    EXPECT_EQ(first(gw::RunState::running).code, "velocity_zero");
    EXPECT_EQ(first(gw::RunState::running).remedy.find("macreg"), std::string::npos);
    EXPECT_NE(first(gw::RunState::running).remedy.find("what it waits for"), std::string::npos);
    EXPECT_EQ(first(gw::RunState::stopped, gw::kLinkDelivers | gw::kSafe).remedy, "`nanoctl run` starts it.");
    condition.gateway.reset();
    EXPECT_NE(why(condition).front().remedy.find("`macreg set V_SOLL 500rpm`"), std::string::npos);
}

TEST(Why, AMotorThatTurnsIsNotAccused) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        const auto findings = of_a_motor_that_turns(model);
        EXPECT_EQ(findings.front().code, "moves");
        for (const Finding& one : findings) EXPECT_EQ(one.severity, Severity::tells) << one.code;
    }
}

Condition turning(Model model, std::int64_t mode, std::int64_t v_soll, std::int64_t before,
                  std::int64_t now) {
    Condition condition{.model = model};
    for (auto* snapshot : {&condition.before, &condition.now}) {
        snapshot->set(registers::MODE_REG, mode, {});
        snapshot->set(registers::V_SOLL, v_soll, {});
    }
    condition.before.set(registers::V_IST, before, {});
    condition.now.set(registers::V_IST, now, {});
    condition.now.set(registers::P_IST, 100 * now, {});
    return condition;
}

// 001 §3.2.5, §3.2.12: V_SOLL 419 is 200 rpm, V_IST 1017 is 7759 rpm. 004: 554 and 1344.
TEST(Why, ARunawayIsToldFirst) {
    for (const auto& [model, v_soll, v_ist] :
         {std::tuple{Model::mac140, 419, 1017}, std::tuple{Model::mac800, 554, 1344}}) {
        for (const int mode : {1, 2, 11}) {
            for (const int sign : {1, -1}) {
                const auto findings = why(turning(model, mode, v_soll, sign * v_ist, sign * v_ist));
                EXPECT_EQ(findings.front().code, "runaway") << codes(findings);
                EXPECT_EQ(find(findings, "moves"), nullptr);
                EXPECT_TRUE(findings.front().sentence.starts_with("CUT ITS POWER"));
            }
        }
        EXPECT_EQ(find(why(turning(model, 1, 16 * v_ist, v_ist, v_ist)), "runaway"), nullptr) << "as asked";
        EXPECT_EQ(find(why(turning(model, 1, v_soll, v_ist, v_ist * 3 / 4)), "runaway"), nullptr) << "brakes";
        EXPECT_EQ(find(why(turning(model, 0, v_soll, v_ist, v_ist)), "runaway"), nullptr) << "passive";
    }
}

TEST(Why, AMotorOnItsWayToALowerVelocityDoesNotRunAway) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        Bench bench(model);
        bench.put("V_SOLL", 6000);
        mode(bench, 1);
        bench.run(2000ms);
        bench.put("A_SOLL", 1);
        bench.put("V_SOLL", 500);
        bench.run(200ms);
        const auto findings = judge(bench);
        EXPECT_EQ(findings.front().code, "moves") << codes(findings);
    }
}

// 001 §3.2.163: the profile is at its target, the shaft is not at the target.
TEST(Why, AMotorWhosePlaceWasWrittenIsNotAtItsTarget) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        Bench bench(model);
        mode(bench, 2);
        bench.run(300ms);
        bench.put("P_IST", 5000);
        bench.run(300ms);
        const auto findings = judge(bench);
        EXPECT_EQ(find(findings, "at_target"), nullptr) << codes(findings);
        const Finding* apart = find(findings, "profile_apart");
        ASSERT_NE(apart, nullptr) << codes(findings);
        EXPECT_NE(apart->remedy.find("`macreg set P_NEW 5000 CNTRL_BITS "), std::string::npos)
            << apart->remedy;
        bench.put("P_NEW", 5000);
        bench.put("CNTRL_BITS", bench.at("CNTRL_BITS") | (model == Model::mac800 ? 1 << 6 : 1 << 10));
        bench.run(500ms);
        EXPECT_NEAR(static_cast<double>(bench.at("P_IST")), 5000, 2) << "the shaft stood";
        EXPECT_NE(find(judge(bench), "at_target"), nullptr);
    }
}

// FLWERR lies between profile and shaft (001 §4.4.3).
TEST(Why, AShaftThatIsHeldShortOfItsTargetIsNotAtIt) {
    Condition condition;
    condition.now.set(registers::MODE_REG, 2, {});
    condition.now.set(registers::P_SOLL, 1000, {});
    condition.now.set(registers::P_FNC, 16 * 1000, {});
    condition.now.set(registers::P_IST, 900, {});
    condition.now.set(registers::FLWERR, 100, {});
    const auto findings = why(condition);
    EXPECT_NE(find(findings, "lags"), nullptr) << codes(findings);
    EXPECT_EQ(find(findings, "at_target"), nullptr);
    condition.now.set(registers::P_IST, 999, {});
    condition.now.set(registers::FLWERR, 1, {});
    EXPECT_NE(find(why(condition), "at_target"), nullptr);
}

// A target that is 29.8 turns away is reported before P_MODE is chosen.
TEST(Why, ThePassiveMotorsWayToItsTargetIsTold) {
    Bench bench;
    bench.put("CNTRL_BITS", 3);
    bench.put("P_FNC", 16 * 122'061);
    bench.run(100ms);
    const Finding* passive = nullptr;
    const auto findings = judge(bench);
    passive = find(findings, "passive");
    ASSERT_NE(passive, nullptr);
    // 122061 / 4096 = 29.80
    EXPECT_NE(passive->remedy.find("turns -122061"), std::string::npos) << passive->remedy;
    EXPECT_NE(passive->remedy.find("(-29.80"), std::string::npos) << passive->remedy;
}

TEST(Why, ALimitThatIsWrongIsSuspectedBeforeASupplyThatIsThere) {
    Bench bench;
    bench.put("U_MIN_SUP", 5000);
    bench.run(200ms);
    const auto findings = judge(bench);
    const Finding* low = find(findings, "undervoltage");
    ASSERT_NE(low, nullptr);
    EXPECT_NE(low->remedy.find("macreg set U_MIN_SUP "), std::string::npos) << low->remedy;
    Condition off;
    off.now.set(registers::ERR_STAT, 1 << 13, {});
    const auto without = why(off);
    ASSERT_NE(find(without, "undervoltage"), nullptr);
    EXPECT_EQ(find(without, "undervoltage")->remedy.find("U_MIN_SUP"), std::string::npos);
}

// Registers alone: a motor refuses such a mode.
TEST(Why, AnUnknownMode) {
    Condition condition;
    condition.now.set(registers::MODE_REG, 40, {});
    EXPECT_NE(find(why(condition), "mode_unknown"), nullptr);
}

// A target ahead, all that it needs, and no motion yet.
TEST(Why, NothingFoundIsToldAsSuch) {
    Bench bench;
    bench.put("MODE_REG", 2);
    bench.run(100ms);
    Condition condition = read_condition(bench.motor, false);
    EXPECT_EQ(find(why(condition), "unknown"), nullptr);
    condition.now.set(registers::P_SOLL, 1000, {});
    EXPECT_NE(find(why(condition), "unknown"), nullptr);
}

TEST(Why, NearlyTooHot) {
    Condition condition;
    condition.now.set(registers::UIT, 9000, {});
    condition.now.set(registers::UITLIM, 10'000, {});
    EXPECT_NE(find(why(condition), "uit_near"), nullptr);
    condition.now.set(registers::UIT, 7000, {});
    EXPECT_EQ(find(why(condition), "uit_near"), nullptr);
    Condition large{.model = Model::mac800};
    large.now.set(29, 650, {});  // DEGC, 79 degrees
    large.now.set(31, 696, {});  // DEGCMAX, 85 degrees
    EXPECT_NE(find(why(large), "hot_near"), nullptr);
}

TEST(Why, TheGatewaysStateIsTold) {
    namespace gw = registers::gateway;
    Condition condition;
    const auto with = [&](std::uint32_t status) {
        condition.gateway = GatewayState{.status = status};
        return why(condition);
    };
    const auto state = [](gw::RunState one) { return static_cast<std::uint32_t>(one); };
    EXPECT_NE(find(with(state(gw::RunState::running)), "gateway_link_down"), nullptr);
    EXPECT_NE(find(with(state(gw::RunState::running) | gw::kLinkDelivers), "gateway_runs"), nullptr);
    EXPECT_NE(find(with(state(gw::RunState::stopped) | gw::kLinkDelivers), "gateway_stopped"), nullptr);
    EXPECT_NE(find(with(state(gw::RunState::held) | gw::kLinkDelivers), "gateway_held"), nullptr);
    EXPECT_NE(find(with(gw::kSafe | gw::kLinkDelivers), "gateway_safe"), nullptr);
    EXPECT_EQ(find(with(gw::kLinkDelivers), "gateway_safe"), nullptr);
}

TEST(Why, ManyCausesAreKnown) {
    std::set<std::string> known;
    for (const Case& one : cases()) known.insert(one.code);
    EXPECT_GE(known.size(), 25U);
}

}  // namespace
}  // namespace nplc::macreg
