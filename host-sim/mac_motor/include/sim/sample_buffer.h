#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nplc::sim {

/// The motor's record of four registers (001 §3.2.112-116): filled and read in order, from the start after a
/// rewind. Writing and reading share one counter, REC_CNT.
class SampleBuffer {
  public:
    static constexpr std::size_t kCapacity = 895;
    using Sample = std::array<std::uint32_t, 4>;

    std::size_t count() const { return count_; }
    bool full() const { return count_ == kCapacity; }
    void rewind() { count_ = 0; }
    void clear() { samples_.assign(kCapacity, {}); }

    /// Nothing once it is full.
    void record(const Sample& sample) {
        if (!full()) samples_[count_++] = sample;
    }
    /// Zeros beyond the end.
    Sample next() { return full() ? Sample{} : samples_[count_++]; }

  private:
    std::size_t count_ = 0;
    std::vector<Sample> samples_ = std::vector<Sample>(kCapacity);
};

}  // namespace nplc::sim
