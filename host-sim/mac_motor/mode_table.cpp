#include "sim/mode_table.h"

namespace nplc::sim {
namespace {

using Block = ModeFacts::Block;
using Leave = ModeFacts::Leave;
using InPosition = ModeFacts::InPosition;
using Kind = Drive::Kind;

/// Both regulators active; INIT comes through STOP.
constexpr ModeFacts driven(std::string_view name, Block block, InPosition in_position = InPosition::never) {
    return {.name = name,
            .drive = Kind::velocity,
            .block = block,
            .leave = Leave::stopping,
            .in_position = in_position};
}
constexpr ModeFacts positioned(std::string_view name) {
    ModeFacts facts = driven(name, Block::position, InPosition::position);
    facts.corrected = true;
    return facts;
}
constexpr ModeFacts geared(std::string_view name, Block block = Block::gear) {
    ModeFacts facts = driven(name, block, InPosition::gear);
    facts.corrected = facts.counts_pulses = true;
    return facts;
}
constexpr ModeFacts geared_without_correction(std::string_view name) {
    ModeFacts facts = driven(name, Block::gear);
    facts.counts_pulses = true;
    return facts;
}
constexpr ModeFacts at_rest(std::string_view name, Kind drive, Leave leave = Leave::at_once) {
    return {.name = name, .drive = drive, .leave = leave, .begins_at_rest = true};
}

}  // namespace

constexpr std::array<ModeFacts, kModeCount> kModes{{
    {.name = "INIT", .counts_pulses = true},
    driven("V_MODE", Block::velocity, InPosition::velocity),
    positioned("P_MODE"),
    geared("GP_MODE"),
    {.name = "AT_MODE", .drive = Kind::analogue_torque, .leave = Leave::coasting},
    driven("AV_MODE", Block::analogue_velocity),
    geared_without_correction("AVG_MODE"),
    at_rest("MANI_MODE", Kind::field),
    at_rest("TESTU_MODE", Kind::voltage),
    at_rest("TESTA_MODE", Kind::torque, Leave::test),
    {.name = "BREAK_MODE", .drive = Kind::torque, .leave = Leave::test},
    driven("STOP_MODE", Block::stop),
    driven("HOME1_MODE", Block::homing),
    driven("HOME2_MODE", Block::homing),
    driven("HOME3_MODE", Block::homing),
    {.name = "SAFE_MODE"},
    driven("AVZ_MODE", Block::analogue_velocity),
    driven("VAT_MODE", Block::velocity, InPosition::velocity),
    geared("AG_MODE"),
    geared("COIL_MODE", Block::coil),
    positioned("A2POS_MODE"),
    positioned("APOS_MODE"),
    at_rest("TESTKI_MODE", Kind::shorted),
    at_rest("TESTTQ_MODE", Kind::shorted),
    geared("GF_MODE"),
}};

}  // namespace nplc::sim
