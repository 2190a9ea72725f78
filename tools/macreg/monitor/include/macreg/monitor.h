#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/time.h"
#include "protocol/fastmac.h"
#include "registers/mac.h"
#include "registers/midi.h"

/// What passes on a line between a master and motors, in lines for people. Only listens.
/// What registers and bytes are called in lines for people.
namespace nplc::macreg {

/// Whose bytes a stream holds.
enum class Side : std::uint8_t { both, master, motor };

struct MonitorEvent {
    base::Instant at{};
    std::string request{};  ///< "motor 254: read P_IST (10)"
    std::string answer{};   ///< "00001234 = 4660 counts", "accepted", "no answer"
    std::string flaw{};     ///< what is wrong with the bytes
    std::vector<std::uint8_t> sent{};
    std::vector<std::uint8_t> received{};
    std::optional<std::uint8_t> address{};
    std::optional<std::uint8_t> reg{};
    std::optional<std::uint32_t> value{};  ///< read or written, as it went over the line
};

/// "12.034 s  -> motor 254: read P_IST (10)   <- 00001234 = 4660 counts"
std::string line_of(const MonitorEvent& event, base::Instant start);

class Monitor {
  public:
    virtual ~Monitor() = default;
    virtual void receive(Side side, std::uint8_t byte, base::Instant at) = 0;
    /// A character with a framing error.
    virtual void framing_error(Side side, base::Instant at) = 0;
    /// Nothing came until now: what waits too long is told.
    virtual void pass(base::Instant now) = 0;
    /// The end of the line: whatever is under way is told.
    virtual void finish() = 0;
    /// In the order in which they are complete: a request with its answer, what came meanwhile before it.
    std::vector<MonitorEvent> take() { return std::exchange(events_, {}); }
    /// Since when something is under way: no event that is still to come is older.
    virtual std::optional<base::Instant> since() const = 0;

  protected:
    void tell(MonitorEvent event) { events_.push_back(std::move(event)); }
    void tell_framing_error(base::Instant at) {
        tell({.at = at, .flaw = "a character with a framing error: is the speed right?"});
    }

  private:
    std::vector<MonitorEvent> events_;
};

/// What a monitor tells, by the time: an event waits until no older one can come.
class InOrder {
  public:
    std::vector<MonitorEvent> take(Monitor& monitor);

  private:
    std::vector<MonitorEvent> waiting_;
};

struct MonitorOptions {
    registers::Model model = registers::Model::mac140;
    /// Whose register numbers mean the gateway's own map; 0: nobody's.
    std::uint8_t gateway = 0;
    std::uint32_t baud = 19'200;
    base::Microseconds longest_answer{1'000'000};
    protocol::fastmac::RegisterCode code = protocol::fastmac::RegisterCode::format_list;
};

/// 001 §5.1. Requests and answers may come in one stream (a two-wire line) or in one each.
std::unique_ptr<Monitor> make_mactalk_monitor(const MonitorOptions& options);

/// 001 §5.2. The two directions have a pair of wires each, so every stream is the master's or the motor's;
/// `both` is taken for the master's. Status bytes are told when they change. Which protocol the motor expects
/// is known from the commands seen; a listener who came later follows at the next switch.
std::unique_ptr<Monitor> make_fastmac_monitor(const MonitorOptions& options);

struct MidiMonitorOptions {
    std::optional<registers::midi::Model> model{};  ///< for turns; without it increments
    std::uint32_t baud = registers::midi::kFactoryBaud;
    base::Microseconds longest_answer{150'000};  ///< beyond the line's time
};

/// MIDI Ingenierie's serial line (000 §II to §IV). Requests and answers may come in one stream or in one
/// each. An answer to a command carries no address: it is paired with the last request.
std::unique_ptr<Monitor> make_midi_monitor(const MidiMonitorOptions& options);

/// "P_IST (10)"; "upper word of P_IST (11)", "register 200" for numbers that are no register's own.
std::string register_words(registers::Model model, std::uint8_t number);

/// The value of a register read or written with so many bytes: "00001234 = 4660 counts", "0002 = P_MODE". The
/// bytes beyond the register's own width are left out.
std::string bytes_words(registers::Model model, std::uint8_t number, std::uint32_t value, std::size_t bytes);

/// "50 50 50 08 F7"
std::string hex_words(std::span<const std::uint8_t> bytes);

}  // namespace nplc::macreg
