#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace nplc::seqc {

/// Cache of sets that are known to need more than a number of cubes; it may forget.
template <class Set>
class Failures {
  public:
    bool has(const Set& set, std::size_t most) const {
        if (slots_.empty()) return false;
        const Slot& slot = slots_[place(set)];
        return slot.set == set && slot.most >= most;
    }
    void add(const Set& set, std::size_t most) {
        if (slots_.empty()) slots_.resize(std::size_t{1} << kBits);
        slots_[place(set)] = {set, static_cast<std::uint32_t>(most)};
    }

  private:
    static constexpr unsigned kBits = 15;
    struct Slot {
        Set set{};
        std::uint32_t most = 0;
    };
    static std::size_t place(const Set& set) {
        return static_cast<std::uint32_t>(std::hash<Set>()(set)) * 0x9E3779B1U >> (32U - kBits);
    }

    std::vector<Slot> slots_;
};

}  // namespace nplc::seqc
