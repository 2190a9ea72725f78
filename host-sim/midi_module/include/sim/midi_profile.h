#pragma once

#include <cstdint>

namespace nplc::sim {

/// Times of the set-point increments of a MIDI module: 16 speeds in equal steps, 120 x AA increments from
/// standstill to full speed (003 §IV, §VII 0Fh and 13h). R: step k of 15 lasts k x AA increments, for 1 + 2 +
/// ... + 15 = 120; so all steps take the same time, and the acceleration is constant. Time in ticks of 0.125
/// us, integers only: the remainder is carried to the next increment.
class MidiProfile {
  public:
    using Ticks = std::int64_t;

    /// A number of increments from standstill to standstill; short moves decelerate before full speed.
    void begin_move(std::int64_t increments, std::uint16_t period, std::uint8_t ramp);
    /// Until stop(). If begun during a run the speed changes over a ramp of the same length (R).
    void begin_run(std::uint16_t period, std::uint8_t ramp);
    /// At constant speed; 0 increments end at once.
    void begin_segment(std::int64_t increments, std::uint16_t period);
    /// To standstill: a move in the increments that its present speed took to reach, a run in a whole ramp
    /// (R).
    void stop();
    void clear() { kind_ = Kind::none; }

    bool running() const { return kind_ != Kind::none; }
    bool is_run() const { return kind_ == Kind::run; }
    /// Remaining increments of a move or segment.
    std::int64_t remaining() const { return remaining_; }
    /// Changes the remaining distance of a move, never below the stopping distance.
    void set_remaining(std::int64_t increments);

    /// Duration of the next increment. Needs running(); does not change the state.
    Ticks interval() const;
    /// The next increment is slower than the last one, by more than the carry of one tick.
    bool slows() const { return running() && last_ != 0 && interval() > last_ + 1; }
    Ticks last_interval() const { return last_; }
    /// The increment has been made; the profile may end here.
    void advance();

  private:
    enum class Kind : std::uint8_t { none, move, run, segment };
    /// Ticks per increment as a fraction; standstill has denominator 0.
    struct Pace {
        Ticks numerator = 1;
        Ticks denominator = 0;
    };
    static constexpr int kSteps = 16;

    int step_after(std::int64_t increments) const;
    std::int64_t stopping_distance() const;
    Pace pace() const;
    Pace run_pace() const;
    void begin_ramp(Pace to);

    Kind kind_ = Kind::none;
    std::uint8_t ramp_ = 0;
    std::uint16_t period_ = 1;
    std::int64_t done_ = 0;
    std::int64_t remaining_ = 0;
    Pace from_{};  ///< present and final speed of a speed change in a run
    Pace to_{};
    int run_step_ = kSteps;
    std::int64_t in_step_ = 0;
    Ticks carried_ = 0;
    Ticks carried_for_ = 0;  ///< denominator of the carry
    Ticks last_ = 0;
};

}  // namespace nplc::sim
