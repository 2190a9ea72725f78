#pragma once

#include <cstdint>

/// MODE_REG and bits that modes go by (001 §4.4).
namespace nplc::causes {

/// MODE_REG (001 §4.4).
enum Mode : std::int64_t {
    kInit = 0,
    kVelocity = 1,
    kPosition = 2,
    kGearPosition = 3,
    kAnalogueTorque = 4,
    kAnalogueVelocity = 5,
    kAnalogueVelocityGear = 6,
    kManual = 7,
    kTestU = 8,
    kTestA = 9,
    kBreak = 10,
    kStop = 11,
    kHome1 = 12,
    kHome3 = 14,
    kSafe = 15,
    kAnalogueVelocityZero = 16,
    kVelocityAnalogueTorque = 17,
    kAnalogueGear = 18,
    kCoil = 19,
    kAnalogue2Position = 20,
    kAnaloguePosition = 21,  ///< the last of a MAC800
    kTestKi = 22,
    kTestTorque = 23,
    kGearFollow = 24,
    kDefaultsToFlash = 256,  ///< what follows acts on memory and flash (001 §4.4.16)
    kFactoryDefaults = 257,
    kReload = 258,
};
/// The maker's tests, which turn the shaft without regulating it (001 §4.4.8 to §4.4.11; 004: "reserved").
constexpr bool is_test(std::int64_t mode) {
    return (mode >= kManual && mode <= kBreak) || mode == kTestKi || mode == kTestTorque;
}
constexpr bool is_passive(std::int64_t mode) {
    return mode == kInit || mode == kSafe;
}

/// DIS_P_LIM of ERR_STAT: MIN_P_IST and MAX_P_IST do not act (001 §3.2.35, 004).
inline constexpr std::int64_t kDisPLim = 1 << 14;
/// USERINTF of CNTRL_BITS on MAC50 to MAC141; all of it set, the pins of the pulse input are FastMAC's (001
/// §3.2.36).
inline constexpr std::int64_t kUserInterface = 3;

}  // namespace nplc::causes
