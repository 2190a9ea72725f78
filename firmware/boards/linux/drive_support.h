#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "log_messages.h"
#include "motor/any_driver.h"
#include "motor_config.h"
#include "section.h"

namespace nplc::boards {

/// Signal, this board, level, the other end.
using WiringRow = std::array<std::string, 4>;

/// What a family of drives is on this board: its keys in the configuration, its wiring, what its driver has
/// to tell.
class DriveSupport {
  public:
    /// Of its table `motor`, beside `kind` and `port`.
    virtual std::span<const char* const> keys() const = 0;
    /// `axis_line` is to blame for what is missing if there is no table.
    virtual void read(MotorConfig& motor, Section& section, int axis_line) const = 0;
    /// The setting has a meaning with this family.
    virtual bool has_setting(store::Setting) const { return true; }
    /// The drive repeats its status without pause: it is read now and then while nothing is under way.
    virtual bool streams_status() const { return false; }

    /// The rows of the drive and its line, and what to mind, in lines below the axis and below all axes.
    virtual std::vector<WiringRow> wiring(const MotorConfig& motor, std::uint32_t baud) const = 0;
    virtual std::string notes(const MotorConfig&) const { return {}; }
    virtual std::string closing_note() const { return {}; }

    /// Why nothing comes from the line; empty: not known.
    virtual std::string silence_in_words(const motor::AnyDriver&, const std::string& /*line*/) const {
        return {};
    }
    /// The driver's number of the cause of the present ERROR; 0: none.
    virtual std::uint8_t fault(const motor::AnyDriver&) const { return 0; }
    /// That cause; nothing without one, and for a lost link, which the log tells.
    virtual std::optional<LogMessage> fault_in_words(const motor::AnyDriver&) const { return std::nullopt; }
    /// What it warns of, a bit each, and a bit in words.
    virtual std::uint32_t warnings(const motor::AnyDriver&) const { return 0; }
    virtual std::string warning_in_words(std::uint32_t /*bit*/) const { return {}; }

  protected:
    ~DriveSupport() = default;
};

const DriveSupport& support_of(const registers::DriveFamily& family);
inline const DriveSupport& support_of(const MotorConfig& motor) {
    return support_of(*motor.model->family);
}

}  // namespace nplc::boards
