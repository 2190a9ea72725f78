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

/// Decodes the traffic between a master and motors into readable lines. Passive: it only listens. Also the
/// names of registers and bytes in these lines.
namespace nplc::macreg {

/// Which side's bytes a stream carries.
enum class Side : std::uint8_t { both, master, motor };

struct MonitorEvent {
    base::Instant at{};
    std::string request{};  ///< "motor 254: read P_IST (10)"
    std::string answer{};   ///< "00001234 = 4660 counts", "accepted", "no answer"
    std::string flaw{};     ///< the error in the bytes
    std::vector<std::uint8_t> sent{};
    std::vector<std::uint8_t> received{};
    std::optional<std::uint8_t> address{};
    std::optional<std::uint8_t> reg{};
    std::optional<std::uint32_t> value{};  ///< read or written, as transmitted on the line
};

/// "12.034 s  -> motor 254: read P_IST (10)   <- 00001234 = 4660 counts"
std::string line_of(const MonitorEvent& event, base::Instant start);

class Monitor {
  public:
    virtual ~Monitor() = default;
    virtual void receive(Side side, std::uint8_t byte, base::Instant at) = 0;
    /// A character with a framing error.
    virtual void framing_error(Side side, base::Instant at) = 0;
    /// No byte was received until now: a pending message that has timed out is reported.
    virtual void pass(base::Instant now) = 0;
    /// The end of the line: any pending message is reported.
    virtual void finish() = 0;
    /// In the order of completion: a request with its answer, after what came meanwhile.
    std::vector<MonitorEvent> take() { return std::exchange(events_, {}); }
    /// Start of the pending message: no later event is older.
    virtual std::optional<base::Instant> since() const = 0;

  protected:
    void tell(MonitorEvent event) { events_.push_back(std::move(event)); }
    void tell_framing_error(base::Instant at) {
        tell({.at = at, .flaw = "a character with a framing error: is the speed right?"});
    }

  private:
    std::vector<MonitorEvent> events_;
};

/// Sorts the events of monitors by time: an event is held until no older one can come.
class InOrder {
  public:
    std::vector<MonitorEvent> take(Monitor& monitor);

  private:
    std::vector<MonitorEvent> waiting_;
};

struct MonitorOptions {
    registers::Model model = registers::Model::mac140;
    /// The address of the gateway, whose own register map applies; 0: none.
    std::uint8_t gateway = 0;
    std::uint32_t baud = 19'200;
    base::Microseconds longest_answer{1'000'000};
    protocol::fastmac::RegisterCode code = protocol::fastmac::RegisterCode::format_list;
};

/// 001 §5.1. Requests and answers may come in one stream (a two-wire line) or in one each.
std::unique_ptr<Monitor> make_mactalk_monitor(const MonitorOptions& options);

/// 001 §5.2. Each direction has its own pair of wires, so a stream is the master's or the motor's; `both` is
/// treated as the master's. Status bytes are reported when they change. The protocol that the motor expects
/// is derived from the commands seen; a monitor that starts later synchronises at the next switch.
std::unique_ptr<Monitor> make_fastmac_monitor(const MonitorOptions& options);

struct MidiMonitorOptions {
    std::optional<registers::midi::Model> model{};  ///< for turns; without it increments
    std::uint32_t baud = registers::midi::kFactoryBaud;
    base::Microseconds longest_answer{150'000};  ///< in addition to the transmission time
};

/// MIDI Ingenierie's serial line (000 §II to §IV). Requests and answers may come in one stream or in one
/// each. An answer to a command has no address: it is paired with the last request.
std::unique_ptr<Monitor> make_midi_monitor(const MidiMonitorOptions& options);

/// "P_IST (10)"; "upper word of P_IST (11)", "register 200" for numbers that are no register's own.
std::string register_words(registers::Model model, std::uint8_t number);

/// The value of a register read or written with so many bits: "00001234 = 4660 counts", "0002 = P_MODE".
/// Bytes beyond the register's own width are left out.
std::string bytes_words(registers::Model model, std::uint8_t number, std::uint32_t value, std::size_t bytes);

/// "50 50 50 08 F7"
std::string hex_words(std::span<const std::uint8_t> bytes);

}  // namespace nplc::macreg
