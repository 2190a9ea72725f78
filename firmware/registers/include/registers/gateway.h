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

/// The gateway's own registers on the user's port, reached by MacTalk (001 §5.1). No manual describes them:
/// the map is ours. One register is a longword in one number; numbers without a row read 0. What each means
/// stands in firmware/gateway/REGISTERS.md.
namespace nplc::registers::gateway {

inline constexpr std::uint32_t kIdentity = 0x474C504E;  ///< "NPLG", as it goes over the line
inline constexpr std::uint32_t kMapVersion = 1;
/// R: 255 is everyone, and the motor behind the gateway answers it; 254 is what clients in the field use for
/// a single motor, and motors come with 1.
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
    FIRED = 96,

    LOG = 128,
    SETTINGS = 200,
};

inline constexpr std::uint8_t kProofWords = 8;     ///< PROOF and the 7 after it
inline constexpr std::uint8_t kLines = 3;          ///< LINE_FAULTS and the two after it
inline constexpr std::uint8_t kFiredWords = 32;    ///< FIRED and the 31 after it: a bit a term
inline constexpr std::uint8_t kLogEntries = 16;    ///< two registers each, from LOG on
inline constexpr std::uint8_t kMostSettings = 31;  ///< registers of settings, from SETTINGS + 1 on

/// The register of a setting.
constexpr std::uint8_t register_of(Setting setting) {
    return static_cast<std::uint8_t>(SETTINGS + static_cast<unsigned>(setting));
}

/// What follows the end term of a table that is uploaded with a certificate: this, then its SHA-256.
inline constexpr std::array<std::uint8_t, 8> kProofMark{'N', 'P', 'L', 'P', 'R', 'O', 'O', 'F'};
inline constexpr std::size_t kDigestBytes = std::size_t{4} * kProofWords;
inline constexpr std::size_t kProofBytes = kProofMark.size() + kDigestBytes;

enum class Access : std::uint8_t { read, read_write, write };

struct Row {
    std::uint8_t number;
    std::uint8_t count;  ///< numbers that the row takes
    std::string_view name;
    Access access;
    std::string_view text;
};

/// In ascending order of number.
std::span<const Row> map();
/// The row that a number belongs to; nullptr if none.
const Row* find(std::uint8_t number);
const Row* find(std::string_view name);

}  // namespace nplc::registers::gateway
