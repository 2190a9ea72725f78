#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "macreg/midi/values.h"
#include "midi_client/link.h"

/// Expert frames as the maker's tool takes them (000 §VI, at its end): "00150000000320".
namespace nplc::macreg::midi {

struct RawFrame {
    midi_client::Request request{};
    std::string error{};  ///< a sentence, empty if the frame is valid
};
/// 14 hexadecimal digits: address, index, sub-index, four bytes of parameters; blanks are ignored. On CAN
/// address 00 is every module.
RawFrame read_raw(std::string_view text, bool can);

/// "RUN to address 0: direction 0, 300 rpm"; on CAN address 0 is all modules (003 §V.8), on V24 FFh.
std::string describe_request(const midi_client::Request& request, const Scale& scale, bool can = false);
/// "accepted", "GET_POSITION: 4660 inc"
std::string describe_answer(const midi_client::Request& request, const midi_client::Answer& answer,
                            const Scale& scale);

/// The risk of sending it; empty if it only reads, sets a parameter, or stops.
std::string danger_of(const midi_client::Request& request);

}  // namespace nplc::macreg::midi
