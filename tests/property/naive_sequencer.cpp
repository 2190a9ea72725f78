#include "naive_sequencer.h"

namespace nplc::naive {
namespace {

int bit_of(const Bytes& table, std::size_t position, int number) {
    int divisor = 1;
    for (int i = 0; i < number; ++i) divisor *= 2;
    return table[position] / divisor % 2;
}

int bits_of(const Bytes& table, std::size_t position, int from, int to) {
    int value = 0;
    for (int number = from; number >= to; --number) value = value * 2 + bit_of(table, position, number);
    return value;
}

std::size_t position_of(int term, int byte) {
    return static_cast<std::size_t>(term) * 8 + static_cast<std::size_t>(byte);
}

}  // namespace

Judgement judge(const Bytes& table, int most_terms) {
    for (int term = 0;; ++term) {
        const std::size_t first = position_of(term, 0);
        if (first == table.size()) return {Refusal::no_end, term, 0};
        if (first + 8 > table.size()) return {Refusal::ragged, term, 0};
        if (bits_of(table, first, 5, 0) == 63) return {Refusal::none, 0, term};
        if (term == most_terms) return {Refusal::too_long, term, 0};
        const bool flex = bit_of(table, position_of(term, 2), 7) == 1;
        if (!flex && bits_of(table, position_of(term, 3), 5, 0) == 63) {
            return {Refusal::next_step_63, term, 0};
        }
        if (flex && bits_of(table, position_of(term, 3), 6, 0) == 0) return {Refusal::register_0, term, 0};
    }
}

int Sequencer::bit(int term, int byte, int number) const {
    return bit_of(table_, position_of(term, byte), number);
}

int Sequencer::bits(int term, int byte, int from, int to) const {
    return bits_of(table_, position_of(term, byte), from, to);
}

int Sequencer::word(int term, int byte) const {
    return bits(term, byte, 7, 0) + 256 * bits(term, byte + 1, 7, 0);
}

bool Sequencer::condition(int term, int hw_inp) const {
    if (bits(term, 0, 5, 0) != step) return false;
    const bool counter_bit = bit(term, 0, 6) == 1;
    if (!counter_bit && counter != 0) return false;
    const bool timer_bit = bit(term, 0, 7) == 1;
    if (!timer_bit && timer != 0) return false;

    int rest = hw_inp;
    for (int number = 0; number <= 6; ++number) {
        const int is = rest % 2;
        rest = rest / 2;
        const bool care = bit(term, 2, number) == 1;
        if (care && bit(term, 1, number) != is) return false;
    }
    const int error = rest % 2;
    return bit(term, 1, 7) == error;
}

std::vector<Order> Sequencer::scan(int hw_inp) {
    std::optional<int> temporary_step;
    std::optional<int> temporary_output;
    std::optional<int> temporary_timer;
    std::optional<int> temporary_counter;
    std::vector<Order> sent;
    true_terms.clear();

    for (int term = 0; bits(term, 0, 5, 0) != 63; ++term) {
        if (!condition(term, hw_inp)) continue;
        true_terms.push_back(term);
        if (bit(term, 2, 7) == 1) {
            const bool longword = bit(term, 3, 7) == 1;
            std::int64_t value = word(term, 4);
            if (longword) value += std::int64_t{65536} * word(term, 6);
            sent.push_back({true, bits(term, 3, 6, 0), longword, value});
            continue;
        }
        if (bit(term, 4, 7) == 0) sent.push_back({false, bits(term, 4, 6, 0), false, 0});
        if (bits(term, 3, 5, 0) != 0x3E) temporary_step = bits(term, 3, 5, 0);
        temporary_output = bits(term, 5, 7, 0);
        const int preset = word(term, 6);
        if (preset > 0 && bit(term, 3, 6) == 1) temporary_counter = preset;
        if (preset > 0 && bit(term, 3, 6) == 0) temporary_timer = preset;
    }

    timer_was_preset = temporary_timer.has_value();
    if (temporary_step) step = *temporary_step;
    if (temporary_output) {
        outputs = *temporary_output % 16;
        const bool clear = *temporary_output / 64 % 2 == 1;
        const bool down = *temporary_output / 128 == 1;
        if (clear) {
            counter = 0;
        } else if (temporary_counter) {
            counter = *temporary_counter;
        } else if (down && counter > 0) {
            counter = counter - 1;
        }
    }
    if (temporary_timer) timer = *temporary_timer;
    return sent;
}

void Sequencer::adjust_timer(std::int64_t milliseconds) {
    const std::int64_t left = timer - milliseconds;
    timer = left > 0 ? static_cast<int>(left) : 0;
}

std::string Sequencer::text() const {
    return "step " + std::to_string(step) + " outputs " + std::to_string(outputs) + " timer " +
           std::to_string(timer) + " counter " + std::to_string(counter);
}

}  // namespace nplc::naive
