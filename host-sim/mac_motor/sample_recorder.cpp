#include "sim/sample_recorder.h"

namespace nplc::sim {

void SampleRecorder::power_up() {
    samples_.rewind();
    samples_.clear();
}

InnerWatcher* SampleRecorder::begin_sample() {
    const std::uint32_t control = state_.control();
    if ((control & state_.bits().record) == 0 || !records_inner(control)) return nullptr;
    if ((control & state_.bits().rewind) != 0) rewind();
    return this;
}

bool SampleRecorder::records_inner(std::uint32_t control) const {
    return has_inner_loop_ && (control & state_.bits().record_inner) != 0;
}

void SampleRecorder::rewind_or_record(std::uint32_t control) {
    if ((control & state_.bits().rewind) != 0) rewind();
    if ((control & state_.bits().record) != 0 && !records_inner(control)) record();
}

void SampleRecorder::rewind() {
    samples_.rewind();
    state_.set_control(state_.control() & ~state_.bits().rewind);
    state_.memory.set(cell::REC_CNT, 0);
}

void SampleRecorder::record() {
    samples_.record(sampled_registers());
    state_.memory.set(cell::REC_CNT, static_cast<std::int32_t>(samples_.count()));
    const bool test_ended = servo_.drive().kind == Drive::Kind::voltage &&  // 001 §4.4.9
                            servo_.test_samples() == Servo::kTestSamples;
    if (samples_.full() || test_ended) state_.set_control(state_.control() & ~state_.bits().record);
}

void SampleRecorder::inner_sample() {
    if ((state_.control() & state_.bits().record) != 0) record();
}

SampleBuffer::Sample SampleRecorder::sampled_registers() const {
    SampleBuffer::Sample sample{};
    for (int i = 0; i < static_cast<int>(sample.size()); ++i) {
        const auto reg = static_cast<std::uint8_t>(state_.memory.get(cell::SAMPLE1[i]));
        sample[static_cast<std::size_t>(i)] = state_.memory.read(reg, state_.is_mac800());
    }
    return sample;
}

// A REWIND that no sample has processed yet counts too, or a fast reader would miss the first samples.
SampleBuffer::Sample SampleRecorder::next() {
    if ((state_.control() & state_.bits().rewind) != 0) rewind();
    const SampleBuffer::Sample sample = samples_.next();
    state_.memory.set(cell::REC_CNT, static_cast<std::int32_t>(samples_.count()));
    return sample;
}

}  // namespace nplc::sim
