#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "gateway/gateway_registers.h"
#include "protocol/mactalk.h"
#include "protocol/modbus_rtu.h"

namespace nplc::gateway {

#ifndef NPLC_MODBUS
#define NPLC_MODBUS 0
#endif

/// Finds writes of stop, safe and hold in the characters of a line, wherever they begin. Up to four registers
/// from `command` on.
class StopFinder {
  public:
    /// True: a write for `unit` or for all ends with this character.
    bool take(std::uint8_t byte, std::uint8_t unit);
    /// Its command, once; 0: none.
    std::uint8_t take_command() { return std::exchange(command_, std::uint8_t{0}); }

  private:
    std::array<std::uint8_t, 17> last_{};
    std::uint8_t command_ = 0;
};

/// Modbus RTU on the user port of a board without an operating system, beside MacTalk: a request is answered
/// in the protocol it was sent in. The slave address is the setting gateway_address; the register map is that
/// of all boards (registers/modbus_map.h), without scaled values and set-points. A stop, safe or hold is
/// found in whatever it is behind, and as a broadcast; then it is carried out without an answer. Does no I/O.
class ModbusSlave {
  public:
    explicit ModbusSlave(Gateway& gateway, GatewayRegisters& own) : gateway_(gateway), own_(own) {}

    /// Takes a received character. True: a request for `unit` is complete, and begin() must be called. A
    /// frame for another slave ends the wait for an answer.
    bool take(std::uint8_t byte, std::uint8_t unit, base::Instant now);
    /// The received characters were a MacTalk message: discards them.
    void pass_over() { static_cast<void>(reader_.silence()); }
    /// A character was damaged or lost.
    void damaged(base::Instant now);
    /// Detects the silence that ends a frame. True: as take(), for a request of unknown length.
    bool poll(std::uint8_t unit, base::Instant now, std::uint32_t baud);

    /// What a request needs before it is answered.
    enum class Need : std::uint8_t {
        nothing,  ///< out() has the answer, or there is none
        own_write,
        motor,
    };
    Need begin(base::Instant now);
    /// For Need::own_write: register and value.
    std::uint8_t reg() const { return reg_; }
    std::uint32_t value() const { return value_; }
    /// For Need::motor: the equivalent MacTalk request.
    const protocol::mactalk::Request& motor_request() const { return motor_; }

    void end_write(const PendingResult& outcome);
    void end_motor(std::span<const std::uint8_t> data);
    /// The request was not carried out: answers with the exception for `result`.
    void refuse(Result result);
    /// Discards the answer, because another message came or it was sent.
    void drop() { size_ = sent_ = 0; }

    /// The part of the answer still to send; empty at `now` while the silence between frames has not passed.
    std::span<const std::uint8_t> out(base::Instant now, std::uint32_t baud) const;
    void note_sent(std::size_t count) { sent_ += count; }
    bool has_out() const { return sent_ < size_; }

  private:
    using Request = protocol::modbus::Request;
    using Exception = protocol::modbus::Exception;

    void begin_answer(std::uint8_t function);
    void put(std::uint8_t byte) { out_[size_++] = byte; }
    void put_word(std::uint16_t word);
    Need end_answer();
    Need refuse_with(Exception exception);
    Need echo();
    Need read(base::Instant now);
    std::uint32_t own(std::uint8_t reg, base::Instant now);
    std::uint16_t status_bits(base::Instant now);
    std::uint16_t input_word(std::uint16_t address, base::Instant now);
    std::uint16_t holding_word(std::uint16_t address, base::Instant now);
    std::uint16_t event_word(std::uint16_t address, base::Instant now);
    Need write_coils(std::uint8_t stop);
    Need write_holding(std::uint8_t stop, base::Instant now);
    Need use_window();
    Need ask_motor(bool writes, std::uint8_t number, std::uint32_t value);
    Need command(std::uint16_t value);
    Need write_own(std::uint8_t reg, std::uint32_t value);

    Gateway& gateway_;
    GatewayRegisters& own_;
    protocol::modbus::RtuReader reader_;
    Request request_;
    std::uint8_t unit_ = protocol::modbus::kBroadcast;  ///< who asked; kBroadcast: nobody to be answered
    enum class Kind : std::uint8_t {
        plain,
        handshake,
        found,  ///< a stop out of order: carried out without an answer
    } kind_ = Kind::plain;
    base::Instant heard_{};
    StopFinder finder_;

    // As in firmware/faces/modbus: a command is accepted only after a 0 was written.
    bool is_armed_ = false;
    struct Coils {
        std::uint8_t on = 0;
        std::uint8_t were_off = 0;
    } coils_;
    std::uint16_t command_ = 0;
    std::uint16_t number_ = 0;
    std::uint16_t done_number_ = 0;
    std::uint16_t result_ = 0;
    std::uint16_t detail_ = 0;
    std::uint32_t acknowledged_ = 0;

    std::uint8_t reg_ = 0;
    std::uint32_t value_ = 0;
    protocol::mactalk::Request motor_;

    std::size_t size_ = 0;
    std::size_t sent_ = 0;
    std::array<std::uint8_t, protocol::modbus::kMostFrame> out_;
};

/// Replaces ModbusSlave in a firmware without Modbus.
struct NoModbusSlave {
    using Need = ModbusSlave::Need;
    NoModbusSlave(Gateway&, GatewayRegisters&) {}
    static constexpr bool take(std::uint8_t, std::uint8_t, base::Instant) { return false; }
    static void pass_over() {}
    static void damaged(base::Instant) {}
    static constexpr bool poll(std::uint8_t, base::Instant, std::uint32_t) { return false; }
    static constexpr Need begin(base::Instant) { return Need::nothing; }
    static constexpr std::uint8_t reg() { return 0; }
    static constexpr std::uint32_t value() { return 0; }
    static protocol::mactalk::Request motor_request() { return {}; }
    static void end_write(const PendingResult&) {}
    static void end_motor(std::span<const std::uint8_t>) {}
    static void refuse(Result) {}
    static void drop() {}
    static constexpr std::span<const std::uint8_t> out(base::Instant, std::uint32_t) { return {}; }
    static void note_sent(std::size_t) {}
    static constexpr bool has_out() { return false; }
};

#if NPLC_MODBUS
using ModbusPart = ModbusSlave;
#else
using ModbusPart = NoModbusSlave;
#endif

}  // namespace nplc::gateway
