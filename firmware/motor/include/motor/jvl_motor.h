#pragma once

#include <cstdint>
#include <optional>

#include "motor/access_slot.h"
#include "motor/jvl_blind_stop.h"
#include "motor/jvl_link.h"
#include "motor/motor.h"
#include "motor/order_queue.h"

namespace nplc::motor {

/// A JVL MAC motor on its FastMAC/FlexMAC port (001 §5.2). Keeps the motor in FastMAC between orders;
/// switches to FlexMAC for register writes. The rules are in this folder's README.
class JvlMotor final : public Motor {
  public:
    struct Settings {
        JvlLink::Settings link{};
        bool safe_communication = true;  ///< 0Bh at start; one-byte commands have no other protection
        /// `older_example`: the coding in the example of 001 §5.2.1.5.
        protocol::fastmac::RegisterCode register_code = protocol::fastmac::RegisterCode::format_list;
        bool registers_are_32_bit = false;        ///< MAC800
        base::Microseconds sample_period{1'920};  ///< of the motor's outer loop; MAC800: 1'299
    };

    JvlMotor(ports::SerialPort& port, const Settings& settings);

    void poll(base::Instant now) override;
    void begin_orders(base::Instant now) override;
    /// Latest time of the next poll, to be asked after each poll() and each call that gives the driver work;
    /// `now` or earlier: at once.
    base::Instant next_poll(base::Instant now) const;
    bool orders_complete() const override;
    bool has_room() const override { return !orders_.full(); }
    void send(const Order& order) override { orders_.push(order, is_up()); }
    bool can_execute(const Order& order) const override;
    void stop() override;
    bool stop_confirmed() const override { return stop_ == Stop::confirmed; }
    void give_up_stop() override { stop_ = Stop::confirmed; }
    bool begin_access(const Access& access) override { return is_up() && access_.begin(access); }
    AccessState access_state() const override { return access_.state(); }
    std::uint32_t access_value() const override { return access_.value(); }
    void drop_access() override { access_.drop(); }
    bool in_position() const override;
    bool error() const override;
    Link link() const override;
    std::uint32_t resent() const { return link_.resent(); }
    Counters counters() const override;
    bool longwords_only() const override { return registers_are_32_bit_; }
    base::Microseconds echo_time() const override { return link_.echo_time(); }
    /// The last link was lost because its echoes came too late.
    bool was_too_late() const { return link_.was_too_late(); }

  private:
    enum class Phase : std::uint8_t { down, look, first_safety, second_safety, first_nop, second_nop, up };
    enum class Sending : std::uint8_t { nothing, start_up, link_command, order, stop, access };

    /// Unproven: its echo is, until FlexMAC has been left without a contradiction.
    enum class Stop : std::uint8_t { confirmed, unproven, wanted };

    bool wants_stop() const { return stop_ == Stop::wanted; }
    bool is_up() const { return phase_ == Phase::up; }
    void lose_link(base::Instant now);
    void on_accepted(base::Instant now);
    void on_executed(const Order& order);
    void start_up(base::Instant now);
    std::uint8_t safety_command() const;
    void request_slow_status_blind(base::Instant now);
    bool send_blind_stop(base::Instant now);
    bool has_work() const;
    void work(base::Instant now);
    void prove_link(base::Instant now);
    base::Instant proof_due() const;
    void write_register(Sending what, const Order& order, base::Instant now);
    void send_access(base::Instant now);
    void follow_access(base::Instant now);
    void command(Sending what, std::uint8_t command, base::Instant now);
    std::uint8_t on_the_wire(std::uint8_t command) const;
    void hold_in_position();
    void update_hold();

    // Small members first: a 16-bit Thumb load or store reaches only the first 32 to 128 bytes of an object.
    Sending sending_ = Sending::nothing;
    Phase phase_ = Phase::down;
    bool safe_communication_;
    bool registers_are_32_bit_;
    protocol::fastmac::RegisterCode register_code_;
    bool safe_now_ = false;  ///< the motor expects every byte twice
    bool slowed_ = false;    ///< 13h has been sent
    Stop stop_ = Stop::confirmed;
    bool link_error_ = false;
    bool was_up_ = false;
    bool is_aside_ =
        false;  ///< the message in progress is not an order: an access, its protocol changes, or a NOP
    bool holds_ = false;  ///< IN_POS reads 0 until the motor has updated it
    JvlLink link_;
    BlindStop blind_stop_;
    AccessSlot access_;
    std::uint32_t hold_bytes_;     ///< as many as the motor sends in two samples, plus one pair
    std::uint32_t held_from_ = 0;  ///< link_.confirmed() when the hold began
    std::uint32_t losses_ = 0;
    base::Instant next_blind_{};
    std::optional<base::Instant> reply_until_;
    OrderQueue orders_;
};

}  // namespace nplc::motor
