#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "base/ring.h"
#include "faces/axis_model.h"
#include "faces/midi_watch.h"
#include "faces/motor_reader.h"
#include "gateway/controller.h"
#include "seat/seat.h"

namespace nplc::faces {

struct LoopSettings {
    /// Interval of motor reads for faces, one register each; 0: the motor is never read.
    base::Microseconds motor_period{100'000};
    std::optional<base::Microseconds> seat_silence{};  ///< unset: the force time
    Control control = Control::any;
    /// Input 0..5 that selects: on is remote, off is local.
    std::optional<std::uint8_t> remote_input{};
    std::function<void(const Command&)> tell_write{};  ///< see AxisLoop::tell_writes
};

/// The axis loop's side of the model: takes images between two scans, reads the motor periodically, and
/// carries out commands by the rules of the user port. Nothing here blocks.
class AxisLoop {
  public:
    AxisLoop(AxisModel& model, const LoopSettings& settings)
        : model_(model), settings_(settings), reader_(settings.motor_period) {}

    /// To be called after every poll of the controller. `now` is its time, `wall` that of the faces' clock;
    /// on a board they are the same. `driver`: the controller's motor, for drives with additional status.
    void poll(gateway::Controller& controller, base::Instant now, base::Instant wall,
              const motor::AnyDriver* driver = nullptr);
    /// Only counts events: after every poll of the controller if poll() is called less often.
    void count(const gateway::Controller& controller) { tally_.look(controller.sequence()); }
    /// There is a new controller; operations of the old one have ended.
    void restarted();
    /// Latest time of the next poll(), by the faces' clock, if the bell does not ring.
    base::Instant next(const gateway::Controller& controller) const;

    /// For the operators' ports, from the loop.
    Seat& seat() { return seat_; }
    /// `tell` is called in poll(), for each command of a face that writes a register of the gateway, when the
    /// gateway is given it, also one that it then refuses; of stops only those that are carried out.
    void tell_writes(std::function<void(const Command&)> tell) { settings_.tell_write = std::move(tell); }

  private:
    using Work = CommandDesk::Work;

    void look_at_control(const gateway::Controller& controller);
    void survey(const gateway::Controller& controller);
    void forget_motor();
    void let_go(gateway::Controller& controller);
    void look_for_stops(gateway::Controller& controller);
    void take_stops(gateway::Controller& controller);
    void carry_out_stop(gateway::Controller& controller, const Work& stop);
    void follow_stops(gateway::Controller& controller);
    void take_others(gateway::Controller& controller);
    std::optional<Completion> refusal();
    void begin(gateway::Controller& controller);
    void begin_own(gateway::Controller& controller);
    void begin_change(gateway::Controller& controller);
    void serve_change(gateway::Controller& controller);
    void begin_motor(gateway::Controller& controller);
    void reset_drive(gateway::Controller& controller);
    void clear_error();
    void go_on(gateway::Controller& controller);
    void go_on_own(gateway::Controller& controller);
    Completion write_own(gateway::Controller& controller, const Command& command);
    void drop(gateway::Controller& controller);
    void report();
    void take_image(gateway::Controller& controller);
    void fill_shelves(gateway::Controller& controller);
    void show_seat();

    AxisModel& model_;
    LoopSettings settings_;
    Seat seat_;
    MotorReader reader_;
    MidiWatch midi_;
    TallyKeeper tally_;
    const motor::AnyDriver* driver_ = nullptr;  ///< during poll()
    base::Instant now_{};
    base::Instant wall_{};
    static constexpr base::Instant kLongAgo{base::Microseconds(INT64_MIN / 2)};
    base::Instant surveyed_ = kLongAgo;  ///< start of the last survey
    std::uint32_t surveyed_errors_ = 0;  ///< the motor's, at its start
    base::Instant moved_{};              ///< the shaft's last motion
    bool is_restarted_ = true;           ///< the shelf has the set-points of another controller
    bool come_back_ = false;             ///< a lock was not available, or there is more work

    std::optional<Work> work_;         ///< in progress, or ended and not yet reported
    std::optional<Completion> ended_;  ///< of work_
    bool begun_ = false;               ///< of work_
    bool clears_ = false;              ///< for work_, a reset_error: ERR_STAT has been read
    std::uint8_t own_write_ = 0;       ///< GatewayRegisters::writes_begun of this loop's write
    std::optional<Work> change_;  ///< a set-point request, parallel to work_; or ended and not yet reported
    std::optional<Completion> change_ended_;
    gateway::SetPoints::Writer change_writer_;
    std::optional<std::uint8_t> writes_seen_;  ///< GatewayRegisters::writes_begun
    bool was_enabled_ = false;
    struct CarriedOut {
        Work work;
        base::Instant at{};
    };
    static constexpr base::Microseconds kLongestStop{1'000'000};
    base::Ring<CarriedOut, CommandDesk::kMostClients>
        carried_out_;                ///< stops that the motor has not confirmed yet
    std::optional<Work> told_stop_;  ///< ended, and not yet reported
    std::optional<Completion> stop_told_;
    AxisImage image_;
};

}  // namespace nplc::faces
