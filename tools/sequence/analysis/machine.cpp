#include "analysis/machine.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "table/orders.h"

namespace nplc::verify {
namespace {

using table::Outcome;

constexpr std::size_t kSteps = sequencer::kLastStep + 1U;
constexpr std::size_t kRows = kSteps * 4;  // timer and counter zero or not
constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// What a scan does, and only whether it sends.
std::uint64_t without_orders(const Outcome& outcome) {
    const unsigned outputs = outcome.outputs ? 0x10U | *outcome.outputs : 0U;
    const unsigned small = outcome.next | outputs << 8U | static_cast<unsigned>(outcome.counter) << 16U |
                           (outcome.sends() ? 1U << 24U : 0U);
    return std::uint64_t{outcome.timer} << 48U | std::uint64_t{outcome.counter_preset} << 32U | small;
}

/// For each outcome the first one with the same effect, orders apart.
std::vector<std::size_t> alike(const std::vector<Outcome>& outcomes) {
    std::unordered_map<std::uint64_t, std::size_t> known;
    std::vector<std::size_t> result;
    for (const Outcome& outcome : outcomes)
        result.push_back(known.try_emplace(without_orders(outcome), result.size()).first->second);
    return result;
}

}  // namespace

Machine::Machine(const sequencer::Table& table, Assume assume, const OrderTime& order_time,
                 const ImageSet& permitted, bool tells_motion, std::uint32_t move_ms, PresetRanges ranges)
    : assume_(assume),
      permitted_(permitted),
      tells_motion_(tells_motion || move_ms != 0),
      move_ms_(move_ms),
      ranges_(std::move(ranges)),
      group_with_(kRows) {
    std::vector<sequencer::TermView> terms;
    for (std::size_t i = 0; i < table.size(); ++i) terms.push_back(table.term(i));
    for (std::uint8_t number = 0; number < kSteps; ++number) {
        const table::Step step = table::step_of(number, terms);
        const std::uint64_t bit = std::uint64_t{1} << number;
        if (step.terms != 0) steps_with_terms_ |= bit;
        cared_bits_ = static_cast<std::uint8_t>(cared_bits_ | step.compared);
        for (const Outcome& outcome : step.outcomes) {
            greatest_counter_ = std::max(greatest_counter_, outcome.counter_preset);
            if (outcome.counter == table::CounterChange::count_down) steps_that_count_ |= bit;
        }
        std::vector<std::size_t> kinds = alike(step.outcomes);
        if (assume == Assume::driver || tells_motion_) std::iota(kinds.begin(), kinds.end(), std::size_t{0});
        for (unsigned zeros = 0; zeros < 4; ++zeros) fill_row(step, kinds, zeros, order_time);
    }
    first_.push_back(groups_.size());
}

void Machine::fill_row(const table::Step& step, const std::vector<std::size_t>& kinds, unsigned zeros,
                       const OrderTime& order_time) {
    const bool tells_error = assume_ == Assume::driver || move_ms_ != 0;
    const unsigned told =
        (tells_error ? unsigned{sequencer::kError} : 0U) | (tells_motion_ ? unsigned{sequencer::kInPos} : 0U);
    auto& group_with = group_with_[first_.size()];
    first_.push_back(groups_.size());
    std::vector<std::array<std::uint32_t, 4>> known(step.outcomes.size(), {kNone, kNone, kNone, kNone});
    for (unsigned image = 0; image < 256; ++image) {
        const std::size_t number = step.of_case[zeros << 8U | image];
        std::uint32_t& group = known[kinds[number]][(image & told) >> 6U];
        if (group == kNone) {
            group = static_cast<std::uint32_t>(groups_.size());
            add_group(step.outcomes[number], image & told, order_time);
        }
        groups_[group].images.set(image);
        group_with[image] = static_cast<std::uint16_t>(group);
    }
}

/// `told`: ERROR and INPOS of its images, as far as they are distinguished.
void Machine::add_group(const Outcome& outcome, unsigned told, const OrderTime& order_time) {
    const bool driver = assume_ == Assume::driver;
    const bool error = (told & sequencer::kError) != 0;
    Group& group = groups_.emplace_back();
    group.number = static_cast<std::uint32_t>(groups_.size() - 1);
    group.outcome = outcome;
    group.error = driver && error;
    group.in_pos = (told & sequencer::kInPos) != 0;
    group.disturbs = move_ms_ != 0 && error;
    group.resets_error = std::any_of(outcome.orders.begin(), outcome.orders.end(), table::may_reset_error);
    group.delay = {0, kMostIdle, 0};
    if (outcome.sends() && driver) group.delay = order_time(outcome.orders);
}

}  // namespace nplc::verify
