#include "causes/why.h"

#include <algorithm>

#include "why_facts.h"

namespace nplc::causes {
namespace {

namespace gw = registers::gateway;

constexpr std::string_view kJudged =
    "MODE_REG P_SOLL V_SOLL A_SOLL T_SOLL P_FNC P_IST V_IST KVOUT GEARF1 GEARF2 I2T I2TLIM UIT UITLIM FLWERR "
    "FLWERRMAX FNCERR FNCERRMAX MIN_P_IST MAX_P_IST ACC_EMERG ERR_STAT CNTRL_BITS STARTMODE START_MODE "
    "V_HOME "
    "T_HOME HOME_MODE P_REG_P V_REG_P A_REG_P T_REG_P L_REG_P Z_REG_P P1 P2 P3 P4 P5 P6 V8 KFF0 KFF1 KFF2 "
    "KFF3 KFF4 KFF5 KVFX1 KVFX2 KVFX3 KVFX4 KVFX5 KVFX6 KIFX1 KIFX2 FNC_OUT V_EXT VF_OUT ANINP AMPLITUDE "
    "U_SUPPLY U_MIN_SUP UV_HANDLE U_24V DEGC DEGCMAX U_BUS";

constexpr std::string_view kJudgedBefore = "P_IST V_IST P_FNC V_EXT FLWERR FNCERR";

std::vector<const registers::Register*> all_of(registers::Model model, std::string_view names) {
    std::vector<const registers::Register*> all;
    for (const std::string_view name : words_of(names)) {
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

/// Puts the necessary precautions before a remedy that lets the motor turn.
void begin_safely(const Facts& facts, Lets lets, Finding& finding) {
    if (facts.moves()) return;
    if (lets == Lets::turn) finding.remedy.insert(0, facts.before_it_turns());
    if (lets == Lets::jump)
        finding.remedy.insert(
            0,
            "First `macreg set MODE_REG INIT_MODE`: it pushes, and would jump as soon as it "
            "can turn (hold a hanging load, which falls by that). Then: ");
}

/// Behind a gateway: what must be sent to the gateway before, and what it does not pass on.
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

std::vector<const registers::Register*> judged(registers::Model model) {
    return all_of(model, kJudged);
}

std::vector<const registers::Register*> judged_before(registers::Model model) {
    return all_of(model, kJudgedBefore);
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
    // A finding that it moves comes first.
    std::stable_sort(all.begin() + (facts.moves() ? 1 : 0), all.end(),
                     [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
    return all;
}

std::vector<Finding> why(const GatewayState& gateway) {
    Condition condition;
    condition.gateway = gateway;
    const Facts facts(condition);
    std::vector<Finding> all;
    for (const Rule<Facts>& rule : rules()) {
        if (rule.code.starts_with("gateway_") && rule.holds(facts)) all.push_back(finding_of(rule, facts));
    }
    return all;
}

Finding moving(registers::Model model, std::optional<std::int64_t> v_ist) {
    Condition condition{.model = model};
    condition.now.set(registers::find(model, "V_IST")->number, v_ist.value_or(0), {});
    const Facts facts(condition);
    const auto found = std::find_if(rules().begin(), rules().end(), [](const Rule<Facts>& rule) {
        return rule.code == "moves" && rule.sentence.starts_with("It moves");
    });
    Finding finding = finding_of(*found, facts);
    if (!v_ist) finding.sentence = "It moves.";
    return finding;
}

}  // namespace nplc::causes
