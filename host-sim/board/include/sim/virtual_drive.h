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
    std::uint8_t address = 0;  ///< on a CAN bus 1..; 0 there means 1
    std::uint32_t rate = 0;    ///< baud or bit/s; 0: the drive's factory setting
    std::uint64_t seed = 1;    ///< of the line's faults
};

/// Name of the part that an action needs and a drive may lack: "a brake".
std::string_view missing_for(const action::OnMotor& what);

/// A virtual drive that replaces the JVL motor, and the line to it, in virtual time. Shaft and speed are in
/// JVL's counts and samples.
class VirtualDrive {
  public:
    VirtualDrive() = default;
    VirtualDrive(const VirtualDrive&) = delete;
    VirtualDrive& operator=(const VirtualDrive&) = delete;
    virtual ~VirtualDrive() = default;

    /// The gateway's end of the line, and the settings of its driver.
    virtual motor::DriverPorts ports() = 0;
    virtual void complete(motor::DriverSettings& settings) const = 0;
    /// "MAC34-1 over V24 at 38400 baud"
    virtual std::string in_words() const = 0;
    /// The driver's text for its ERROR; empty without one.
    virtual std::string note(const motor::AnyDriver& driver) const = 0;
    /// Null if it is no serial line.
    virtual const VirtualSerialLine* line() const = 0;

    /// Moves characters or frames, after the drive was advanced to `now`. True if something has arrived at
    /// the gateway.
    virtual bool service(Time now) = 0;
    virtual Time next_event(Time now) const = 0;
    virtual Time sample_period() const = 0;
    virtual void sample() = 0;
    virtual void fill(Snapshot& snapshot) const = 0;

    virtual void cut(bool cut) = 0;
    virtual bool is_cut() const = 0;
    /// The shaft has no room between its mechanical ends.
    virtual bool is_blocked() const { return false; }
    virtual void spoil(const action::SpoilLine& faults) = 0;
    virtual void reseed(std::uint64_t seed) = 0;
    virtual void power(bool on) = 0;

    /// The drive reports an error; false: it cannot.
    virtual bool fail() { return false; }
    /// To be called before the run begins.
    virtual void store(const StoredRegister&) {}
    /// Why an action that the drive has does nothing now; empty: it does, or nobody knows.
    virtual std::string without_effect(const Action&) const { return {}; }
    /// Empty, or missing_for() the action.
    virtual std::string_view act(const action::OnMotor& what) { return missing_for(what); }
};

/// For the timeline: the virtual drive does not have that part; the scenario goes on.
std::string lacks(const registers::DriveModel& model, std::string_view part);

/// Null for a JVL motor, which is part of World.
std::unique_ptr<VirtualDrive> make_virtual_drive(const VirtualDriveOptions& options,
                                                 const LineFaults& faults);

/// Applies the faults named in `what` to one direction.
void spoil(LineDirection& direction, const action::SpoilLine& what);

}  // namespace nplc::sim
