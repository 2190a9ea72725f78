#include "macreg/why.h"

#include <algorithm>

#include "base/bytes.h"
#include "why_facts.h"

namespace nplc::macreg {
namespace {

namespace gw = registers::gateway;

constexpr base::Milliseconds kBetween{200};

constexpr std::string_view kJudged =
    "MODE_REG P_SOLL V_SOLL A_SOLL T_SOLL P_FNC P_IST V_IST KVOUT GEARF1 GEARF2 I2T I2TLIM UIT UITLIM FLWERR "
    "FLWERRMAX FNCERR FNCERRMAX MIN_P_IST MAX_P_IST ACC_EMERG ERR_STAT CNTRL_BITS STARTMODE START_MODE "
    "V_HOME "
    "T_HOME HOME_MODE P_REG_P V_REG_P A_REG_P T_REG_P L_REG_P Z_REG_P P1 P2 P3 P4 P5 P6 V8 KFF0 KFF1 KFF2 "
    "KFF3 KFF4 KFF5 KVFX1 KVFX2 KVFX3 KVFX4 KVFX5 KVFX6 KIFX1 KIFX2 FNC_OUT V_EXT VF_OUT ANINP AMPLITUDE "
    "U_SUPPLY U_MIN_SUP UV_HANDLE U_24V DEGC DEGCMAX U_BUS";

std::vector<const registers::Register*> judged(registers::Model model) {
    std::vector<const registers::Register*> all;
    for (const std::string_view name : words_of(kJudged)) {
        const registers::Register* reg = registers::find(model, name);
        if (reg != nullptr && std::find(all.begin(), all.end(), reg) == all.end()) all.push_back(reg);
    }
    return all;
}

constexpr Rule<Facts> kUnknown{
    "unknown",
    Severity::tells,
    nullptr,
    "Nothing is found that keeps the motor from moving: {MODE_REG}, no error, and all that this mode needs "
    "is "
    "there.",
    "MODE_REG P_SOLL P_IST V_SOLL A_SOLL T_SOLL V_IST VF_OUT ERR_STAT",
    "Watch what it does: `macreg watch MODE_REG P_SOLL {=P_FNC} P_IST V_IST VF_OUT FLWERR`."};

/// A remedy that lets the motor turn says what has to come before.
void begin_safely(const Facts& facts, Lets lets, Finding& finding) {
    if (facts.moves()) return;
    if (lets == Lets::turn) finding.remedy.insert(0, facts.before_it_turns());
    if (lets == Lets::jump)
        finding.remedy.insert(
            0,
            "First `macreg set MODE_REG INIT_MODE`: it pushes, and would jump as soon as it "
            "can turn (hold a hanging load, which falls by that). Then: ");
}

/// Behind a gateway, what it must be told before and what it does not carry.
void pass_gateway(const Facts& facts, Finding& finding) {
    if (!facts.gateway()) return;
    const auto names = [&](std::string_view command) {
        return finding.remedy.find(command) != std::string::npos;
    };
    if (!facts.gateway_is(gw::RunState::stopped) && names("`macreg set"))
        finding.remedy.insert(0,
                              "First `nanoctl stop`: while its sequence runs or is held, the gateway lets no "
                              "write through unless its setting motor_writes says so. Then: ");
    if (names("`macreg flash") || names("`macreg safe"))
        finding.remedy +=
            " `flash` and `safe` need the motor's own MacTalk line: the gateway does not carry them.";
}

}  // namespace

Condition read_condition(Motor& motor, bool look_for_gateway) {
    Condition condition{.model = motor.model()};
    const auto wanted = judged(motor.model());
    condition.before = motor.read_block(wanted);
    motor.master().pause(kBetween);
    condition.now = motor.read_block(wanted);
    if (!look_for_gateway || !motor.is_behind_gateway()) return condition;
    const auto block = motor.master().read_block(gw::kDefaultAddress, gw::STATUS);
    condition.gateway = {.status = base::load_u32(block.data()), .safe_reason = base::load_u32(&block[4])};
    return condition;
}

std::vector<Finding> why(const Condition& condition) {
    const Facts facts(condition);
    std::vector<Finding> all;
    for (const Rule<Facts>& rule : rules()) {
        if (!rule.holds(facts)) continue;
        all.push_back(finding_of(rule, facts));
        begin_safely(facts, rule.lets, all.back());
        pass_gateway(facts, all.back());
    }
    if (!facts.moves() && only_tell(all)) all.push_back(finding_of(kUnknown, facts));
    // That it moves is told first.
    std::stable_sort(all.begin() + (facts.moves() ? 1 : 0), all.end(),
                     [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
    return all;
}

}  // namespace nplc::macreg
