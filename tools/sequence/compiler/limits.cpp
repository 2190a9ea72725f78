#include <fmt/format.h>

#include <algorithm>

#include "compiler/checker.h"

namespace nplc::seqc {
namespace {

constexpr std::uint8_t kUndervoltageHandling = 23;  // UV_HANDLE of the MAC800 (004)
constexpr std::uint8_t kHighestTemperature = 31;    // DEGCMAX of the MAC800 (004)

/// The motor's reaction at the limit set by a register; nullptr if it sets none, or if the violation sets
/// ERROR.
const char* limit_of(const registers::Register& reg, registers::Model model) {
    if (reg.number == registers::MIN_P_IST || reg.number == registers::MAX_P_IST)
        return "a motor that leaves its position limits stops";
    if (model != registers::Model::mac800) return nullptr;
    if (reg.number == kUndervoltageHandling) return "the supply voltage below which the motor reacts";
    if (reg.number == kHighestTemperature) return "a motor that gets too hot stops";
    return nullptr;
}

const Send* first_limit(const Plan& plan, registers::Model model) {
    for (const StepPlan& step : plan.steps) {
        for (const Rule& rule : step.rules) {
            for (const Send& send : rule.action.sends) {
                if (send.reg != nullptr && send.value != 0 && limit_of(*send.reg, model) != nullptr)
                    return &send;
            }
        }
    }
    return nullptr;
}

}  // namespace

bool needs_in_position(const Rule& rule) {
    return (rule.when & ~truth_of_bit(kInPosBit)).none();
}

bool has_time_limit(const StepPlan& step) {
    return std::any_of(step.rules.begin(), step.rules.end(), [&](const Rule& rule) {
        return leaves(step, rule) && !needs_in_position(rule) &&
               (depends_on(rule.when, kTimerZero) || depends_on(rule.when, kCounterZero));
    });
}

namespace {

/// The first wait for INPOS that only INPOS can end, or nullptr; `waits`: whether there is any wait.
const Rule* endless_wait(const Plan& plan, bool& waits) {
    for (const StepPlan& step : plan.steps) {
        for (const Rule& rule : step.rules) {
            if (!leaves(step, rule) || !depends_on(rule.when, kInPosBit)) continue;
            waits = true;
            if (needs_in_position(rule) && !has_time_limit(step)) return &rule;
        }
    }
    return nullptr;
}

}  // namespace

void check_invisible_limits(const Plan& plan, registers::Model model, Report& report) {
    const Send* send = first_limit(plan, model);
    if (send == nullptr) return;
    bool waits = false;
    const Rule* wait = endless_wait(plan, waits);
    if (waits && wait == nullptr) return;
    Diagnostic& d = report.add(
        "W013", send->span, fmt::format("{}, and this does not show in ERROR", limit_of(*send->reg, model)),
        "a sequence sees only that INPOS does not come: give each wait a time limit (ELSIF TIMER.Q THEN "
        "NEXT := Fault;), or wire limit switches to inputs");
    if (wait != nullptr) d.notes.push_back({wait->condition, "this would wait for ever then"});
}

}  // namespace nplc::seqc
