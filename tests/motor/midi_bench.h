#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "motor/midi_can_link.h"
#include "motor/midi_motor.h"
#include "motor/midi_v24_link.h"
#include "sim/midi_drive.h"

namespace nplc::motor {

namespace midi = registers::midi;
using namespace std::chrono_literals;

inline Order fast(std::uint8_t byte) {
    return {.command = byte};
}
inline Order word(std::uint8_t reg, std::int32_t value) {
    return {.is_register_write = true, .reg = reg, .value = static_cast<std::uint32_t>(value)};
}
inline Order longword(std::uint8_t reg, std::int32_t value) {
    return {
        .is_register_write = true, .reg = reg, .longword = true, .value = static_cast<std::uint32_t>(value)};
}

enum class Way : std::uint8_t { v24, can };

/// A driver on a virtual module, in virtual time; polled when something has arrived and when its own deadline
/// is due.
class MidiBench {
  public:
    explicit MidiBench(Way way, midi::Model model = midi::Model::mac34_1, std::uint64_t seed = 1)
        : drive({.model = model,
                 .can = way == Way::can,
                 .address = static_cast<std::uint8_t>(way == Way::can ? 1 : 0),
                 .seed = seed}),
          v24_link(drive.serial(), {}),
          can_link(drive.can(), {}),
          driver(way == Way::can ? static_cast<MidiLink&>(can_link) : v24_link, {.model = model}) {}

    base::Instant instant() const {
        return base::Instant{std::chrono::duration_cast<base::Microseconds>(now)};
    }

    void step(sim::Time limit) {
        const bool heard = drive.service(now);
        if (heard || instant() >= driver.next_poll(instant())) {
            driver.poll(instant());
            drive.service(now);
            if (on_poll) on_poll();
        }
        const sim::Time due = driver.next_poll(instant()) == base::kNever
                                  ? sim::Time::max()
                                  : sim::Time(driver.next_poll(instant()).time_since_epoch());
        const sim::Time next = std::min({limit, drive.next_event(now), due});
        now = std::max(next, now + 1us);
    }
    void pass(sim::Time time) {
        const sim::Time end = now + time;
        while (now < end) step(end);
    }
    bool until(const std::function<bool()>& holds, sim::Time longest = 5s) {
        const sim::Time end = now + longest;
        while (!holds() && now < end) step(end);
        return holds();
    }

    /// Up, and known to stand.
    void start() {
        ASSERT_TRUE(until([&] { return driver.link() == Link::up && driver.orders_complete(); }));
        pass(200ms);
    }
    void order(const Order& order) {
        ASSERT_TRUE(driver.has_room());
        driver.send(order);
    }
    void order_and_settle(const Order& wanted) {
        order(wanted);
        ASSERT_TRUE(until([&] { return driver.orders_complete(); }));
    }
    bool arrives(sim::Time longest = 20s) {
        return until([&] { return driver.in_position(); }, longest);
    }
    /// How often the module carried out a command.
    std::size_t count(std::uint8_t number) const {
        std::size_t times = 0;
        for (const sim::MidiAction& action : drive.module().actions())
            times += action.number == number ? 1 : 0;
        return times;
    }

    sim::MidiDrive drive;
    MidiV24Link v24_link;
    MidiCanLink can_link;
    MidiMotor driver;
    sim::Time now{0};
    std::function<void()> on_poll;
};

inline constexpr std::uint8_t kPositionP1 = 0x40;  ///< position mode, P1 selected
inline constexpr std::uint8_t kPositionP2 = 0x41;
inline constexpr std::uint8_t kPositionV1 = 0x48;
inline constexpr std::uint8_t kStop = 0x65;
inline constexpr std::uint8_t kVelocityV1 = 0x28;
inline constexpr std::uint8_t kInitV1 = 0x08;
inline constexpr std::uint8_t kInitA1 = 0x10;
inline constexpr std::uint8_t kResetError = 0x61;

}  // namespace nplc::motor
