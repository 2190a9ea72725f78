#pragma once

#include <cstdint>

#include "base/can_frame.h"

/// The CAN bus of MIDI Ingenierie's MAC34 (003 §V): expedited SDOs similar to CiA 301, but with the data in
/// big-endian order, LMT messages for the address, boot-up and SYNC. Standard identifiers of 11 bits only.
namespace nplc::protocol::midi_can {

inline constexpr std::uint16_t kSync = 0x080;
inline constexpr std::uint16_t kFromModule = 0x580;  ///< + address
inline constexpr std::uint16_t kToModule = 0x600;    ///< + address; 600h is the broadcast
inline constexpr std::uint16_t kBootUp = 0x700;      ///< + address
inline constexpr std::uint16_t kLmtAnswer = 0x7E4;
inline constexpr std::uint16_t kLmt = 0x7E5;

inline constexpr std::uint8_t kGeneral = 0;  ///< every module executes it, address 1 answers (003 §V.8)
inline constexpr std::uint8_t kMaxAddress = 127;
inline constexpr std::uint16_t kIndices = 0x2000;  ///< + the number of a command (0..1Fh) or query (0..0Fh)

/// Messages to a module.
struct Request {
    enum class Kind : std::uint8_t {
        none,         ///< no message to modules
        command,      ///< 23h: write
        query,        ///< 40h: read
        other,        ///< to a module, in another SDO form: refused
        sync,         ///< starts the command prepared by 2010h; not answered
        configure,    ///< LMT 04h 01h; not answered
        set_address,  ///< LMT 11h; `data` is the address
        operate,      ///< LMT 04h 00h: the new address takes effect; answered by a boot-up
    };
    Kind kind = Kind::none;
    std::uint8_t address = 0;
    std::uint16_t index = 0;
    std::uint8_t sub_index = 0;
    std::uint32_t data = 0;
    bool operator==(const Request&) const = default;
};

/// For `none` and `other`, which are never sent, a frame without bytes and identifier 0.
base::CanFrame encode(const Request& request);
/// SDOs have all 8 bytes, LMT messages at least the used ones, SYNC none (R).
Request decode_request(const base::CanFrame& frame);

/// Messages from a module.
struct Answer {
    enum class Kind : std::uint8_t {
        none,
        accepted,       ///< 60h
        value,          ///< 42h; 43h, as in CiA 301, is accepted too
        refused,        ///< 80h; `data` is the abort code, big-endian; R: 0
        address_taken,  ///< LMT 11h, error code 0
        address_refused,
        booted,
    };
    Kind kind = Kind::none;
    std::uint8_t address = 0;
    std::uint16_t index = 0;
    std::uint8_t sub_index = 0;
    std::uint32_t data = 0;
    bool operator==(const Answer&) const = default;
};

base::CanFrame encode_answer(const Answer& answer);
/// Also accepts the answer to a general message from 601h, as printed in 003 §V.8.
Answer decode_answer(const base::CanFrame& frame);

/// `accepted`, `value` or `refused` for exactly this command or query. The sub-index of a RAM reading (2008h)
/// is not compared: 003 §VII does not define it.
bool answers(const Answer& answer, const Request& request);

}  // namespace nplc::protocol::midi_can
