// Two causes at once: the remedies, followed one after another, end with a motor that moves, and none leads
// to an error that was not there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "causes.h"
#include "macreg/change.h"
#include "macreg/values.h"
#include "typist.h"

namespace nplc::macreg {
namespace {

constexpr std::size_t kEachPair = NPLC_EACH_PAIR;

void free_shaft(Bench& bench) {
    bench.sim.plant().load() = sim::Load{};
}

/// Turns the shaft by hand to the middle between the limits: a stop that it is beyond takes it along.
void turn_back(Bench& bench) {
    const std::int64_t low = bench.at("MIN_P_IST"), high = bench.at("MAX_P_IST"), now = bench.at("P_IST");
    if ((low == 0 && high == 0) || (now > low && now < high)) return;
    const std::int64_t way = (low + high) / 2 - now;
    sim::Load& load = bench.sim.plant().load();
    (way < 0 ? load.high_stop : load.low_stop) =
        sim::MechanicalStop{.counts = bench.sim.plant().counts() + way};
    bench.run(100ms);
    bench.sim.plant().load().high_stop.reset();
    bench.sim.plant().load().low_stop.reset();
}

bool has_limits(const Bench& bench) {
    return bench.at("MIN_P_IST") != 0 || bench.at("MAX_P_IST") != 0;
}

void stop_master(Bench& bench) {
    if (has_limits(bench)) bench.sim.terminals().set_pulse_rate(0);
}

void set_up_coil(Bench& bench) {
    for (const auto& [name, raw] : {std::pair{"P1", 100}, {"P2", 200}, {"P3", 500}, {"P4", 600}})
        bench.put(name, raw);
}

void set_up_reach(Bench& bench) {
    bench.put("P1", 500);
    bench.put("P2", bench.at("MODE_REG") == 20 ? 200 : 5);  // by level; or 320 counts at 10 V
}

void raise_voltage(Bench& bench) {
    bench.sim.terminals().set_analogue(8'000);
}

/// What the words of a remedy ask for beside its commands, by the finding's code.
void do_by_hand(Bench& bench, const std::string& code) {
    static const std::map<std::string, std::function<void(Bench&)>> kHands{
        {"blocked", free_shaft},
        {"torque_too_small", free_shaft},
        {"lags", free_shaft},
        {"error_flw_err", free_shaft},
        {"error_fnc_err", free_shaft},
        {"error_plim_err", turn_back},
        {"error_i2t_err",
         [](Bench& b) {
             free_shaft(b);
             b.run(180s);
         }},
        {"i2t_near", [](Bench& b) { b.run(180s); }},
        {"error_u24v_err", [](Bench& b) { b.sim.surroundings().logic_millivolts = 24'000; }},
        {"error_index_err",
         [](Bench& b) {
             b.sim.surroundings().encoder_broken = false;
             b.sim.power_cycle();
         }},
        {"gear_zero", stop_master},
        {"gear_denominator_zero", stop_master},
        {"no_pulses", [](Bench& b) { b.sim.terminals().set_pulse_rate(has_limits(b) ? 100 : 10'000); }},
        {"analogue_zero", raise_voltage},
        {"analogue_dead_band", raise_voltage},
        {"analogue_torque_zero", raise_voltage},
        {"waits_for_level",
         [](Bench& b) {
             b.sim.terminals().set_analogue(b.sim.terminals().millivolts(0) > 5000 ? 0 : 8'000);
         }},
        {"waits_for_voltage", raise_voltage},
        {"coil_setup", set_up_coil},
        {"coil_outside_limits", set_up_coil},
        {"voltage_outside_limits", set_up_reach},
        {"coil_waits",
         [](Bench& b) {
             b.put("P5", 300);
             b.sim.terminals().set_analogue(10'000);
         }},
    };
    if (const auto found = kHands.find(code); found != kHands.end()) found->second(bench);
}

/// A remedy may name several ways; each with its commands.
std::vector<std::vector<std::string>> ways_of(std::string remedy) {
    std::vector<std::vector<std::string>> all;
    const auto keep = [&](const std::string& part) {
        if (auto commands = commands_in(part); !commands.empty()) all.push_back(std::move(commands));
    };
    constexpr std::string_view kOther[] = {", or ", " Or ", "as the last resort"};
    for (;;) {
        std::size_t at = std::string::npos;
        for (const std::string_view word : kOther) at = std::min(at, remedy.find(word));
        keep(remedy.substr(0, at));
        if (at == std::string::npos) return all;
        remedy.erase(0, at + 4);
    }
}

void type(Bench& bench, const std::string& command) {
    std::vector<std::string> words = words_of(command);
    ASSERT_EQ(words.at(0), "macreg") << command;
    words.erase(words.begin());
    if (words.at(0) != "set") {
        ASSERT_TRUE(words[0] == "watch" || words[0] == "get" || serve(bench, words)) << command;
        return;
    }
    words.erase(words.begin());
    static_cast<void>(take(words, "--force"));
    const auto [all, error] = read_assignments(bench.motor.model(), words);
    ASSERT_EQ(error, "") << command;
    for (const Assignment& one : all) {
        const ChangeResult outcome = change(bench.motor, *one.reg, one.raw);
        ASSERT_TRUE(outcome.taken) << command << ": " << one.reg->name << ": " << outcome.why;
    }
}

std::int64_t errors_of(const Bench& bench) {
    return bench.at("ERR_STAT") & error_bits(bench.motor.model());
}

/// Follows one way; its path is for the message of a test that fails.
void follow(Bench& bench, const Finding& finding, std::size_t way, std::string& path) {
    path += fmt::format("\n  {}: {}", finding.code, finding.remedy);
    SCOPED_TRACE(path);
    const std::int64_t before = errors_of(bench);
    const auto ways = ways_of(finding.remedy);
    auto commands = ways.empty() ? std::vector<std::string>{} : ways[std::min(way, ways.size() - 1)];
    // What comes first, comes before hands are laid on, whichever way is taken.
    const std::size_t then = finding.remedy.rfind("Then: ");
    if (then != std::string::npos) {
        for (const std::string& command : commands_in(finding.remedy.substr(0, then))) {
            type(bench, command);
            bench.run(1000ms);
            if (way == 0) commands.erase(commands.begin());
        }
    }
    do_by_hand(bench, finding.code);
    if (finding.remedy.find("the other errors") != std::string::npos) {
        for (const Finding& other : why(read_condition(bench.motor, false))) do_by_hand(bench, other.code);
    }
    for (const std::string& command : commands) {
        type(bench, command);
        bench.run(1000ms);
    }
    bench.run(2000ms);
    // A shaft that is held shows only once the motor tries to turn it.
    if (bench.sim.plant().load().low_stop) return;
    EXPECT_EQ(errors_of(bench) & ~before, 0)
        << "the remedy leads to " << errors_text(bench.motor.model(), errors_of(bench) & ~before) << path;
}

bool stands_for_good(const Case& one) {
    static const std::vector<std::string_view> kNot{"mode_unknown", "stop_mode",   "runaway",
                                                    "moves",        "homing_stop", "homing_switch"};
    return std::find(kNot.begin(), kNot.end(), one.code) == kNot.end();
}

std::unique_ptr<Bench> motor_with(const Case& first, const Case& second) {
    auto bench = std::make_unique<Bench>(first.model);
    for (const Case* one : {&first, &second}) {
        one->condition(*bench);
        bench->run(one->for_time);
    }
    return bench;
}

void walk(const Case& first, const Case& second) {
    const auto bench = motor_with(first, second);
    std::string path = fmt::format("\n{} and {}", first.code, second.code);
    std::map<std::string, std::size_t> tried;
    for (int step = 0; step < 16; ++step) {
        const std::int64_t place = bench->at("P_IST");
        const Finding finding = why(read_condition(bench->motor, false)).front();
        const bool moved = std::abs(bench->at("P_IST") - place) > 16 && bench->at("MODE_REG") != 0;
        if (finding.code == "moves" || moved) return;
        follow(*bench, finding, tried[finding.code]++, path);
        if (testing::Test::HasFailure()) return;
        const std::int64_t driven = bench->at("MODE_REG");
        if (driven != 0 && driven != 15 && std::abs(bench->at("P_IST") - place) > 16) return;
    }
    ADD_FAILURE() << "it never moved" << path;
}

TEST(RemedyPaths, OfTwoCausesEndWithMotionAndLeadToNoError) {
    std::size_t pairs = 0;
    for (const Case& first : cases()) {
        for (const Case& second : cases()) {
            if (!stands_for_good(first) || !stands_for_good(second) || first.model != second.model) continue;
            if (pairs++ % kEachPair == 0) walk(first, second);
            if (HasFailure()) return;
        }
    }
    EXPECT_GT(pairs, 1500U);
}

/// All ways that the first remedy names, each on a motor of its own.
TEST(RemedyPaths, NoWayOfTheFirstRemedyLeadsToAnError) {
    std::size_t pairs = 0;
    for (const Case& first : cases()) {
        for (const Case& second : cases()) {
            if (!stands_for_good(first) || !stands_for_good(second) || first.model != second.model) continue;
            if (&first > &second || pairs++ % kEachPair != 0) continue;
            for (std::size_t way = 0, ways = 1; way < ways; ++way) {
                const auto bench = motor_with(first, second);
                const Finding finding = why(read_condition(bench->motor, false)).front();
                if (finding.code == "moves") break;
                ways = std::max<std::size_t>(ways_of(finding.remedy).size(), 1);
                std::string path = fmt::format("\n{} and {}", first.code, second.code);
                follow(*bench, finding, way, path);
            }
            if (HasFailure()) return;
        }
    }
}

}  // namespace
}  // namespace nplc::macreg
