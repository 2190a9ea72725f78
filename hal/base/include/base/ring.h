#pragma once

#include <array>
#include <cstddef>

namespace nplc::base {

/// FIFO with fixed storage. `push` returns false when full; `front` and `pop` need `!empty()`.
template <class T, std::size_t Capacity>
class Ring {
  public:
    constexpr bool empty() const { return count_ == 0; }
    constexpr bool full() const { return count_ == Capacity; }
    constexpr std::size_t size() const { return count_; }
    static constexpr std::size_t capacity() { return Capacity; }

    constexpr bool push(const T& item) {
        if (full()) return false;
        items_[wrap(head_ + count_)] = item;
        ++count_;
        return true;
    }

    constexpr const T& front() const { return items_[head_]; }
    constexpr T& front() { return items_[head_]; }

    constexpr void pop() {
        head_ = wrap(head_ + 1);
        --count_;
    }

    constexpr void clear() { count_ = 0; }

  private:
    static constexpr std::size_t wrap(std::size_t index) {
        return index >= Capacity ? index - Capacity : index;
    }

    std::size_t head_ = 0;
    std::size_t count_ = 0;
    std::array<T, Capacity> items_{};
};

}  // namespace nplc::base
