#pragma once

// A MIDI module sends any bytes, at any time, among any orders: the driver stays bounded, gives no motion
// command while the link does not deliver, shows ERROR from a loss until "reset error", and settles once the
// line is silent.

#include <algorithm>
#include <cstdint>
#include <deque>

#include "fuzz.h"
#include "motor/midi_motor.h"

namespace nplc::fuzz {

/// Bytes or frames on their way to the link, one after the other.
template <class Item>
class Arrivals {
  public:
    void say(const Item& item) { coming_.push_back(item); }
    /// One more is there for the link; false if no more is on its way.
    bool deliver() {
        if (coming_.empty()) return false;
        there_.push_back(coming_.front());
        coming_.pop_front();
        return true;
    }
    /// False if none is there.
    bool take(Item& item) {
        if (there_.empty()) return false;
        item = there_.front();
        there_.pop_front();
        return true;
    }

  private:
    std::deque<Item> coming_, there_;
};

/// A Wire has the driver's link and controls the module:
///   motor::MidiLink& link(); const motor::Motor* driver
///   void answer(std::uint32_t value): as a module would answer what was asked last
///   void act(std::uint8_t what, std::uint8_t value): any of its own kinds of trouble
///   Arrivals arrivals: what it has said
///   void clear(): what is sent is taken from here on, if the wire is there at all
///   kGap: the time from one to the next
template <class Wire>
class MidiDriverRun {
  public:
    /// Of a module with a speed of its own or with none (period 0).
    explicit MidiDriverRun(bool has_speed) {
        wire_.driver = &driver_;
        for (int i = 0; i < 40 && driver_.link() != motor::Link::up; ++i) {
            poll(base::Microseconds(1'000));
            wire_.answer(has_speed ? 0x80000320 : 0x80000000);
            hear();
        }
        require(driver_.link() == motor::Link::up);
    }

    void act(std::uint8_t what, std::uint8_t value) {
        switch (what % 10) {
            case 0:
                return poll(base::Microseconds(value * 200));
            case 1:
                wire_.answer(value * 0x01010101U);
                return hear();
            case 2:
                wire_.answer(value % 2 != 0 ? 0x0000'0800U : 0U);
                return hear();
            case 3:
            case 4:
                return order(value);
            case 5:
                return other(value);
            default:
                wire_.act(static_cast<std::uint8_t>(what % 10 - 6), value);
                return hear();
        }
    }

    /// Silence ends everything: the link is lost, or nothing was under way.
    void settle() {
        wire_.clear();
        const base::Instant end = now_ + base::Milliseconds(5'000);
        for (int i = 0; now_ < end; ++i) {
            require(i < 2'000);  // deadlines lead on
            const base::Instant due = std::min(driver_.next_poll(now_), end);
            poll(due > now_ ? due - now_ : base::Microseconds(1));
        }
        require(driver_.orders_complete());
        require(driver_.link() == motor::Link::down);
        require(driver_.error());
        poll(base::Microseconds(0));  // what could not be sent has ended by now
        require(driver_.next_poll(now_) > now_);
    }

  private:
    void order(std::uint8_t value) {
        if (driver_.has_room()) {
            constexpr std::uint8_t kRegisters[]{2, 2, 3, 5, 6, 7, 10, 33, 43, 49, 51, 65, 73, 77, 85, 120};
            driver_.send({.is_register_write = value % 3 == 0,
                          .command = static_cast<std::uint8_t>(value & 0x7F),
                          .reg = kRegisters[value % 16],
                          .longword = value % 5 == 0,
                          .value = value % 7U * (value % 4 == 0 ? 0x10001U : 77U)});
        }
        poll(base::Microseconds(100));
    }

    void other(std::uint8_t value) {
        if (value % 8 == 0) driver_.stop();
        if (value % 8 == 4) driver_.drop_access();
        if (value % 4 == 1) {
            // Where the shaft is and how fast it turns, besides any register.
            const int reg = value % 16 == 5 ? registers::P_IST + value / 16 % 3 : value / 2;
            const bool taken = driver_.begin_access({.is_write = value % 8 == 1,
                                                     .reg = static_cast<std::uint8_t>(reg),
                                                     .longword = value % 16 > 8,
                                                     .value = value});
            require(!taken || motor::link_is_usable(driver_.link()));
        }
        poll(base::Microseconds(100));
    }

    void hear() {
        do poll(Wire::kGap);
        while (wire_.arrivals.deliver());
    }

    void poll(base::Microseconds step) {
        now_ += step;
        driver_.poll(now_);
        require(!driver_.in_position() || (driver_.link() == motor::Link::up && !driver_.error()));
        require(driver_.link() != motor::Link::unacknowledged || driver_.error());
        require(driver_.link() != motor::Link::down || !ever_up_ || driver_.error());
        require((driver_.fault() == motor::MidiFault::none) == !driver_.error());
        if (driver_.link() == motor::Link::up) ever_up_ = true;
    }

    Wire wire_;
    motor::MidiMotor driver_{wire_.link(), {}};
    base::Instant now_{};
    bool ever_up_ = false;
};

template <class Wire>
void run_midi_driver(const std::uint8_t* data, std::size_t size) {
    if (size > 4096) return;
    MidiDriverRun<Wire> run(size % 2 != 0);
    for (std::size_t i = 0; i + 1 < size; i += 2) run.act(data[i], data[i + 1]);
    run.settle();
}

}  // namespace nplc::fuzz
