#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/motor_state.h"
#include "sim/servo.h"

namespace nplc::sim {

/// The motor's record of four registers (001 §3.2.112-116): written and read in order, from the start after a
/// rewind. Writing and reading share one counter, REC_CNT.
class SampleBuffer {
  public:
    static constexpr std::size_t kCapacity = 895;
    using Sample = std::array<std::uint32_t, 4>;

    std::size_t count() const { return count_; }
    bool full() const { return count_ == kCapacity; }
    void rewind() { count_ = 0; }
    void clear() { samples_.assign(kCapacity, {}); }

    /// No effect once it is full.
    void record(const Sample& sample) {
        if (!full()) samples_[count_++] = sample;
    }
    /// Zeros beyond the end.
    Sample next() { return full() ? Sample{} : samples_[count_++]; }

  private:
    std::size_t count_ = 0;
    std::vector<Sample> samples_ = std::vector<Sample>(kCapacity);
};

/// Fills the record as selected by CNTRL_BITS: RECORD, REWIND, RECINNER (001 §3.2.36).
class SampleRecorder final : public InnerWatcher {
  public:
    /// R: without an inner loop its samples are those of the outer one.
    SampleRecorder(MotorState& state, const Servo& servo, bool has_inner_loop)
        : state_(state), servo_(servo), has_inner_loop_(has_inner_loop) {}

    void power_up();
    /// Before a sample: returns itself if it records each sample of the inner loop, else null.
    InnerWatcher* begin_sample();
    /// At the end of a sample of the outer loop.
    void end_sample() {
        const std::uint32_t control = state_.control();
        if ((control & (state_.bits().rewind | state_.bits().record)) != 0) rewind_or_record(control);
    }
    /// The next one for a reader.
    SampleBuffer::Sample next();

    void inner_sample() override;

  private:
    bool records_inner(std::uint32_t control) const;
    void rewind_or_record(std::uint32_t control);
    void rewind();
    void record();
    SampleBuffer::Sample sampled_registers() const;

    MotorState& state_;
    const Servo& servo_;
    bool has_inner_loop_;
    SampleBuffer samples_;
};

}  // namespace nplc::sim
