#include "terms/open_cases.h"

#include <algorithm>

namespace nplc::seqc {

template <class T>
OpenBits OpenLayout::bit_for(std::vector<T>& seen, std::vector<OpenBits>& bits, T value, OpenBits& group) {
    const auto found = std::find(seen.begin(), seen.end(), value);
    if (found != seen.end()) return bits[static_cast<std::size_t>(found - seen.begin())];
    fits_ = fits_ && used_ < 62;
    const OpenBits bit = OpenBits{1} << (fits_ ? used_++ : 0);
    seen.push_back(value);
    bits.push_back(bit);
    group |= bit;
    return bit;
}

OpenLayout::OpenLayout(const Half& half) {
    std::vector<std::uint8_t> next_values;
    std::vector<std::uint8_t> output_values;
    std::vector<std::uint16_t> timer_values;
    std::vector<std::uint16_t> counter_values;
    std::array<std::vector<OpenBits>, 4> bits;
    no_timer = OpenBits{1} << 62;
    no_counter = OpenBits{1} << 63;
    for (const Behaviour& behaviour : half.behaviours) {
        const OpenBits next = bit_for(next_values, bits[0], behaviour.next, nexts);
        const OpenBits output = bit_for(output_values, bits[1], behaviour.output_byte(), outputs);
        OpenBits presets = 0;
        OpenBits none = no_timer | no_counter;
        if (behaviour.timer() != 0) {
            presets |= bit_for(timer_values, bits[2], behaviour.timer(), timers);
            none &= ~no_timer;
        }
        if (behaviour.counter() != 0) {
            presets |= bit_for(counter_values, bits[3], behaviour.counter(), counters);
            none &= ~no_counter;
        }
        wanted_.push_back(next | output | presets | none);
        demanded_.push_back((behaviour.leaves ? next : 0) | (behaviour.writes ? output : 0) | presets);
    }
}

}  // namespace nplc::seqc
