#pragma once

#include <concepts>
#include <cstdint>
#include <variant>

#include "motor/motor.h"
#include "ports/can.h"
#include "ports/serial.h"

namespace nplc::motor {

/// The line to a drive: exactly one of these is set.
struct DriverPorts {
    ports::SerialPort* serial = nullptr;
    ports::CanPort* can = nullptr;
};

/// Settings of a drive and its line. Each family uses those that apply to it.
struct DriverSettings {
    std::uint32_t baud = 19'200;
    base::Milliseconds silence{20};
    std::uint8_t motor_kind = 0;
    std::uint8_t address = 0;
    bool is_mac800 = false;
    bool safe_communication = true;
    bool old_register_codes = false;
};

/// Storage for the driver of one of several drive families. Such a `Driver` has
///   static constexpr bool drives(const DriverPorts&, std::uint8_t motor_kind);
///   Driver(const DriverPorts&, const DriverSettings&);
///   a member `motor`, its Motor, which has base::Instant next_poll(base::Instant now) const.
template <typename First, typename... Others>
class DriverPlace {
  public:
    DriverPlace() = default;
    DriverPlace(const DriverPlace&) = delete;
    DriverPlace& operator=(const DriverPlace&) = delete;

    /// Constructs a new driver, as after a power-up, for the drive that `motor_kind` names on the given line;
    /// the first family's if no family matches. Destroys the previous driver.
    Motor& start(const DriverPorts& ports, const DriverSettings& settings) {
        return start_one<Others..., First>(ports, settings);
    }

    /// Latest time of the next poll, to be asked after each poll() and each call that gives the driver work;
    /// `now` or earlier: at once. Needs a driver.
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

    /// Null if the present driver is of another kind.
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
