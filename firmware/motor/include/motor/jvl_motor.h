#pragma once

#include <cstdint>
#include <optional>

#include "base/ring.h"
#include "motor/jvl_link.h"
#include "motor/motor.h"

namespace nplc::motor {

/// A JVL MAC motor on its FastMAC/FlexMAC port (001 §5.2). Keeps the motor in FastMAC between orders; switches to
/// FlexMAC for register writes. See this folder's README for the rules.
class JvlMotor final : public Motor {
  public:
    struct Settings {
        JvlLink::Settings link;
        bool safe_communication = true;         ///< 0Bh at start; one-byte commands have no other protection
        bool old_register_codes = false;        ///< A 000xx, V 10xxx, P 11xxx, as the example of 001 §5.2.1.5 has it
        bool registers_are_32_bit = false;      ///< MAC800
        base::Microseconds sample_period{1'920};  ///< of the motor's outer loop; MAC800: 1'299
    };

    struct Counters {
        std::uint32_t orders = 0;          ///< executed
        std::uint32_t discarded = 0;       ///< not delivered because the link was not up
        std::uint32_t resent = 0;
        std::uint32_t link_losses = 0;
    };

    JvlMotor(ports::SerialPort& port, const Settings& settings);

    void poll(base::Instant now) override;
    bool settled() const override;
    bool has_room() const override { return !orders_.full(); }
    void send(const Order& order) override;
    void stop() override;
    bool in_position() const override;
    bool error() const override;
    Link link() const override;
    Counters counters() const;

  private:
    enum class Phase : std::uint8_t { down, look, nop_first, nop_second, choose_safety, up };

    void lose_link();
    void on_result(JvlLink::Result result, base::Instant now);
    void accepted(base::Instant now);
    void next_message(base::Instant now);
    void start_up(base::Instant now);
    void work(base::Instant now);
    void send_command(std::uint8_t command, base::Instant now);
    void send_write(const Order& order, base::Instant now);
    std::uint8_t on_the_wire(std::uint8_t command) const;
    void hold_in_position(base::Instant now);
    void update_hold(base::Instant now);

    JvlLink link_;
    Settings settings_;
    base::Ring<Order, 8> orders_;
    std::optional<Order> current_;        ///< order that the outstanding message carries
    std::uint8_t sending_ = 0;            ///< command that the outstanding message carries
    Phase phase_ = Phase::down;
    bool safe_now_ = false;
    bool slow_sent_ = false;
    bool stop_wanted_ = false;
    bool link_error_ = false;
    bool was_up_ = false;
    bool hold_ = false;
    base::Instant hold_until_{};
    std::uint32_t hold_status_count_ = 0;
    Counters counters_;
};

}  // namespace nplc::motor
