#pragma once

#include <cstdint>

/// The PLC's addresses of values and commands: the same on every board (firmware/faces/modbus/README.md, The
/// map). Addresses as in the message, from 0.
namespace nplc::registers::modbus {

enum Coil : std::uint16_t { kRun, kStop, kSafe, kHold, kStep, kScan, kAcknowledge, kResetError, kCoils };
enum Discrete : std::uint16_t {
    kReady,
    kRunning,
    kWaiting,
    kHeld,
    kIsSafe,
    kError,
    kInPosition,
    kLinkUp,
    kForced,
    kAtBreakpoint,
    kHasTable,
    kEnabled,
    kUpload,
    kSettingsDiffer,
    kCannotGoOn,
    kStopUnconfirmed,
    kDiscretes,
};
/// Values of `command` besides the gateway's own run to hold.
enum PlantCommand : std::uint16_t {
    kAcknowledgeEvents = 32,
    kResetMotorError = 33,
    kTakeSetPoints = 34,
    kLoadRecipe = 35,
};
enum Holding : std::uint16_t {
    kCommand = 0,
    kCommandNumber = 1,
    kForceInputs = 2,
    kForceOutputs = 3,
    kRecipe = 4,
    kSetPointsWritten = 5,
    kSetPointsNew = 6,  ///< two words each
};
/// Input registers.
enum Input : std::uint16_t {
    kMapVersion = 0,
    kStatusWord = 1,
    kRunState = 2,
    kLastEvent = 10,
    kLastEventStep = 11,
    kLastEventDetail = 12,
    kHeartbeat = 13,
    kSeat = 15,
    kControl = 16,
    kMySeat = 17,
    kNewEvents = 40,
    kDoneNumber = 41,
    kResult = 42,
    kResultDetail = 43,
    kImageAge = 44,
    kLatePolls = 48,        ///< two words, the last of the contiguous ones
    kPositionCounts = 100,  ///< two words
};
inline constexpr std::uint16_t kMapNumber = 1;

/// Register n of a motor is in two holding registers from here + 2 n on.
inline constexpr std::uint16_t kMotorWindow = 1000;
inline constexpr std::uint16_t kMotorWindowEnd = kMotorWindow + 2 * 256;

}  // namespace nplc::registers::modbus
