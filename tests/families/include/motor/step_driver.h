#pragma once

#include <array>
#include <string>

#include "base/ring.h"
#include "motor/driver.h"

namespace nplc::motor::step {

/// Leads a STEP1 by its three commands, each a line of ASCII: "G-4096" goes to a place in counts, "S" stops,
/// "?" is answered by "1 -4000" while it moves and "0 -4096" when it stands.
class StepMotor final : public Motor {
  public:
    explicit StepMotor(ports::SerialPort& port) : port_(port) {}

    void poll(base::Instant now) override;
    void begin_orders(base::Instant now) override;
    base::Instant next_poll(base::Instant now) const { return now + base::Milliseconds(1); }
    bool orders_complete() const override;
    bool can_execute(const Order& order) const override;
    bool has_room() const override { return !orders_.full(); }
    void send(const Order& order) override;
    void stop() override { stops_ = true; }
    bool stop_confirmed() const override { return !stops_; }
    void give_up_stop() override { stops_ = false; }
    bool begin_access(const Access&) override { return false; }
    AccessState access_state() const override { return AccessState::none; }
    std::uint32_t access_value() const override { return 0; }
    void drop_access() override {}
    bool in_position() const override { return stands_ && error() == false; }
    bool error() const override { return link_ != Link::up; }
    Link link() const override { return link_; }
    Counters counters() const override { return counters_; }
    bool longwords_only() const override { return false; }

  private:
    void take_line(base::Instant now);
    void execute(const Order& order, base::Instant now);
    void say(const std::string& text);

    ports::SerialPort& port_;
    Link link_ = Link::down;
    Counters counters_;
    base::Ring<Order, 8> orders_;
    std::array<std::int32_t, 8> places_{};
    bool stops_ = false;
    bool stands_ = false;
    bool is_asked_ = false;
    bool was_ordered_ = false;  ///< since the last question
    base::Instant asked_{};
    std::string line_;
};

struct Driver {
    static constexpr bool drives(const DriverPorts& ports, std::uint8_t motor_kind) {
        return ports.serial != nullptr && motor_kind == 4;
    }
    Driver(const DriverPorts& ports, const DriverSettings&) : motor(*ports.serial) {}

    StepMotor motor;
};

}  // namespace nplc::motor::step
