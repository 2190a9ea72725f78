#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "motor/any_driver.h"
#include "registers/family.h"
#include "sim/scenario.h"
#include "sim/serial_line.h"
#include "sim/snapshot.h"

namespace nplc::sim {

struct VirtualDriveOptions {
    const registers::DriveModel* model = nullptr;
    bool can = false;
    std::uint8_t address = 0;  ///< of a CAN bus 1..; 0 there: 1
    std::uint32_t rate = 0;    ///< baud or bit/s; 0: what the drive comes with
    std::uint64_t seed = 1;    ///< of the line's faults
};

/// What a drive does not have that cannot do it: "a brake".
std::string_view missing_for(const action::OnMotor& what);

/// A virtual drive in the place of the JVL motor, and the line to it, in virtual time. Shaft and speed are in
/// JVL's counts and samples.
class VirtualDrive {
  public:
    VirtualDrive() = default;
    VirtualDrive(const VirtualDrive&) = delete;
    VirtualDrive& operator=(const VirtualDrive&) = delete;
    virtual ~VirtualDrive() = default;

    /// The gateway's end of the line, and what its driver must know.
    virtual motor::DriverPorts ports() = 0;
    virtual void complete(motor::DriverSettings& settings) const = 0;
    /// "MAC34-1 over V24 at 38400 baud"
    virtual std::string in_words() const = 0;
    /// What the driver says of its ERROR; empty without one.
    virtual std::string note(const motor::AnyDriver& driver) const = 0;
    /// Null: it is no serial line.
    virtual const VirtualSerialLine* line() const = 0;

    /// Moves characters or frames on, after the drive has done all that happens until then. True if something
    /// has arrived at the gateway.
    virtual bool service(Time now) = 0;
    virtual Time next_event(Time now) const = 0;
    virtual Time sample_period() const = 0;
    virtual void sample() = 0;
    virtual void fill(Snapshot& snapshot) const = 0;

    virtual void cut(bool cut) = 0;
    virtual void spoil(const action::SpoilLine& faults) = 0;
    virtual void reseed(std::uint64_t seed) = 0;
    virtual void power(bool on) = 0;

    /// The drive reports an error; false: it has none.
    virtual bool fail() { return false; }
    /// Before the run begins.
    virtual void store(const StoredRegister&) {}
    /// Empty, or missing_for() it.
    virtual std::string_view act(const action::OnMotor& what) { return missing_for(what); }
};

/// Null for a JVL motor, which the board's world has itself.
std::unique_ptr<VirtualDrive> make_virtual_drive(const VirtualDriveOptions& options,
                                                 const LineFaults& faults);

/// Of one direction, what `what` names.
void spoil(LineDirection& direction, const action::SpoilLine& what);

}  // namespace nplc::sim
