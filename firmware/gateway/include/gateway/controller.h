#pragma once

#include "gateway/gateway_registers.h"
#include "gateway/user_port.h"

namespace nplc::gateway {

/// The controller of one axis: sequence, stored table, registers and user port on a board's ports. It alone
/// polls the motor and the store. The settings are read first, since a board opens its lines and makes the
/// motor driver from them. After construction call tables().start() or tables().use(), then poll().
class Controller {
  public:
    struct Ports {
        ports::DigitalInputs& inputs;
        ports::DigitalOutputs& outputs;
        ports::Watchdog& watchdog;
        motor::Motor& motor;
        ports::Storage& storage;
        ports::SerialPort* user_line = nullptr;           ///< null: no user port
        ports::SerialPort* motor_mactalk_line = nullptr;  ///< the motor's own MacTalk port; null: not wired
        GatewayRegisters::Lines shown_lines{};            ///< the lines whose faults LINE_FAULTS shows
        const store::Area* set_points = nullptr;          ///< in `storage`; null: no set-points are stored
    };

    /// Writes the safe values to the outputs and reads the tables' area of the storage. `table`: memory for
    /// the active table.
    Controller(const Ports& ports, const store::Area& tables, std::span<std::uint8_t> table,
               SettingsManager& settings, StartCause cause);
    Controller(const Controller&) = delete;
    Controller& operator=(const Controller&) = delete;

    /// To be called as often as Gateway::poll().
    void poll(base::Instant now);
    /// The same when only an input has changed: scans first, then polls the motor.
    void poll_after_edge(base::Instant now);
    /// As Gateway::next_poll(), with the deadlines of the user port and the store included.
    base::Instant next_poll(base::Instant now, base::Instant motors);

    Gateway& sequence() { return sequence_; }
    const Gateway& sequence() const { return sequence_; }
    SetPointsPart& set_points() { return set_points_; }
    TableManager& tables() { return tables_; }
    const TableManager& tables() const { return tables_; }
    /// For faces beside the user's port (firmware/faces).
    GatewayRegisters& registers() { return registers_; }
    const GatewayRegisters& registers() const { return registers_; }
    UserPort& user_port() { return user_port_; }
    motor::Motor& motor() { return motor_; }
    const motor::Motor& motor() const { return motor_; }
    /// A user has asked for a reset: the board reads the settings anew and makes a new Controller.
    bool reset_asked() const { return registers_.reset_asked(); }

  private:
    // Order of construction: members that only store references to later ones come first.
    motor::Motor& motor_;
    GatewayRegisters registers_;
    UserPort user_port_;
    Gateway sequence_;
    SetPointsPart set_points_;
    TableManager tables_;
};

}  // namespace nplc::gateway
