#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "faces/image.h"

namespace nplc::faces {

/// The last image of an axis: one writer, any number of readers; the writer never waits.
class ImageBoard {
  public:
    /// From the axis's loop only.
    void put(const AxisImage& image);
    /// A consistent image, also during a write. `number` 0: none yet.
    AxisImage get() const;
    /// Of the last image.
    std::uint64_t number() const { return number_.load(std::memory_order_acquire); }

  private:
    static constexpr std::size_t kWords = (sizeof(AxisImage) + 7) / 8;

    std::atomic<std::uint64_t> turn_{0};  ///< odd during a write
    std::atomic<std::uint64_t> number_{0};
    std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace nplc::faces
