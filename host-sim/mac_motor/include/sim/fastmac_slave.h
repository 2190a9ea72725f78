#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "base/time.h"
#include "protocol/fastmac.h"
#include "protocol/flexmac.h"
#include "registers/mac.h"

namespace nplc::sim {

/// Interface of the FastMAC/FlexMAC link to its motor.
class LinkTarget {
  public:
    /// A FastMAC command that concerns the motor, not the link.
    virtual void execute(const protocol::fastmac::Command& command) = 0;
    virtual std::uint32_t read_register(std::uint8_t reg, bool longword) const = 0;
    virtual void write_register(std::uint8_t reg, std::uint32_t value, bool longword) = 0;
    virtual std::uint32_t error_status() const = 0;  ///< ERR_STAT
    virtual void show_framing_error(bool seen) = 0;  ///< FRAME_ERR_TX
    virtual bool in_safe_mode() const = 0;           ///< messages are echoed and do nothing to the motor
    virtual std::uint8_t my_address() const = 0;

  protected:
    ~LinkTarget() = default;
};

/// An accepted order, as the motor interpreted it.
struct Order {
    base::Instant at{};
    bool flexmac = false;
    std::uint8_t command = 0;              ///< FastMAC: bits 6..0
    protocol::flexmac::Message message{};  ///< FlexMAC write
    std::uint8_t reg = 0;   ///< FlexMAC write: the register written, 0 if there is none at the address
    bool effective = true;  ///< false in SAFE_MODE, and for a write to no register
};

/// The motor's end of the user interface set to communication (001 §5.2): takes commands and messages,
/// repeats the status byte, answers reads. All 32 link commands; safe communication and slow transmission;
/// both register codes.
class FastMacSlave {
  public:
    struct Options {
        registers::Model model = registers::Model::mac140;
        std::int32_t baud = 19200;  ///< 8N1
        protocol::fastmac::RegisterCode code = protocol::fastmac::RegisterCode::format_list;
        std::size_t log_limit = 100'000;  ///< the oldest orders are dropped beyond it
    };

    explicit FastMacSlave(const Options& options);

    /// Toggle 0, FastMAC, rapid communication, no pauses. The log is kept.
    void power_up();

    /// A character whose stop bit ended at `now`. A framing error shows until the link is in step again (001
    /// §5.2.1.7): at a good character after an empty one, or a FlexMAC message.
    void receive(std::uint8_t byte, bool framing_error, base::Instant now, LinkTarget& motor);

    /// The next byte to send, polled whenever the transmitter is free; empty during a pause.
    std::optional<std::uint8_t> transmit(base::Instant now, const LinkTarget& motor);

    const std::deque<Order>& orders() const { return orders_; }
    /// Moves them out of the log.
    std::deque<Order> take_orders() { return std::exchange(orders_, {}); }

    bool flexmac() const { return flexmac_; }
    bool safe_communication() const { return receiver_.safe(); }
    bool toggle() const { return receiver_.toggle(); }

  private:
    void show_framing_error(bool seen, LinkTarget& motor);
    void receive_command(std::uint8_t byte, base::Instant now, LinkTarget& motor);
    bool execute_on_link(protocol::fastmac::Number number);
    void receive_message(const protocol::flexmac::Message& message, base::Instant now, LinkTarget& motor);
    bool takes(const protocol::flexmac::Message& message) const;
    std::uint8_t register_of(const protocol::flexmac::Message& message) const;
    void reply(const protocol::flexmac::Message& request, const LinkTarget& motor);
    std::uint8_t next_byte(const LinkTarget& motor);
    std::uint8_t status_byte(const LinkTarget& motor) const;
    void log(const Order& order);
    base::Microseconds bits(int count) const;

    Options options_;
    protocol::fastmac::CommandReceiver receiver_;
    protocol::flexmac::RequestDecoder decoder_;
    bool flexmac_ = false;
    bool slow_ = false;
    bool framing_error_ = false;
    std::optional<base::Instant> last_received_;
    std::optional<base::Instant> pause_until_;
    std::deque<std::uint8_t> reply_;
    std::optional<int> address_due_in_;  // status bytes until MYADDR
    std::deque<Order> orders_;
};

}  // namespace nplc::sim
