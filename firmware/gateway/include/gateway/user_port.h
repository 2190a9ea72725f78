#pragma once

#include <cstdint>
#include <optional>

#include "gateway/gateway_registers.h"
#include "gateway/modbus_slave.h"
#include "gateway/motor_bridge.h"
#include "ports/serial.h"
#include "protocol/mactalk.h"
#include "registers/mac.h"

namespace nplc::gateway {

/// The user port: MacTalk (001 §5.1) for the gateway's own address (REGISTERS.md), and for the motor's
/// address and 255, which are answered as the motor would. One message at a time; a new one ends the wait for
/// the answer to the one before. Refused messages get no answer.
class UserPort {
  public:
    /// `request` is MODE_REG := 0 (passive) to the motor, which is a stop command too.
    static constexpr bool is_stop(const protocol::mactalk::Request& request) {
        return request.kind == protocol::mactalk::Kind::write && request.reg == registers::MODE_REG &&
               request.length <= 4 && request.value == 0;
    }

    /// `line`: null where messages come decoded through submit(), or there is no user port. `motor_line`: the
    /// motor's own MacTalk port for messages that FlexMAC cannot carry; null if not wired.
    UserPort(ports::SerialPort* line, ports::SerialPort* motor_line, Gateway& gateway, motor::Motor& motor,
             GatewayRegisters& own, SettingsManager& settings)
        : line_(line),
          motor_line_(motor_line),
          gateway_(gateway),
          own_(own),
          settings_(settings),
          bridge_(motor),
          modbus_(gateway, own) {}

    /// To be called after Gateway::poll and GatewayRegisters::poll.
    void poll(base::Instant now);
    /// Latest time of the next poll if nothing arrives on either line.
    base::Instant next_poll(base::Instant now);

    /// Takes a decoded message instead of one from the line; ends the wait for the answer to the one before.
    /// `data`: of a write. The caller decides whether the message is allowed, except for the checks made for
    /// a message on a line.
    void submit(const protocol::mactalk::Request& request, std::span<const std::uint8_t> data,
                base::Instant now);
    /// Replaces poll(), which does nothing without a line.
    void serve(base::Instant now) { go_on(now); }
    /// After serve(): the encoded answer since the last call. A message that is no longer served and has no
    /// answer was refused.
    std::span<const std::uint8_t> take_reply();
    bool is_serving() const { return serving_ != Serving::nothing; }

    /// For other users of the gateway and the motor: what a client waits for here, and whether the gateway
    /// would carry a message to the motor now.
    bool awaits_own_write() const { return serving_ == Serving::own_write; }
    bool awaits_motor() const { return serving_ == Serving::motor; }
    /// The motor's access is open for a message here, or its result has not been taken yet.
    bool accesses_motor() const { return awaits_motor() && bridge_.is_accessing(); }
    bool motor_allows(const protocol::mactalk::Request& request) const;
    /// For a stop from another port, which takes precedence.
    void cancel_own_write();

  private:
    enum class Serving : std::uint8_t { nothing, own_write, set_points, motor, motor_line };

    void receive(base::Instant now);
    void begin(const protocol::mactalk::Request& request, base::Instant now);
    void begin_modbus(base::Instant now);
    void begin_own(const protocol::mactalk::Request& request, base::Instant now);
    void begin_motor(const protocol::mactalk::Request& request, base::Instant now);
    bool is_for_motor(std::uint8_t address) const;
    void pass_on(base::Instant now);
    void drop();
    void go_on(base::Instant now);
    void serve_motor(base::Instant now);
    base::Milliseconds read_pause() const;
    void pass_back(base::Instant now);
    void refuse();
    void answer(const protocol::mactalk::EncodedReply& reply);
    void transmit(base::Instant now);
    void transmit_to_motor();

    ports::SerialPort* line_;
    ports::SerialPort* motor_line_;
    Gateway& gateway_;
    GatewayRegisters& own_;
    SettingsManager& settings_;

    // Small members first: see Gateway.
    Serving serving_ = Serving::nothing;
    bool is_modbus_ = false;  ///< the message being served is Modbus
    MotorBridge bridge_;
    std::size_t sent_ = 0;
    std::size_t passed_sent_ = 0;
    std::size_t data_size_ = 0;
    base::Instant begun_{};
    [[no_unique_address]] SetPointsPart::Writer set_points_;
    [[no_unique_address]] ModbusPart modbus_;  ///< if the firmware supports it
    protocol::mactalk::RequestDecoder decoder_;
    protocol::mactalk::EncodedReply out_;
    std::array<std::uint8_t, protocol::mactalk::kBareRequestBytes> passed_;
    /// The data of a write in progress; the decoder may already receive the next message.
    std::array<std::uint8_t, protocol::mactalk::kMaxLongWrite> data_;
};

}  // namespace nplc::gateway
