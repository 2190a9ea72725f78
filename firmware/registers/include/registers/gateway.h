#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "registers/midi.h"
#include "registers/settings.h"
#include "registers/vocabulary.h"

/// The gateway's own registers on the user port, accessed by MacTalk (001 §5.1). The map is defined by this
/// project. One register is a longword in one number; numbers without a row read 0. Their meanings are in
/// firmware/gateway/REGISTERS.md.
namespace nplc::registers::gateway {

inline constexpr std::uint32_t kIdentity = 0x474C504E;  ///< "NPLG" in the order on the line
inline constexpr std::uint32_t kMapVersion = 1;
/// R: 255 is the broadcast address, answered by the motor behind the gateway; 254 is commonly used by clients
/// for a single motor, and motors are delivered with 1.
inline constexpr std::uint8_t kDefaultAddress = 128;

enum Number : std::uint8_t {
    IDENTITY = 1,
    FW_VERSION = 2,
    MAP_VERSION = 3,
    TABLE_CRC = 4,
    TABLE_BYTES = 5,
    STORED_CRC = 6,
    STORED_BYTES = 7,
    STORED_MAX = 8,
    STORE_FLAGS = 9,
    PASSWORD_STATE = 10,
    PASSWORD = 11,
    OPERATOR = 12,
    OPERATOR_PEER = 13,
    OPERATOR_LEFT = 14,
    OPERATE = 15,

    STATUS = 16,
    SAFE_REASON = 17,
    SAFE_SINCE = 18,
    UPTIME = 19,
    STEP = 20,
    TIMER = 21,
    COUNTER = 22,
    INPUTS = 23,
    OUTPUTS = 24,
    SCANS = 25,
    SCAN_TIME = 26,
    SCAN_WORST = 27,
    LINK = 28,
    FORCE_LEFT = 29,
    LOG_COUNT = 30,
    RESULT = 31,

    LINK_LOSSES = 32,
    RESENT = 33,
    ORDERS = 34,
    DISCARDED = 35,
    ACCESSES = 36,
    ACCESS_FAILS = 37,
    MESSAGES = 38,
    REFUSED = 39,
    LINE_FAULTS = 40,
    POLL_WORST = 43,
    LATE_POLLS = 44,
    ECHO_TIME = 45,
    STOP_SINCE = 46,

    COMMAND = 48,
    FORCE_IN = 49,
    FORCE_OUT = 50,
    BREAK_LOW = 51,
    BREAK_HIGH = 52,

    UPLOAD_STATE = 56,
    UPLOAD_RECEIVED = 57,
    UPLOAD_BYTES = 58,
    UPLOAD_CRC = 59,
    TABLE_POINTER = 60,
    TABLE_DATA = 61,
    PROOF_BYTES = 62,
    PROOF = 63,

    FIRED_SCAN = 80,
    FIRED_STEP = 81,
    FIRED_KEY = 82,

    SET_POINT_COUNT = 83,
    SET_POINT_STATE = 84,
    SET_POINT_CRC = 85,
    SET_POINT_CHANGES = 86,
    SET_POINT_RECORD = 87,
    SET_POINT_BYTES = 88,
    SET_POINT_POINTER = 89,
    SET_POINT_DATA = 90,
    SET_POINT_WRITE = 91,
    FIRED = 96,

    LOG = 128,
    SET_POINT = 160,
    SET_POINT_WANTED = 176,

    FIRMWARE_BOARD = 192,
    FIRMWARE_STATE = 193,
    FIRMWARE_VERSION = 194,
    FIRMWARE_SLOT = 196,
    FIRMWARE_RECEIVED = 198,
    FIRMWARE_DATA = 199,
    SETTINGS = 200,
};

inline constexpr std::uint8_t kProofWords = 8;  ///< PROOF and the 7 after it
inline constexpr std::uint8_t kSetPoints = 16;  ///< SET_POINT and the 15 after it, SET_POINT_WANTED too
inline constexpr std::uint8_t kLines = 3;       ///< LINE_FAULTS and the two after it
inline constexpr std::uint8_t kFirmwareSlots =
    2;  ///< FIRMWARE_VERSION and FIRMWARE_SLOT, and the one after each
inline constexpr std::uint8_t kFiredWords = 32;    ///< FIRED and the 31 after it: one bit per term
inline constexpr std::uint8_t kLogEntries = 16;    ///< two registers each, from LOG on
inline constexpr std::uint8_t kMostSettings = 31;  ///< registers of settings, from SETTINGS + 1 on

/// The register of a setting.
constexpr std::uint8_t register_of(Setting setting) {
    return static_cast<std::uint8_t>(SETTINGS + static_cast<unsigned>(setting));
}

/// Bytes of PASSWORD: a long write, padded with zeros to a multiple of 4.
inline constexpr std::size_t kLeastPassword = 8;
inline constexpr std::size_t kMostPassword = 128;

/// Registers whose write only sets a parameter of a later command or read: they need no operator's seat.
constexpr bool only_prepares(std::uint8_t reg) {
    return reg == UPLOAD_BYTES || reg == TABLE_POINTER || reg == SET_POINT_POINTER;
}

/// Writes allowed for every client: those that only prepare, and the end of forces.
constexpr bool is_for_everybody(std::uint8_t reg, std::uint32_t value) {
    return only_prepares(reg) || ((reg == FORCE_IN || reg == FORCE_OUT) && value == 0);
}

/// Appendix after the end term of a table that is uploaded with a certificate: this mark, then its SHA-256.
inline constexpr std::array<std::uint8_t, 8> kProofMark{'N', 'P', 'L', 'P', 'R', 'O', 'O', 'F'};
inline constexpr std::size_t kDigestBytes = std::size_t{4} * kProofWords;
inline constexpr std::size_t kProofBytes = kProofMark.size() + kDigestBytes;

/// SET_POINT_STATE.
enum SetPointBit : std::uint32_t {
    kChangeWaits = 1U << 0,      ///< wanted values are not in force yet
    kValuesDamaged = 1U << 1,    ///< of the stored values; older ones or defaults are used
    kRecipeDiffers = 1U << 2,    ///< wanted values are not those of the recipe that was loaded last
    kActiveRecipe = 0xFFU << 8,  ///< its number; 0: none
};

/// Bits 31..16 of SET_POINT_POINTER: the content of SET_POINT_DATA, from the byte in bits 15..0 on, in a
/// block from SET_POINT_POINTER.
enum class SetPointView : std::uint8_t { record = 0, first_recipe = 1, requests = 254, changes = 255 };
inline constexpr std::size_t kSetPointDataBytes = 60;

/// An entry of the view `changes`, 16 bytes each, the latest first.
inline constexpr std::size_t kChangeBytes = 16;

/// An entry of the view `requests`: a request's own number and its RESULT, 4 bytes each.
inline constexpr std::size_t kKeptRequests = 4;
inline constexpr std::uint32_t kRequestUnderWay = 0xFFFF'FFFF;  ///< instead of RESULT

enum class Access : std::uint8_t { read, read_write, write };

struct Row {
    std::uint8_t number;
    std::uint8_t count;  ///< register numbers of the row
    std::string_view name;
    Access access;
    std::string_view text;
};

/// In ascending order of number.
std::span<const Row> map();
/// The row that contains a number; nullptr if none.
const Row* find(std::uint8_t number);
const Row* find(std::string_view name);

}  // namespace nplc::registers::gateway
