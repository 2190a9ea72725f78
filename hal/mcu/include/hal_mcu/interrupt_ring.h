#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace nplc::hal_mcu {

/// Lock-free FIFO between an interrupt and the loop: one side pushes, the other pops.
template <class T, std::size_t Capacity>
class InterruptRing {
    static_assert(Capacity != 0 && (Capacity & (Capacity - 1)) == 0 && Capacity <= 0x8000);

  public:
    bool push(const T& item) {
        const std::uint16_t end = end_.load(std::memory_order_relaxed);
        if (distance(begin_.load(std::memory_order_acquire), end) == Capacity) return false;
        items_[end % Capacity] = item;
        end_.store(static_cast<std::uint16_t>(end + 1U), std::memory_order_release);
        return true;
    }

    std::optional<T> pop() {
        const std::uint16_t begin = begin_.load(std::memory_order_relaxed);
        if (begin == end_.load(std::memory_order_acquire)) return std::nullopt;
        const T item = items_[begin % Capacity];
        begin_.store(static_cast<std::uint16_t>(begin + 1U), std::memory_order_release);
        return item;
    }

    std::size_t size() const {
        return distance(begin_.load(std::memory_order_acquire), end_.load(std::memory_order_acquire));
    }
    bool empty() const { return size() == 0; }

  private:
    static std::size_t distance(std::uint16_t begin, std::uint16_t end) {
        return static_cast<std::uint16_t>(end - begin);
    }

    std::atomic<std::uint16_t> begin_{0};  ///< both wrap from 65535 to 0
    std::atomic<std::uint16_t> end_{0};
    std::array<T, Capacity> items_{};
};

}  // namespace nplc::hal_mcu
