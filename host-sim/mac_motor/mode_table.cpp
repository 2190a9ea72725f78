#include "sim/mode_table.h"

#include <array>

namespace nplc::sim {
namespace {

constexpr ModeFacts passive(std::string_view name) {
    return {.name = name};
}
constexpr ModeFacts passive_with_pulses(std::string_view name) {
    return {.name = name, .counts_pulses = true};
}
constexpr ModeFacts driven(std::string_view name) {
    return {.name = name, .simulated = true, .driven = true};
}
constexpr ModeFacts homing(std::string_view name) {
    return {.name = name, .simulated = true, .driven = true, .homing = true};
}
constexpr ModeFacts gear(std::string_view name) {
    return {.name = name, .simulated = true, .driven = true, .corrected = true, .counts_pulses = true};
}

constexpr std::array<ModeFacts, 25> kModes{{
    {.name = "INIT", .simulated = true, .counts_pulses = true},
    driven("V_MODE"),
    {.name = "P_MODE", .simulated = true, .driven = true, .corrected = true},
    gear("GP_MODE"),
    passive("AT_MODE"),
    passive("AV_MODE"),
    passive_with_pulses("AVG_MODE"),
    passive("MANI_MODE"),
    passive("TESTU_MODE"),
    passive("TESTA_MODE"),
    passive("BREAK_MODE"),
    driven("STOP_MODE"),
    homing("HOME1_MODE"),
    homing("HOME2_MODE"),
    homing("HOME3_MODE"),
    {.name = "SAFE_MODE", .simulated = true},
    passive("AVZ_MODE"),
    passive("VAT_MODE"),
    passive_with_pulses("AG_MODE"),
    passive_with_pulses("COIL_MODE"),
    passive("A2POS_MODE"),
    passive("APOS_MODE"),
    passive("TESTKI_MODE"),
    passive("TESTTQ_MODE"),
    gear("GF_MODE"),
}};

}  // namespace

const ModeFacts* facts_of(std::uint16_t mode) {
    return mode < kModes.size() ? &kModes[mode] : nullptr;
}

}  // namespace nplc::sim
