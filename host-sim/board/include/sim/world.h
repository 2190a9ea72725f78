#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gateway/controller.h"
#include "sim/mac_motor.h"
#include "sim/scenario_runner.h"
#include "sim/serial_line.h"
#include "sim/sim_board.h"
#include "sim/sim_storage.h"
#include "sim/snapshot.h"
#include "sim/virtual_drive.h"

namespace nplc::sim {

/// When the simulated board polls the firmware.
enum class Polling : std::uint8_t {
    steadily,     ///< every 250 us, and when a character from the motor or another deadline requires it
    at_need,      ///< when something arrives, and when the firmware's deadline is due
    beyond_need,  ///< both: every 250 us, and when required
};

struct WorldOptions {
    registers::Model motor = registers::Model::mac140;
    /// A drive of another family that replaces the motor; the motor then has no supply.
    std::optional<VirtualDriveOptions> drive{};
    std::uint32_t baud = 19'200;  ///< the motor's; a standard rate. Also the gateway's if nothing is stored
    std::uint64_t seed = 1;
    LineFaults faults;  ///< both directions
    bool safe_communication = true;
    bool old_register_codes = false;
    /// A new store: nothing starts automatically until run was commanded once.
    bool is_new = false;
    Servo::Depth depth = Servo::Depth::current_loop;  ///< of the motor's computation
    Load load{};                                      ///< of the motor's shaft
    gateway::Settings gateway{};                      ///< used while nothing is stored
    std::uint32_t user_baud = 19'200;         ///< while nothing is stored; its clients use the gateway's rate
    std::vector<StoredRegister> registers{};  ///< in the drive's flash, in addition to the factory values
    bool user_submits = false;         ///< messages of a listener (UserPort::submit) instead of the user line
    bool motor_mactalk_wired = false;  ///< the motor's own MacTalk port, to the gateway's second user port
    ports::Storage* storage = nullptr;  ///< for tables and settings; null: the board's own
    Polling polling = Polling::steadily;
    gateway::Observer* observer = nullptr;  ///< receives the gateway's observer calls
};

/// The simulated board with the firmware on it, its motor and the line between them, in virtual time. From
/// one event to the next: a character, a sample of the motor, a poll of the firmware (every 250 us, and when
/// a character arrives). The same options, table and actions give the same run.
class World final : public Stage, private gateway::Observer {
  public:
    static constexpr Time kPollPeriod = std::chrono::microseconds{250};
    static constexpr base::Microseconds kWatchdogTime{2'000'000};

    /// As flash pages of 2 KiB: two table slots of five, two settings slots of one.
    static constexpr ports::StorageGeometry kFlash{
        .size = 32 * 1024, .erase_block = 2048, .program_page = 256, .program_unit = 8};
    static constexpr store::Area kTableArea{.begin = 0, .slot_bytes = 5 * 2048};
    static constexpr store::Area kSettingsArea{.begin = 10 * 2048, .slot_bytes = 2048};
    static constexpr store::Area kSetPointArea{.begin = 12 * 2048, .slot_bytes = 2048};

    /// `table` must be one that Table::load takes; an empty one is the stored one, or none. After an upload
    /// the stored one is what a restart runs.
    World(std::vector<std::uint8_t> table, const WorldOptions& options);
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    Time now() const { return now_; }

    /// Goes on to the next event, but not beyond `limit`, and does all that happens at that instant.
    void step(Time limit);

    /// As things stand, with the orders since the last call.
    Snapshot take_snapshot();

    /// Orders executed by the JVL motor since the last call; mac().orders() no longer has them.
    std::deque<Order> take_executed() { return mac_.take_orders(); }

    /// The orders that the driver has neither executed nor dropped, by their numbers among all orders given,
    /// counted from 0. The motor may have executed one of them already without the driver knowing.
    const std::deque<std::size_t>& on_their_way() const { return on_their_way_; }

    const gateway::Gateway& gateway() const { return controller_->sequence(); }
    /// The gateway's result for the table; it may still not suit this motor.
    const gateway::Gateway::LoadResult& load_result() const { return load_result_; }
    const motor::Motor& driver() const { return *motor_; }
    const motor::AnyDriver& any_driver() const { return driver_; }
    const MacMotor& mac() const { return mac_; }
    /// For changes by hand between two steps of the world.
    MacMotor& mac() { return mac_; }
    /// Null if the motor is a JVL motor.
    const VirtualDrive* drive() const { return drive_.get(); }
    VirtualDrive* drive() { return drive_.get(); }
    /// The motor's or the driver's text for its error; empty without one.
    std::string motor_note() const;
    /// For a table that load_result() says is not for this motor; empty without details.
    std::string_view why_not() const;
    const VirtualSerialLine& line() const { return line_; }
    const SimBoard& board() const { return board_; }

