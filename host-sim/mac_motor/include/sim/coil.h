#pragma once

#include <cstdint>

namespace nplc::sim {

/// The traverse of COIL_MODE (001 §4.4.20): where the wire is to be laid while the spindle turns. It runs to
/// and fro between the thread positions P1 and P4; what is beyond the stop positions P2 and P3 is waited at
/// them.
class Coil {
  public:
    struct Setup {
        std::int64_t left_thread;   ///< P1, counts; and so on
        std::int64_t left_stop;     ///< P2
        std::int64_t right_stop;    ///< P3
        std::int64_t right_thread;  ///< P4
        std::int64_t start;         ///< P5
        std::int64_t direction;     ///< P6: below 0 left, else (R) right
    };

    /// As after power-up and homing: a start command has to come first.
    void forget() { *this = {}; }
    bool started() const { return started_; }

    /// One sample. `start`: the analogue input is high. `travel_16`: what the spindle asks for, 1/16 counts.
    /// R: a setup that is not P1 <= P2 <= P3 <= P4 moves nothing.
    void step(const Setup& setup, bool start, std::int64_t travel_16);
    /// Where the motor is to be, 1/16 counts; `here_16` before the first start and with a wrong setup.
    std::int64_t target_16(const Setup& setup, std::int64_t here_16) const;

  private:
    static bool usable(const Setup& setup);
    void travel(const Setup& setup, std::int64_t travel_16);

    bool started_ = false;
    bool to_the_left_ = false;
    std::int64_t place_16_ = 0;  // between the thread positions, 1/16 counts
};

}  // namespace nplc::sim
