#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "registers/mac.h"

/// The drive families that a sequence can drive: their models, and which of a sequence's orders, which are
/// those of a JVL motor, each can execute. A drive with another protocol has a driver that translates. How to
/// add a family: firmware/motor/README.md.
namespace nplc::registers {

class DriveFamily;

struct DriveModel {
    const DriveFamily* family;
    std::uint8_t index;       ///< index among the family's models
    std::uint8_t motor_kind;  ///< the setting; models that the driver need not distinguish have the same
    Model map;                ///< the register map that a sequence uses for it
    std::string_view name;    ///< "MAC34-1", the exact model
    std::string_view program_name;     ///< "MAC34", after MOTOR in a program and in messages
    std::string_view program_alias{};  ///< "MAC34_1": also allowed after MOTOR
    bool has_can = false;              ///< in addition to its serial line
};

/// A register's value converted for a drive: "torque 128 of 255".
struct DriveValue {
    double raw = 0;  ///< the resulting value in the register's raw steps
    std::string_view before{};
    std::optional<std::int32_t> number{};
    std::string_view after{};
};

/// Reason of a refusal with its remedy, without a full stop. Empty: not refused.
using Refusal = std::string_view;

class DriveFamily {
  public:
    /// "MIDI"
    virtual std::string_view name() const = 0;
    virtual std::span<const DriveModel> models() const = 0;

    /// Supported baud rates of its serial line; empty: every standard rate.
    virtual std::span<const std::uint32_t> bauds() const { return {}; }

    /// The driver translates: the drive itself has no such registers, and those that the gateway keeps for it
    /// are lost at power-off.
    virtual bool is_translated() const { return true; }
    /// The driver keeps a new target, acceleration or velocity of a move until standstill.
    virtual bool waits_for_standstill() const { return false; }

    /// A FastMAC command, bits 6..0.
    virtual Refusal refuses_command(const DriveModel&, std::uint8_t /*command*/) const { return {}; }
    /// Checks the value by itself only.
    virtual Refusal refuses_write(const DriveModel&, std::uint8_t /*reg*/, bool /*longword*/,
                                  std::uint32_t /*value*/) const {
        return {};
    }
    /// Checks motion with both values.
    virtual Refusal refuses_profile(const DriveModel&, std::int16_t /*v_soll*/,
                                    std::uint16_t /*a_soll*/) const {
        return {};
    }

    /// Empty for registers whose value is unchanged or depends on another one. The value must not be a
    /// refused one.
    virtual std::optional<DriveValue> value_of(const DriveModel&, const Register&,
                                               std::uint32_t /*bits*/) const {
        return std::nullopt;
    }
    /// The conversion of A_SOLL with this V_SOLL.
    virtual std::optional<DriveValue> ramp_of(const DriveModel&, std::int16_t /*v_soll*/,
                                              std::uint16_t /*a_soll*/) const {
        return std::nullopt;
    }

  protected:
    ~DriveFamily() = default;
};

/// All families of this program.
std::span<const DriveFamily* const> families();
/// By its name, or the alias or name used in programs. Case-insensitive.
const DriveModel* find_drive(std::string_view name);
const DriveModel* find_drive_of_program(std::string_view name);
/// The first model with this setting motor_kind; null if there is none.
const DriveModel* drive_of_kind(std::uint32_t motor_kind);

}  // namespace nplc::registers