    /// Bytes of a client program to the gateway's port; they wait for the line.
    void user_sends(std::span<const std::uint8_t> bytes) {
        waiting_.user.insert(waiting_.user.end(), bytes.begin(), bytes.end());
    }
    /// Bytes received from there since the last call.
    std::vector<std::uint8_t> user_received() { return std::exchange(user_received_, {}); }
    /// The value at the gateway's start.
    std::uint32_t setting(store::Setting setting) const { return settings_->at_start(setting); }
    std::uint8_t gateway_address() const;
    std::uint8_t motor_address() const;  ///< on the user's port
    const gateway::TableManager& tables() const { return controller_->tables(); }
    /// For other interfaces (faces), between two steps. A new object after every start of the gateway.
    gateway::Controller& controller() { return *controller_; }
    std::uint64_t starts() const { return starts_; }
    base::Instant instant() const;

    /// Receives the text of `log` actions.
    void on_log(std::function<void(const std::string&)> callback) { on_log_ = std::move(callback); }

    /// Number of polls of the firmware.
    std::uint64_t polls() const { return polls_; }

    void set_input(unsigned index, bool level) override;
    void toggle_input(unsigned index) override;
    void cut_line(bool cut) override;
    bool line_is_cut() const { return drive_ ? drive_->is_cut() : line_.is_cut(); }
    /// True between rigid mechanical ends that leave it no room.
    bool shaft_is_blocked() const;
    void spoil_line(const action::SpoilLine& faults) override;
    void seed(std::uint64_t value) override;
    void fail_motor() override;
    void power_motor(bool on) override;
    void act(const action::OnMotor& what) override;
    void gateway(action::Gateway what) override;
    void set_breakpoints(const action::Breakpoints& where) override;
    void force(const action::ForceSignals& what) override;
    void set_points(const action::SetPoints& asked) override;
    void log(const std::string& text) override;

  private:
    void ordered(base::Instant now, const sequencer::MotorOrder& order) override;
    void scanned(base::Instant now, const sequencer::State& before, sequencer::InputImage image,
                 const sequencer::State& after) override;

    Time next_event() const;
    Time next_of_motor() const;
    void start_driver();
    void tell_without_effect(const Action& action);
    void start_gateway(gateway::StartCause cause);
    void start_table(bool first);
    void move_characters();
    void move_user_characters();
    void move_mactalk_characters();
    void sample_motor();
    void poll_gateway();
    void serve_set_points();
    void lose_set_points();
    void refused(gateway::Result why);
    Time next_poll();
    void follow_orders();
    /// An event that wakes a sleeping board.
    void wake();

    std::vector<std::uint8_t> table_;
    WorldOptions options_;
    VirtualSerialLine line_;
    SimBoard board_{kWatchdogTime};
    MacMotor mac_;
    std::unique_ptr<VirtualDrive> drive_;
    motor::AnyDriver driver_;
    motor::Motor* motor_ = nullptr;
    std::array<std::uint8_t, gateway::kTableMemory> table_memory_{};
    std::optional<gateway::SettingsManager> settings_;
    std::optional<gateway::Controller> controller_;
    VirtualSerialLine user_line_;     ///< the "motor" end of this line is the client
    VirtualSerialLine mactalk_line_;  ///< to the motor's own MacTalk port
    struct Waiting {
        std::deque<std::uint8_t> user;  ///< bytes for the user
        std::deque<action::SetPoints> set_points;
        std::optional<gateway::SetPoints::Writer> writer;  ///< for the first of them
    };
    Waiting waiting_;
    std::vector<std::uint8_t> user_received_;
    SimStorage flash_{kFlash};
    gateway::Gateway::LoadResult load_result_;

    Time now_{0};
    Time next_poll_{0};
    std::uint64_t polls_ = 0;
    std::uint64_t starts_ = 0;  ///< number of starts of the gateway
    Time next_sample_;
    Time motor_asks_{0};  ///< next time that the motor's transmitter is polled
    bool motor_powered_ = true;
    bool motor_fails_ = false;
    bool renews_forces_ = false;  ///< those that the scenario began
    std::vector<SentOrder> orders_;
    std::size_t orders_given_ = 0;
    std::deque<std::size_t> on_their_way_;
    motor::Counters followed_;  ///< the driver's counters at the last update of on_their_way_
    std::function<void(const std::string&)> on_log_;
};

}  // namespace nplc::sim
