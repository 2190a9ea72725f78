#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gateway/gateway.h"
#include "motor/jvl_motor.h"
#include "sim/mac_motor.h"
#include "sim/serial_line.h"
#include "sim/sim_board.h"
#include "sim/snapshot.h"
#include "sim/stage.h"

namespace nplc::sim {

struct WorldOptions {
    registers::Model motor = registers::Model::mac140;
    std::uint32_t baud = 19'200;
    std::uint64_t seed = 1;
    LineFaults faults;  ///< both directions
    bool safe_communication = true;
    bool old_register_codes = false;
    gateway::Settings gateway{};
};

/// The simulated board with the firmware on it, its motor and the line between them, in virtual time. From
/// one event to the next: a character, a sample of the motor, a poll of the firmware (every 250 us, and when
/// a character arrives). The same options, table and actions give the same run.
class World final : public Stage, private gateway::Observer {
  public:
    static constexpr Time kPollPeriod = std::chrono::microseconds{250};
    static constexpr base::Microseconds kWatchdogTime{2'000'000};

    /// `table` must be one that Table::load takes.
    World(std::vector<std::uint8_t> table, const WorldOptions& options);
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    Time now() const { return now_; }

    /// Goes on to the next event, but not beyond `limit`, and does all that happens at that instant.
    void step(Time limit);

    /// As things stand, with the orders since the last call.
    Snapshot take_snapshot();

    /// The orders that the driver has neither executed nor given up, by their numbers among all orders given,
    /// counted from 0. The motor may have executed one of them already, unknown to the driver.
    const std::deque<std::size_t>& on_their_way() const { return on_their_way_; }

    const gateway::Gateway& gateway() const { return *gateway_; }
    /// What the gateway said of the table; it may still not be for this motor.
    const sequencer::Table::LoadResult& load_result() const { return load_result_; }
    const motor::JvlMotor& driver() const { return *driver_; }
    const MacMotor& mac() const { return mac_; }
    const VirtualSerialLine& line() const { return line_; }
    const SimBoard& board() const { return board_; }
    bool motor_powered() const { return motor_powered_; }

    /// What `log` actions say.
    void on_log(std::function<void(const std::string&)> callback) { on_log_ = std::move(callback); }

    void set_input(unsigned index, bool level) override { board_.set_input(index, level); }
    void toggle_input(unsigned index) override;
    void cut_line(bool cut) override;
    void spoil_line(const action::SpoilLine& faults) override;
    void seed(std::uint64_t value) override { line_.reseed(value); }
    void fail_motor() override { motor_fails_ = true; }
    void load_motor(int torque) override { mac_.plant().load().torque = torque; }
    void power_motor(bool on) override;
    void stop_motor(const action::StopMotor& stop) override;
    void free_motor() override;
    void connect_sensor(const action::MotorSensor& sensor) override;
    void set_analogue(double volts) override;
    void set_pulses(const action::MotorPulses& pulses) override;
    void set_supply(const action::MotorSupply& supply) override;
    void set_temperature(int celsius) override { mac_.surroundings().celsius = celsius; }
    void break_encoder() override { mac_.surroundings().encoder_broken = true; }
    void gateway(action::Gateway what) override;
    void log(const std::string& text) override;

  private:
    void ordered(base::Instant now, const sequencer::MotorOrder& order) override;
    void scanned(base::Instant now, const sequencer::State& before, sequencer::InputImage image,
                 const sequencer::State& after) override;

    Time next_event() const;
    base::Instant instant() const;
    void start_gateway(gateway::StartCause cause);
    void move_characters();
    void sample_motor();
    void poll_gateway();
    void follow_orders();

    std::vector<std::uint8_t> table_;
    WorldOptions options_;
    VirtualSerialLine line_;
    SimBoard board_{kWatchdogTime};
    MacMotor mac_;
    std::optional<motor::JvlMotor> driver_;
    std::optional<gateway::Gateway> gateway_;
    sequencer::Table::LoadResult load_result_;

    Time now_{0};
    Time next_poll_{0};
    Time next_sample_;
    Time motor_asks_{0};  ///< when the motor's transmitter is looked at next
    bool motor_powered_ = true;
    bool motor_fails_ = false;
    std::vector<SentOrder> orders_;
    std::size_t orders_given_ = 0;
    std::deque<std::size_t> on_their_way_;
    motor::JvlMotor::Counters followed_;  ///< the driver's, as on_their_way_ stands
    std::function<void(const std::string&)> on_log_;
};

}  // namespace nplc::sim
