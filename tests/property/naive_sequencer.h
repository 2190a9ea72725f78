#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// 001 §6.1 once more, word by word and as slow as it reads: the whole table is walked and every field taken
/// out of its bits each scan. It shares no code with sequencer/ and includes nothing of ours, so that a
/// mistake of one of the two shows as a difference.
namespace nplc::naive {

using Bytes = std::vector<std::uint8_t>;

struct Order {
    bool flex = false;
    int number = 0;  ///< FastMAC command or FlexMAC register
    bool longword = false;
    std::int64_t value = 0;
    bool operator==(const Order&) const = default;
};

enum class Refusal { none, ragged, no_end, too_long, next_step_63, register_0 };

struct Judgement {
    Refusal refusal = Refusal::none;
    int term = 0;   ///< the refused term
    int terms = 0;  ///< how many terms the table has, when it is not refused
};

Judgement judge(const Bytes& table, int most_terms);

class Sequencer {
  public:
    /// `table` is one that judge() does not refuse.
    explicit Sequencer(Bytes table) : table_(std::move(table)) {}

    /// Items 1 to 3 of §6.1.9. `hw_inp` as there: inputs in bits 5..0, INPOS bit 6, ERROR bit 7.
    std::vector<Order> scan(int hw_inp);

    /// Item 4.
    void adjust_timer(std::int64_t milliseconds);

    int step = 0;
    int outputs = 0;
    int timer = 0;
    int counter = 0;

    /// Of the last scan: the terms that were true, and whether one of them preset the timer.
    std::vector<int> true_terms;
    bool timer_was_preset = false;

    std::string text() const;

  private:
    int bit(int term, int byte, int number) const;
    int bits(int term, int byte, int from, int to) const;
    int word(int term, int byte) const;
    bool condition(int term, int hw_inp) const;

    Bytes table_;
};

}  // namespace nplc::naive
