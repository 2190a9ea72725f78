#pragma once

#include <cstdint>

#include "motor/midi_link.h"
#include "ports/serial.h"
#include "protocol/answer_count.h"
#include "protocol/midi_v24.h"

namespace nplc::motor {

/// A MIDI module on a serial line (000 §II to §IV). An answer that is damaged, or comes too late, makes the
/// line fall silent for 5 ms before the next request, so that it is not taken for the answer to that one;
/// only EMERGENCY_STOP (18h) does not wait.
class MidiV24Link final : public MidiLink {
  public:
    struct Settings {
        std::uint8_t address = 0;     ///< 00h..7Fh
        std::uint32_t baud = 38'400;  ///< 9600, 19200 or 38400
    };

    MidiV24Link(ports::SerialPort& port, const Settings& settings);

    void begin(const MidiMessage& message, base::Instant now) override;
    MidiOutcome poll(base::Instant now) override;
    base::Instant next_poll(base::Instant now) const override;
    bool busy() const override { return state_ != State::idle; }
    bool take_boot() override { return false; }
    void withdraw() override;
    BusFault trouble() const override { return answers_.several() ? BusFault::several : BusFault::none; }

  private:
    enum class State : std::uint8_t { idle, waiting_for_quiet, under_way };

    MidiOutcome receive(base::Instant now);
    MidiOutcome finish(MidiOutcome::Kind kind, std::uint32_t value = 0);
    void transmit();
    void note_answer(const ports::ReceivedByte& byte);

    ports::SerialPort& port_;
    std::uint8_t address_;
    std::uint8_t sent_ = 0;
    State state_ = State::idle;
    bool is_urgent_ = false;  ///< 18h, which waits for no silence
    bool noisy_ = false;      ///< an unexpected character was received, or may still arrive
    bool spoilt_ = false;     ///< a framing error since the request
    bool heard_any_ = false;  ///< since the request
    protocol::AnswerCount answers_;
    protocol::midi_v24::AnswerDecoder decoder_;
    base::Instant heard_{};
    base::Instant deadline_{};
    base::Microseconds character_;
    protocol::midi_v24::RequestBytes bytes_;
};

}  // namespace nplc::motor
