#pragma once

#include <concepts>
#include <cstdint>
#include <variant>

#include "motor/motor.h"
#include "ports/can.h"
#include "ports/serial.h"

namespace nplc::motor {

/// The line to a drive: one of these.
struct DriverPorts {
    ports::SerialPort* serial = nullptr;
    ports::CanPort* can = nullptr;
};

/// What the settings say of a drive and its line. Each family takes what it has a use for.
struct DriverSettings {
    std::uint32_t baud = 19'200;
    base::Milliseconds silence{20};
    std::uint8_t motor_kind = 0;
    std::uint8_t address = 0;
    bool is_mac800 = false;
    bool safe_communication = true;
    bool old_register_codes = false;
};

/// A place for the driver of a drive of any of these families. Such a `Driver` has
///   static constexpr bool drives(const DriverPorts&, std::uint8_t motor_kind);
///   Driver(const DriverPorts&, const DriverSettings&);
///   a member `motor`, its Motor, which has base::Instant next_poll(base::Instant now) const.
template <typename First, typename... Others>
class DriverPlace {
  public:
    DriverPlace() = default;
    DriverPlace(const DriverPlace&) = delete;
    DriverPlace& operator=(const DriverPlace&) = delete;

    /// A new driver, as after a power-up, for the drive that `motor_kind` names on the line that there is;
    /// the first where none says so. The one before is gone.
    Motor& start(const DriverPorts& ports, const DriverSettings& settings) {
        return start_one<Others..., First>(ports, settings);
    }

    /// When to poll the driver at the latest, asked after each poll() and each call that gives it something
    /// to do; `now` or earlier: at once. Not with no driver.
    base::Instant next_poll(base::Instant now) const {
        return std::visit(
            [now](const auto& driver) {
                if constexpr (requires { driver.motor; })
                    return driver.motor.next_poll(now);
                else
                    return now;
            },
            driver_);
    }

    /// Null: the drive is led by another kind of Motor.
    template <typename Wanted>
    const Wanted* get() const {
        return std::visit(
            [](const auto& driver) -> const Wanted* {
                if constexpr (requires {
                                  { driver.motor } -> std::same_as<const Wanted&>;
                              })
                    return &driver.motor;
                return nullptr;
            },
            driver_);
    }

  private:
    template <typename Driver, typename... Rest>
    Motor& start_one(const DriverPorts& ports, const DriverSettings& settings) {
        if constexpr (sizeof...(Rest) != 0) {
            if (!Driver::drives(ports, settings.motor_kind)) return start_one<Rest...>(ports, settings);
        }
        return driver_.template emplace<Driver>(ports, settings).motor;
    }

    std::variant<std::monostate, First, Others...> driver_;
};

}  // namespace nplc::motor
