#pragma once

#include <optional>

#include "base/ring.h"
#include "faces/axis_model.h"
#include "faces/midi_watch.h"
#include "faces/motor_reader.h"
#include "gateway/controller.h"
#include "seat/seat.h"

namespace nplc::faces {

struct LoopSettings {
    /// Between two reads of the motor for faces, one register each; 0: it is never read.
    base::Microseconds motor_period{100'000};
    std::optional<base::Microseconds> seat_silence{};  ///< not given: the force time
    Control control = Control::any;
    /// Or: input 0..5, on is remote, off is local.
    std::optional<std::uint8_t> remote_input{};
};

/// The loop's side of an axis's model: takes images between two scans, reads the motor now and then, carries
/// out commands by the user's port's rules. Nothing here waits, for a face or for anything else.
class AxisLoop {
  public:
    AxisLoop(AxisModel& model, const LoopSettings& settings)
        : model_(model), settings_(settings), reader_(settings.motor_period) {}

    /// After every poll of the controller. `now` is its time, `wall` that of the clock that faces read; on a
    /// board they are the same. `driver`: the controller's motor, where there are drives that tell more of
    /// themselves than a motor does.
    void poll(gateway::Controller& controller, base::Instant now, base::Instant wall,
              const motor::AnyDriver* driver = nullptr);
    /// Only counts what has happened: after every poll of the controller where poll() comes more seldom.
    void count(const gateway::Controller& controller) { tally_.look(controller.sequence()); }
    /// There is a new controller; what the old one had under way has ended.
    void restarted();
    /// When poll() is wanted at the latest, by the faces' clock, if nobody rings.
    base::Instant next(const gateway::Controller& controller) const;

    /// For the persons' ports, from the loop.
    Seat& seat() { return seat_; }

  private:
    using Work = CommandDesk::Work;

    void look_at_control(const gateway::Controller& controller);
    void survey();
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
    base::Instant surveyed_ = kLongAgo;  ///< the last survey began
    std::uint32_t surveyed_errors_ = 0;  ///< of the motor, when it began
    base::Instant moved_{};              ///< the shaft's last motion
    bool is_restarted_ = true;           ///< the set-points on the shelf are those of another controller
    bool come_back_ = false;             ///< a lock was not to be had, or there is more to do

    std::optional<Work> work_;         ///< under way, or ended and not yet told
    std::optional<Completion> ended_;  ///< of work_
    bool begun_ = false;               ///< of work_
    bool clears_ = false;              ///< of work_, a reset_error: ERR_STAT has been read
    std::uint8_t own_write_ = 0;       ///< OwnRegisters::writes_begun of ours
    std::optional<Work> change_;       ///< of set-points, beside work_; or ended and not yet told
    std::optional<Completion> change_ended_;
    gateway::SetPoints::Writer change_writer_;
    std::optional<std::uint8_t> writes_seen_;  ///< OwnRegisters::writes_begun
    bool was_enabled_ = false;
    struct CarriedOut {
        Work work;
        base::Instant at{};
    };
    static constexpr base::Microseconds kLongestStop{1'000'000};
    base::Ring<CarriedOut, CommandDesk::kMostClients>
        carried_out_;                ///< stops that the motor has not confirmed yet
    std::optional<Work> told_stop_;  ///< ended, and not yet told
    std::optional<Completion> stop_told_;
    AxisImage image_;
};

}  // namespace nplc::faces
