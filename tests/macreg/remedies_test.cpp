// The commands that `why` recommends are accepted as printed, and change nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "causes.h"
#include "macreg/change.h"
#include "macreg/parameters.h"
#include "macreg/service.h"
#include "macreg/values.h"
#include "typist.h"

namespace nplc::macreg {
namespace {

constexpr std::int64_t kUserInterface = 3;
constexpr std::int64_t kDisPLim = 1 << 14;

/// A motor in a condition, whose owner uses settings that share registers with errors and user interface:
/// RELPOSPFNC and INDEX_HOME (001 §3.2.35, §3.2.36), DIS_P_LIM and MAN_NO_BRAKE (004).
struct Patient {
    explicit Patient(const Case& one) : bench(one.model) {
        const bool large = one.model == Model::mac800;
        one.condition(bench);
        bench.run(one.for_time);
        bench.put("ERR_STAT", bench.at("ERR_STAT") | (large ? 1 << 14 : 1 << 10));
        bench.put("CNTRL_BITS", bench.at("CNTRL_BITS") | (large ? 1 << 7 : 1 << 11));
    }
    std::int64_t settings(std::string_view name) const {
        return bench.at(name) & setting_bits(bench.motor.model(), bench.reg(name));
    }

    Bench bench;
};

void set(Patient& patient, std::vector<std::string> words, const std::string& command) {
    Motor& motor = patient.bench.motor;
    const bool force = take(words, "--force");
    const auto [all, error] = read_assignments(motor.model(), words);
    ASSERT_EQ(error, "") << command;
    ASSERT_FALSE(all.empty()) << command;
    bool dangerous = false;
    for (const Assignment& one : all) {
        EXPECT_EQ(no_mode(motor.model(), *one.reg, one.raw), "") << command;
        EXPECT_NE(one.reg->access, registers::Access::read_only) << command;
        dangerous = dangerous || !danger(motor.model(), *one.reg, one.raw).empty();
    }
    EXPECT_EQ(dangerous, force) << command;
    for (const Assignment& one : all) {
        const bool may_wait = motor.read(registers::ERR_STAT) & error_bits(motor.model());
        const ChangeResult outcome = change(motor, *one.reg, one.raw);
        // An error whose cause is still there stays, and with it INIT_MODE: the remedy says what to mend
        // first.
        EXPECT_TRUE(outcome.taken || may_wait || outcome.why.find("still there") != std::string::npos)
            << command << ": " << outcome.why;
    }
}

void serve(Patient& patient, std::vector<std::string> words, const std::string& command) {
    try {
        EXPECT_TRUE(serve(patient.bench, std::move(words))) << "no command of macreg's: " << command;
    } catch (const NotDone& error) {
        const bool driven = patient.bench.sim.plant().load().torque != 0;  // no order stops that one
        EXPECT_TRUE(driven) << command << ": " << error.what();
    }
}

void type(Patient& patient, const std::string& command) {
    std::vector<std::string> words = words_of(command);
    const std::string program = words.at(0);
    words.erase(words.begin());
    ASSERT_FALSE(words.empty()) << command;
    const std::string verb = words.at(0);
    if (program == "nanoctl") {
        static const std::set<std::string> kKnown{"status", "log", "run", "step", "stop", "watch"};
        EXPECT_EQ(kKnown.count(verb), 1U) << command;
        return;
    }
    ASSERT_EQ(program, "macreg") << command;
    if (verb == "why" || verb == "prepare") {
        EXPECT_EQ(words.size(), 1U) << command;
        return;
    }
    if (verb == "watch" || verb == "get") {
        for (std::size_t i = 1; i < words.size(); ++i)
            EXPECT_NE(patient.bench.motor.find(words[i]), nullptr) << command;
        return;
    }
    if (verb != "set") return serve(patient, words, command);
    words.erase(words.begin());
    const std::int64_t errors_settings = patient.settings("ERR_STAT");
    const std::int64_t control = patient.settings("CNTRL_BITS");
    set(patient, words, command);
    const std::int64_t named = command.find("DIS_P_LIM") != std::string::npos ? kDisPLim : 0;
    EXPECT_EQ(patient.settings("ERR_STAT"), errors_settings | named) << command;
    EXPECT_EQ(patient.settings("CNTRL_BITS") & ~kUserInterface, control & ~kUserInterface) << command;
}

TEST(Remedies, EachCommandIsTakenAndChangesNothingElse) {
    std::size_t typed = 0;
    for (const Case& one : cases()) {
        if (one.code == std::string_view("mode_unknown")) continue;
        Patient shown(one);
        const auto findings = why(read_condition(shown.bench.motor, false));
        for (const Finding& finding : findings) {
            for (const std::string& command : commands_in(finding.remedy)) {
                SCOPED_TRACE(std::string(one.code) + " -> " + finding.code + ": " + finding.remedy);
                Patient patient(one);
                type(patient, command);
                ++typed;
            }
        }
    }
    EXPECT_GT(typed, 100U);
}

TEST(Remedies, NoneHasAPlaceholder) {
    for (const Case& one : cases()) {
        Patient shown(one);
        for (const Finding& finding : why(read_condition(shown.bench.motor, false))) {
            for (const std::string& command : commands_in(finding.remedy))
                EXPECT_EQ(command.find(".."), std::string::npos) << command;
        }
    }
}

// 001 §3.2.36, §4.4.4: pulses need the pins, and the flash is written in INIT_MODE only.
TEST(Remedies, TheOneForPulsesMakesThePulseInputWork) {
    Bench bench;
    bench.put("CNTRL_BITS", 3 | 1 << 9);  // COMMUNICATION, AUTO_RESYNC
    bench.sim.store_registers();
    bench.sim.power_cycle();
    bench.sim.terminals().set_pulse_rate(10'000);
    bench.put("MODE_REG", 3);
    bench.run(600ms);
    for (const Finding& finding : why(read_condition(bench.motor, false))) {
        if (finding.code != "pulse_pins_taken") continue;
        const auto commands = commands_in(finding.remedy);
        ASSERT_EQ(commands.size(), 2U) << finding.remedy;
        EXPECT_EQ(commands[0], "macreg set CNTRL_BITS USERINTF=INPUT+AUTO_RESYNC");
        EXPECT_EQ(commands[1], "macreg flash save --stop");
        return;
    }
    FAIL() << "not found";
}

}  // namespace
}  // namespace nplc::macreg
