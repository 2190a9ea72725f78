#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/time.h"
#include "motor/jvl_echo_time.h"
#include "motor/status_filter.h"
#include "ports/serial.h"
#include "protocol/flexmac.h"

namespace nplc::motor {

/// One message at a time to a JVL motor, until the motor's status bytes show that it was accepted (001 §5.2).
/// A message is sent again only on proof that the motor did not accept it.
class JvlLink {
  public:
    struct Settings {
        std::uint32_t baud = 19'200;
        base::Microseconds silence{20'000};  ///< without a status byte, or without a poll, for this time and
                                             ///< the echo delay: link lost
        /// Timeout for the echo of a FlexMAC message or a protocol change, which would act twice if repeated,
        /// beyond the measured echo time; EchoTime::kPatience at the least where none is measured.
        base::Microseconds proof_time{20'000};
    };

    enum class Result : std::uint8_t {
        none,
        accepted,
        refused,  ///< not accepted after all resends, or longest_message passed, or accepted too late
        silent,
        out_of_step,  ///< the motor's toggle or protocol is not what the last message left
    };

    JvlLink(ports::SerialPort& port, const Settings& settings);

    Result poll(base::Instant now);
    /// Latest time of the next poll() if nothing arrives.
    base::Instant next_poll(base::Instant now) const;

    bool busy() const { return expect_ != Expect::nothing; }
    /// The last message, if any, has left the transmitter.
    bool has_left() const { return size_ == 0 || on_the_line_; }
    /// The time when it had left.
    base::Instant left_at() const { return left_at_; }
    base::Microseconds silence() const { return settings_.silence; }
    /// `copies`: 2 for safe communication.
    void send_command(std::uint8_t command, int copies, base::Instant now);
    void send_flexmac(const protocol::flexmac::Message& message, base::Instant now);
    /// Accepted like every message; the answer may come before or after that, see take_reply().
    void send_read(const protocol::flexmac::Message& request, base::Instant now);
    /// The answer to the last send_read(); returned once.
    std::optional<std::uint32_t> take_reply();
    /// 7Eh three times; done when status bit 3 is clear; the toggle is then read again.
    void leave_flexmac(base::Instant now);
    /// Sends bytes without expecting an answer.
    void send_blind(std::span<const std::uint8_t> bytes, base::Instant now);

    /// Takes over the motor's present toggle and protocol; needs known().
    void synchronize();
    /// Drops the message in progress and all link state; the next two equal status bytes start again.
    void forget(base::Instant now);

    bool known() const { return filter_.known(); }
    const protocol::fastmac::Status& status() const { return filter_.status(); }
    bool toggle() const { return toggle_; }
    bool flexmac() const { return flexmac_; }
    /// Number of pairs of equal status bytes received.
    std::uint32_t confirmed() const { return filter_.confirmed(); }
    std::uint32_t resent() const { return resent_; }
    /// From the end of a message to the second byte of its echo, slowly decreasing maximum; 0: not measured
    /// yet.
    base::Microseconds echo_time() const {
        return echo_.was_known() ? echo_.measured() + kEchoCharacters * character_ : base::Microseconds(0);
    }
    base::Microseconds late_by() const { return echo_.at_most(); }
    /// It was given up because its echoes came later than EchoTime::kMost.
    bool was_too_late() const { return echo_.was_too_late(); }
    base::Microseconds character() const { return character_; }
    bool framing_error_seen() const { return framing_seen_; }
    void clear_framing_error() { framing_seen_ = false; }

  private:
    static constexpr int kEchoCharacters = 3;  ///< the one being sent, and two equal ones

    enum class Expect : std::uint8_t { nothing, toggle, enter_flexmac, leave_flexmac };

    struct Listening {
        base::Instant polled{};
        base::Microseconds heard{};  ///< line time of the characters read in this poll
        bool too_late = false;       ///< no poll for longer than longest_silence()
    };

    void start(std::span<const std::uint8_t> bytes, Expect expect, base::Instant now);
    void rewind(base::Instant now);
    void transmit(base::Instant now);
    void receive(base::Instant now);
    void read_all(base::Instant now);
    void on_byte(std::uint8_t byte, base::Instant now);
    void on_reply(const protocol::flexmac::Message& reply);
    void on_status(std::uint8_t byte, base::Instant now);
    bool shows_old(const protocol::fastmac::Status& seen) const;
    bool echo_was_false() const;
    bool is_done() const;
    void settle(base::Instant now);
    bool in_step(const protocol::fastmac::Status& seen) const;
    Result judge(base::Instant now);
    Result judge_message(base::Instant now);
    base::Microseconds patience() const;
    base::Microseconds longest_silence() const { return settings_.silence + echo_.at_most(); }
    bool repeat_is_harmless() const { return expect_ == Expect::toggle && size_ <= 2; }

    // Small members first: see JvlMotor.
    std::uint8_t size_ = 0;
    std::uint8_t sent_ = 0;
    std::uint8_t resends_ = 0;
    Expect expect_ = Expect::nothing;
    bool on_the_line_ = false;           ///< the last byte has left
    std::uint8_t stale_count_ = 0;       ///< status bytes in a row that show the message was not accepted
    std::uint8_t unexpected_count_ = 0;  ///< status bytes in a row that no message explains
    bool accepted_ = false;
    bool reads_ = false;  ///< the answer to request_ is pending
    bool synchronized_ = false;
    bool toggle_ = false;
    bool flexmac_ = false;
    bool framing_seen_ = false;
    ports::SerialPort& port_;
    StatusFilter filter_;
    protocol::flexmac::Message request_;
    std::optional<std::uint32_t> reply_;
    base::Instant next_byte_{};
    base::Instant line_free_{};  ///< earliest end of transmission, whatever the port reports
    base::Instant left_at_{};    ///< when the last byte had left the transmitter, or the message was echoed
    base::Instant started_{};
    base::Instant last_status_{};
    Listening listening_;
    std::uint32_t resent_ = 0;
    Settings settings_;
    base::Microseconds character_;
    EchoTime echo_;
    protocol::flexmac::ReplyDecoder replies_;
    std::array<std::uint8_t, protocol::flexmac::kMaxBytes> message_;
};

}  // namespace nplc::motor
