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

/// Support of a drive family on this board: its configuration keys, its wiring, its driver's messages.
class DriveSupport {
  public:
    /// Keys of the table `motor`, besides `kind` and `port`.
    virtual std::span<const char* const> keys() const = 0;
    /// `axis_line` is the line to report for missing keys if there is no table.
    virtual void read(MotorConfig& motor, Section& section, int axis_line) const = 0;
    /// The setting applies to this family.
    virtual bool has_setting(store::Setting) const { return true; }
    /// The drive repeats its status without pause: it is read at intervals while nothing is in progress.
    virtual bool streams_status() const { return false; }

    /// The wiring rows of the drive and its line; notes are printed below the axis and below all axes.
    virtual std::vector<WiringRow> wiring(const MotorConfig& motor, std::uint32_t baud) const = 0;
    virtual std::string notes(const MotorConfig&) const { return {}; }
    virtual std::string closing_note() const { return {}; }

    /// Why the line is silent; empty: unknown.
    virtual std::string silence_in_words(const motor::AnyDriver&, const std::string& /*line*/) const {
        return {};
    }
    /// Why the link was lost, and what to do, where it is the line's fault; empty: not known.
    virtual std::string loss_in_words(const motor::AnyDriver&, const std::string& /*line*/) const {
        return {};
    }
    /// The driver's number of the cause of the present ERROR; 0: none.
    virtual std::uint8_t fault(const motor::AnyDriver&) const { return 0; }
    /// Text of that reason; empty without one, and for a lost link, which the log reports.
    virtual std::optional<LogMessage> fault_in_words(const motor::AnyDriver&) const { return std::nullopt; }
    /// The warnings as a bit mask, and the text of a bit.
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
