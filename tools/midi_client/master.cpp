#include "midi_client/master.h"

#include <fmt/format.h>

#include <algorithm>

namespace nplc::midi_client {

namespace midi = registers::midi;
using Kind = Answer::Kind;

namespace {

constexpr base::Microseconds kLook{50'000};
constexpr unsigned kLooks = 3;
/// In which a second module would have answered too (R: in no manual).
constexpr base::Microseconds kOthersAnswer{150'000};

std::string command_name(std::uint8_t number) {
    const midi::CommandRow* row = midi::find_command(number);
    return row != nullptr ? std::string(row->name) : fmt::format("command {:02X}h", number);
}

[[noreturn]] void same_address(const Link& link, std::uint8_t address) {
    throw SameAddress(fmt::format(
        "{}: more than one module answers to address {}, and what moves one moves both: leave one "
        "of them connected, give it an address of its own ({}), then connect the other again",
        link.name(), address,
        link.is_can() ? "`macreg midi address set NEW`"
                      : fmt::format("`macreg midi --address {} address set NEW`", address)));
}

}  // namespace

std::uint32_t Master::query(std::uint8_t address, midi::Query query, std::uint8_t sub_index) {
    bool heard = false;
    unsigned refused = 0;
    unsigned damaged = 0;
    for (unsigned i = 0; i < attempts_; ++i) {
        const Answer answer =
            link_.ask({.address = address, .query = true, .number = query, .sub_index = sub_index});
        look_at_answers(address);
        if (answer.kind == Kind::value) {
            answered_ = true;
            return answer.value;
        }
        // Twice, for a damaged answer may look like a refusal.
        if (answer.kind == Kind::refused && refused++ > 0)
            throw Refused(fmt::format(
                "address {} answers and refuses {}{}", address, midi::find_query(query)->name,
                query == midi::GET_RAM ? "; it does not know it"
                                       : ", which no MIDI module does: is it another kind of device?"));
        heard = heard || answer.kind != Kind::silence;
        damaged += answer.kind == Kind::not_taken ? 1 : 0;
    }
    if (damaged == attempts_) came_damaged(address, midi::find_query(query)->name);
    no_answer(address, attempts_, heard);
}

Answer Master::try_query(std::uint8_t address, midi::Query query) {
    return link_.ask({.address = address, .query = true, .number = query});
}

std::uint32_t Master::expect_alone(std::uint8_t address) {
    for (unsigned i = 0; i < kLooks; ++i) {
        const std::uint32_t release = query(address, midi::GET_RELEASE);
        link_.pause(kOthersAnswer);
        if (!link_.answers(address).surplus()) return release;
    }
    same_address(link_, address);
}

void Master::look_at_answers(std::uint8_t address) const {
    if (link_.answers(address).several()) same_address(link_, address);
}

void Master::command(std::uint8_t address, midi::Command command, std::uint32_t data) {
    const Answer answer = try_command(address, command, data);
    if (answer.kind == Kind::accepted) return;
    const std::string name = command_name(command);
    if (answer.kind == Kind::refused)
        throw Refused(fmt::format("address {} refuses {}", address, name), answer.by_18h);
    if (answer.kind == Kind::not_taken) came_damaged(address, name);
    if (!answered_ && answer.kind == Kind::silence)
        no_answer(address, is_stop(command) ? attempts_ : 1, false);
    throw Unconfirmed(
        fmt::format("{}: no clear answer to {} from address {}: it may have been carried out or not",
                    link_.name(), name, address));
}

Answer Master::try_command(std::uint8_t address, midi::Command command, std::uint32_t data) {
    return try_request({.address = address, .number = command, .data = data});
}

Answer Master::try_request(const Request& request) {
    Answer answer;
    for (unsigned i = 0; i < attempts_; ++i) {
        answer = link_.ask(request);
        if (!is_stop(request.number) || request.query) look_at_answers(request.address);
        const bool told =
            answer.kind == Kind::accepted || answer.kind == Kind::value || answer.kind == Kind::refused;
        if (told) answered_ = true;
        const bool again =
            answer.kind == Kind::not_taken || (!told && (request.query || is_stop(request.number)));
        if (!again) break;
    }
    return answer;
}

std::int32_t Master::position(std::uint8_t address) {
    return static_cast<std::int32_t>(query(address, midi::GET_POSITION));
}

std::uint32_t Master::status(std::uint8_t address) {
    return query(address, midi::GET_STATUS);
}

bool Master::busy(std::uint8_t address) {
    return (query(address, midi::GET_MEASURES) & midi::kNotBusy) == 0;
}

std::vector<std::uint8_t> Master::stop_hard(std::span<const std::uint8_t> addresses) {
    std::vector<std::uint8_t> failed;
    for (const std::uint8_t address : addresses) {
        bool stopped = false;
        try {
            stopped = try_command(address, midi::EMERGENCY_STOP).kind == Kind::accepted;
        } catch (const LineError&) {  // the port is gone; the others are tried all the same
        }
        if (!stopped) failed.push_back(address);
    }
    return failed;
}

void Master::pause(base::Microseconds time, const std::function<bool()>& goes_on) {
    const base::Instant end = link_.now() + time;
    for (base::Instant now = link_.now(); now < end; now = link_.now()) {
        if (goes_on && !goes_on()) throw Interrupted("interrupted");
        link_.pause(std::min<base::Microseconds>(kLook, end - now));
    }
}

void Master::came_damaged(std::uint8_t address, std::string_view name) const {
    throw LineError(LineError::Kind::no_answer,
                    fmt::format("{}: address {} says that {} came damaged, {} times; it was not carried "
                                "out: check wiring, shield and ground of the line",
                                link_.name(), address, name, attempts_));
}

void Master::no_answer(std::uint8_t address, unsigned asked, bool heard) const {
    const std::string why =
        answered_ ? "others were answered: was it switched off or unplugged, or has the line noise?"
        : heard   ? "bytes came that are no answer: is the speed right, or do two modules have this address?"
        : link_.is_can()
            ? "is it switched on, and are address and bit rate right? `macreg midi find` asks all addresses"
            : "is it switched on, and are address and speed right? `macreg midi find` asks all addresses";
    throw LineError(LineError::Kind::no_answer,
                    fmt::format("{}: no answer from address {}, asked {} time{}; {}", link_.name(), address,
                                asked, asked == 1 ? "" : "s", why));
}

}  // namespace nplc::midi_client
