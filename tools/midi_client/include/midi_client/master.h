#pragma once

#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "midi_client/link.h"
#include "registers/midi.h"

namespace nplc::midi_client {

/// The module understood the command and refused it.
class Refused : public mactalk_client::EndedWith<mactalk_client::kRefused> {
  public:
    explicit Refused(const std::string& what, bool by_18h = false) : EndedWith(what), by_18h_(by_18h) {}
    /// It may nevertheless have been carried out: see Answer::by_18h.
    bool by_18h() const { return by_18h_; }

  private:
    bool by_18h_;
};

/// It is unknown whether the module carried out the command.
class Unconfirmed : public mactalk_client::EndedWith<mactalk_client::kNoAnswer> {
    using EndedWith::EndedWith;
};

/// More than one module answers to an address: a motion command moves both, and readings are of either.
class SameAddress : public mactalk_client::EndedWith<mactalk_client::kRefused> {
    using EndedWith::EndedWith;
};

/// A master of MIDI modules (000, 003). Repeats requests, up to `attempts` times, where that can do no harm:
/// queries, commands that a module did not understand, and stops. Throws LineError and SameAddress, too.
class Master {
  public:
    explicit Master(Link& link, unsigned attempts = 10) : link_(link), attempts_(attempts) {}

    Link& link() { return link_; }

    std::uint32_t query(std::uint8_t address, registers::midi::Query query, std::uint8_t sub_index = 0);
    /// The same, requested once: for scans. nullopt without an answer.
    Answer try_query(std::uint8_t address, registers::midi::Query query);

    /// Before a motion: sends a request, and waits for a second module's answer. Returns GET_RELEASE's value.
    /// Throws SameAddress.
    std::uint32_t expect_alone(std::uint8_t address);

    /// Throws Refused, Unconfirmed.
    void command(std::uint8_t address, registers::midi::Command command, std::uint32_t data = 0);
    /// The last answer; `not_taken` only after `attempts` of it.
    Answer try_command(std::uint8_t address, registers::midi::Command command, std::uint32_t data = 0);
    Answer try_request(const Request& request);

    std::int32_t position(std::uint8_t address);
    std::uint32_t status(std::uint8_t address);
    /// The target has not been reached yet, or the module cannot follow (the BUSY output).
    bool busy(std::uint8_t address);

    /// EMERGENCY_STOP to each until accepted; returns the addresses that did not accept.
    std::vector<std::uint8_t> stop_hard(std::span<const std::uint8_t> addresses);
    /// Sleeps in steps while `goes_on` returns true; throws Interrupted.
    void pause(base::Microseconds time, const std::function<bool()>& goes_on);

  private:
    void look_at_answers(std::uint8_t address) const;
    [[noreturn]] void came_damaged(std::uint8_t address, std::string_view name) const;
    [[noreturn]] void no_answer(std::uint8_t address, unsigned asked, bool heard) const;

    Link& link_;
    unsigned attempts_;
    bool answered_ = false;
};

/// May be repeated without harm, and must not be lost.
constexpr bool is_stop(std::uint8_t command) {
    using namespace registers::midi;
    return command == STOP || command == EMERGENCY_STOP || command == POWER_OFF;
}

}  // namespace nplc::midi_client
