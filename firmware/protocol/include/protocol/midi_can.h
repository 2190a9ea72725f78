#pragma once

#include <cstdint>

#include "base/can_frame.h"

/// The CAN bus of MIDI Ingenierie's MAC34 (003 §V): expedited SDOs in the manner of CiA 301 with the data's
/// high byte first, LMT messages for the address, boot-up and SYNC. Standard identifiers of 11 bits only.
namespace nplc::protocol::midi_can {

inline constexpr std::uint16_t kSync = 0x080;
inline constexpr std::uint16_t kFromModule = 0x580;  ///< + address
inline constexpr std::uint16_t kToModule = 0x600;    ///< + address; 600h is for all
inline constexpr std::uint16_t kBootUp = 0x700;      ///< + address
inline constexpr std::uint16_t kLmtAnswer = 0x7E4;
inline constexpr std::uint16_t kLmt = 0x7E5;

inline constexpr std::uint8_t kGeneral = 0;  ///< every module acts, address 1 answers (003 §V.8)
inline constexpr std::uint8_t kMaxAddress = 127;
inline constexpr std::uint16_t kIndices = 0x2000;  ///< + the number of a command (0..1Fh) or query (0..0Fh)

/// What a module can be sent.
struct Request {
    enum class Kind : std::uint8_t {
        none,         ///< no message for modules
        command,      ///< 23h: write
        query,        ///< 40h: read
        other,        ///< to a module, in another SDO form: refused
        sync,         ///< starts what 2010h prepared; not answered
        configure,    ///< LMT 04h 01h; not answered
        set_address,  ///< LMT 11h; `data` is the address
        operate,      ///< LMT 04h 00h: the address holds from here on; answered by a boot-up
    };
    Kind kind = Kind::none;
    std::uint8_t address = 0;
    std::uint16_t index = 0;
    std::uint8_t sub_index = 0;
    std::uint32_t data = 0;
    bool operator==(const Request&) const = default;
};

/// A frame without bytes and identifier 0 for `none` and `other`, which nobody sends.
base::CanFrame encode(const Request& request);
/// SDOs have all 8 bytes, LMT messages at least those that mean something, SYNC none (R).
Request decode_request(const base::CanFrame& frame);

/// What a module can send.
struct Answer {
    enum class Kind : std::uint8_t {
        none,
        accepted,       ///< 60h
        value,          ///< 42h; a master also takes 43h, which CiA 301 has
        refused,        ///< 80h; `data` is the abort code as the four bytes stand, high byte first; R: 0
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
/// Takes the answer to a general message from 601h too, as 003 §V.8 prints it.
Answer decode_answer(const base::CanFrame& frame);

/// `accepted`, `value` or `refused` of just this command or query. The sub-index of a RAM reading (2008h) is
/// not looked at: 003 §VII leaves it open.
bool answers(const Answer& answer, const Request& request);

}  // namespace nplc::protocol::midi_can
