#pragma once

#include "gateway/own_registers.h"
#include "gateway/user_port.h"

namespace nplc::gateway {

/// The controller of one axis: the sequence, the stored table, the registers and the user's port, on a
/// board's ports. It alone polls the motor and the store. Before it come the settings, by which a board opens
/// its lines and makes the motor's driver; after it tables().start() or tables().use(), then poll().
class Controller {
  public:
    struct Ports {
        ports::DigitalInputs& inputs;
        ports::DigitalOutputs& outputs;
        ports::Watchdog& watchdog;
        motor::Motor& motor;
        ports::Storage& storage;
        ports::SerialPort* user_line = nullptr;           ///< null: nobody is served
        ports::SerialPort* motor_mactalk_line = nullptr;  ///< the motor's own; null: not wired
        OwnRegisters::Lines shown_lines{};                ///< whose faults LINE_FAULTS shows
        const store::Area* set_points = nullptr;          ///< of `storage`; null: none are kept
    };

    /// Outputs get their safe values, and the tables' area of the storage is looked at. `table`: memory for
    /// the active one.
    Controller(const Ports& ports, const store::Area& tables, std::span<std::uint8_t> table,
               SettingsManager& settings, StartCause cause);
    Controller(const Controller&) = delete;
    Controller& operator=(const Controller&) = delete;

    /// As Gateway::poll asks for it.
    void poll(base::Instant now);
    /// The same, for the moment when nothing but an input has changed: the scan first, then the motor.
    void poll_after_edge(base::Instant now);
    /// As of Gateway; the user's port and the store want it by then too.
    base::Instant next_poll(base::Instant now, base::Instant motors);

    Gateway& sequence() { return sequence_; }
    const Gateway& sequence() const { return sequence_; }
    SetPointsPart& set_points() { return set_points_; }
    TableManager& tables() { return tables_; }
    const TableManager& tables() const { return tables_; }
    /// For faces beside the user's port (firmware/faces).
    OwnRegisters& registers() { return registers_; }
    const OwnRegisters& registers() const { return registers_; }
    UserPort& user_port() { return user_port_; }
    motor::Motor& motor() { return motor_; }
    const motor::Motor& motor() const { return motor_; }
    /// A user has asked for a reset: the board reads the settings anew and makes a new Controller.
    bool reset_asked() const { return registers_.reset_asked(); }

  private:
    // Made in this order: those first that only note where the others are.
    motor::Motor& motor_;
    OwnRegisters registers_;
    UserPort user_port_;
    Gateway sequence_;
    SetPointsPart set_points_;
    TableManager tables_;
};

}  // namespace nplc::gateway
