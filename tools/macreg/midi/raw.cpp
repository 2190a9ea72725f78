#include "macreg/midi/raw.h"

#include <fmt/format.h>

#include <cctype>

#include "protocol/midi_can.h"
#include "protocol/midi_v24.h"

namespace nplc::macreg::midi {
namespace {

constexpr std::size_t kDigits = 14;

RawFrame wrong_frame(std::string error) {
    RawFrame frame;
    frame.error = std::move(error);
    return frame;
}

std::string field_text(const reg::Field& field, std::int64_t value, const Scale& scale) {
    switch (field.unit) {
        case reg::Unit::increments:
            return position_text(value, scale);
        case reg::Unit::period:
            return value == 0 ? std::string("period 0") : speed_text(value, scale);
        case reg::Unit::long_period:
            return speed_text(value * 1'600, scale);
        case reg::Unit::bits:
            return fmt::format("{:X}h", value);
        default:
            return fmt::format("{}", value);
    }
}

template <class Fields>
std::string fields_text(const Fields& fields, std::uint32_t data, const Scale& scale) {
    std::string text;
    for (const reg::Field& field : fields) {
        if (field.bits == 0) continue;
        const std::int32_t value = reg::unpack(field, data);
        if (field.name == "direction") {
            text += value == reg::kTurnsLeft ? "counter-clockwise" : "clockwise";
            continue;
        }
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", field.name, field_text(field, value, scale));
    }
    return text;
}

std::string whom(const midi_client::Request& request, bool can) {
    const bool everyone =
        request.address == (can ? protocol::midi_can::kGeneral : protocol::midi_v24::kGeneral);
    return everyone ? "all modules" : fmt::format("address {}", request.address);
}

}  // namespace

RawFrame read_raw(std::string_view text, bool can) {
    std::string digits;
    for (const char c : text) {
        if (std::isspace(static_cast<unsigned char>(c)) != 0) continue;
        if (std::isxdigit(static_cast<unsigned char>(c)) == 0)
            return wrong_frame(fmt::format("'{}': '{}' is no hexadecimal digit", text, c));
        digits += c;
    }
    if (digits.size() != kDigits)
        return wrong_frame(
            fmt::format("'{}' has {} digits: write 14, as 00150000000320: address 00, index 15, sub-index "
                        "00, parameters 00000320",
                        text, digits.size()));
    const auto number = [&](std::size_t from, std::size_t count) {
        return static_cast<std::uint32_t>(std::stoul(digits.substr(from, count), nullptr, 16));
    };
    const std::uint32_t address = number(0, 2);
    const std::uint32_t index = number(2, 2);
    if (address > 0x7F && (can || address != protocol::midi_v24::kGeneral))
        return wrong_frame(fmt::format("'{}': address {:02X}: there are 00 to 7F{}", text, address,
                                       can ? ", and 00 is all" : ", and FF for all"));
    if (index > 0x2F)
        return wrong_frame(fmt::format(
            "'{}': index {:02X}: there are 00 to 1F for commands and 20 to 2F for queries", text, index));
    const bool query = index >= protocol::midi_v24::kFirstQuery;
    return {.request = {.address = static_cast<std::uint8_t>(address),
                        .query = query,
                        .number = static_cast<std::uint8_t>(query ? index - 0x20 : index),
                        .sub_index = static_cast<std::uint8_t>(number(4, 2)),
                        .data = number(6, 8)}};
}

std::string describe_request(const midi_client::Request& request, const Scale& scale, bool can) {
    if (request.query) {
        const reg::QueryRow* row = reg::find_query(request.number);
        const std::string name =
            row != nullptr ? std::string(row->name) : fmt::format("query {:02X}h", request.number + 0x20);
        const std::string where =
            row != nullptr && row->at_address ? fmt::format(" of byte {:02X}h", request.sub_index) : "";
        return fmt::format("{}{} to {}", name, where, whom(request, can));
    }
    const reg::CommandRow* row = reg::find_command(request.number);
    if (row == nullptr)
        return fmt::format("command {:02X}h, which no manual knows, to {}", request.number,
                           whom(request, can));
    const std::string fields = fields_text(row->fields, request.data, scale);
    return fmt::format("{} to {}{}{}", row->name, whom(request, can), fields.empty() ? "" : ": ", fields);
}

std::string describe_answer(const midi_client::Request& request, const midi_client::Answer& answer,
                            const Scale& scale) {
    using AnswerKind = midi_client::Answer::Kind;
    switch (answer.kind) {
        case AnswerKind::accepted:
            return "accepted";
        case AnswerKind::value: {
            const reg::QueryRow* row = reg::find_query(request.number);
            if (row == nullptr) return fmt::format("{:08X}h", answer.value);
            if (row->number == reg::GET_STATUS) {
                const std::string words = status_words(answer.value);
                return words.empty() ? "no fault, no warning" : words;
            }
            if (row->number == reg::GET_RELEASE) return "release " + release_text(answer.value);
            if (row->at_address) return fmt::format("bytes {:08X}h", answer.value);
            return fields_text(row->fields, answer.value, scale);
        }
        case AnswerKind::refused:
            return "refused";
        case AnswerKind::not_taken:
            return "not understood (Nack)";
        case AnswerKind::unclear:
            return "a damaged answer";
        case AnswerKind::silence:
            break;
    }
    return "no answer";
}

std::string danger_of(const midi_client::Request& request) {
    if (request.query) return {};
    const reg::CommandRow* row = reg::find_command(request.number);
    if (row == nullptr) return "no manual says what this command does";
    switch (request.number) {
        case reg::STOP:
        case reg::EMERGENCY_STOP:
            return {};
        case reg::POWER_OFF:
            return "the motor no longer holds its load, and a turning one is not braked";
        case reg::WAIT_SYNC:
        case reg::SYNC:
        case reg::GO_TO:
        case reg::GO_TO_ZERO:
        case reg::RUN:
        case reg::SEGMENT:
        case reg::PAUSE:
            return "the motor turns, and nothing here stops it";
        case reg::POWER_ON:
            return "the motor is switched on";
        case reg::RESET:
            return "the module starts anew without holding its load";
        case reg::FACTORY:
            return "all parameters are replaced by the factory's, the address too";
        case reg::ADDRESS:
        case reg::BAUD:
            return "the module answers no more as it did";
        default:
            return {};
    }
}

}  // namespace nplc::macreg::midi
