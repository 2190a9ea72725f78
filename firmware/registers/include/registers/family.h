#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "registers/mac.h"

/// The families of drives that a sequence can lead: which models there are, and what each can do of a
/// sequence's orders, which are those of a JVL motor. A drive that speaks another language has a driver that
/// translates. How a family joins: firmware/motor/README.md.
namespace nplc::registers {

class DriveFamily;

struct DriveModel {
    const DriveFamily* family;
    std::uint8_t index;             ///< among the family's models
    std::uint8_t motor_kind;        ///< the setting; models that the driver need not tell apart have the same
    Model map;                      ///< whose registers a sequence uses for it
    std::string_view name;          ///< "MAC34-1", for what depends on the very model
    std::string_view program_name;  ///< "MAC34", after MOTOR in a program and in messages
    std::string_view program_alias{};  ///< "MAC34_1": MOTOR takes this too
    bool has_can = false;              ///< beside its serial line
};

/// What a drive makes of a register's value: "torque 128 of 255".
struct DriveValue {
    double raw = 0;  ///< what it will be, in the register's own steps
    std::string_view before{};
    std::optional<std::int32_t> number{};
    std::string_view after{};
};

/// Why something is refused: what it is and what to do, without a full stop. Empty: it is not.
using Refusal = std::string_view;

class DriveFamily {
  public:
    /// "MIDI"
    virtual std::string_view name() const = 0;
    virtual std::span<const DriveModel> models() const = 0;

    /// What its serial line can do; empty: every standard rate.
    virtual std::span<const std::uint32_t> bauds() const { return {}; }

    /// The driver translates: the drive itself has no such registers, and the gateway forgets those that it
    /// keeps for it when it is switched off.
    virtual bool is_translated() const { return true; }
    /// The driver keeps a new target, acceleration or velocity of a move until the drive stands.
    virtual bool waits_for_standstill() const { return false; }

    /// A FastMAC command, bits 6..0.
    virtual Refusal refuses_command(const DriveModel&, std::uint8_t /*command*/) const { return {}; }
    /// As far as the value itself tells.
    virtual Refusal refuses_write(const DriveModel&, std::uint8_t /*reg*/, bool /*longword*/,
                                  std::uint32_t /*value*/) const {
        return {};
    }
    /// Moving with both values.
    virtual Refusal refuses_profile(const DriveModel&, std::int16_t /*v_soll*/,
                                    std::uint16_t /*a_soll*/) const {
        return {};
    }

    /// Nothing for registers whose value stays what it is, or depends on another one. The value is one that
    /// is not refused.
    virtual std::optional<DriveValue> value_of(const DriveModel&, const Register&,
                                               std::uint32_t /*bits*/) const {
        return std::nullopt;
    }
    /// What A_SOLL becomes with this V_SOLL.
    virtual std::optional<DriveValue> ramp_of(const DriveModel&, std::int16_t /*v_soll*/,
                                              std::uint16_t /*a_soll*/) const {
        return std::nullopt;
    }

  protected:
    ~DriveFamily() = default;
};

/// All of this program.
std::span<const DriveFamily* const> families();
/// By its name, or the alias or name that a program uses. Case counts not.
const DriveModel* find_drive(std::string_view name);
const DriveModel* find_drive_of_program(std::string_view name);
/// The first model of a setting motor_kind; null for a number that none has.
const DriveModel* drive_of_kind(std::uint32_t motor_kind);

}  // namespace nplc::registers
