#include "verify/machine.h"

#include <algorithm>
#include <unordered_map>

namespace nplc::verify {
namespace {

using sequencer::MotorOrder;
using sequencer::Pending;
using sequencer::TermView;

constexpr std::size_t kRows = std::size_t{63} * 4;  // steps, timer and counter zero or not

/// Terms that are true together.
struct Outcome {
    Pending pending;
    std::vector<std::uint16_t> senders;
    bool error = false;   ///< driver only: what the motor may do next depends on it
    bool in_pos = false;  ///< it may end a motion
    bool operator==(const Outcome&) const = default;
};

struct OutcomeHash {
    std::size_t operator()(const Outcome& o) const {
        std::size_t hash = o.pending.next_step | (o.pending.output_byte << 8U) | (o.error ? 1U << 16U : 0U) |
                           (o.in_pos ? 1U << 17U : 0U);
        const auto mix = [&hash](std::size_t value) { hash = (hash ^ value) * 0x9E3779B97F4A7C15U; };
        mix(o.pending.timer_preset);
        mix(o.pending.counter_preset);
        for (const std::uint16_t term : o.senders) mix(term);
        return hash ^ (hash >> 29U);
    }
};

/// Command 01h clears the motor's errors and acknowledges a lost link; a write may reach ERR_STAT, with its
/// register before it too if it is a longword.
bool may_reset_error(const MotorOrder& order) {
    constexpr std::uint8_t kResetError = 0x61;
    constexpr std::uint8_t kErrStat = 35;
    if (!order.is_register_write) return order.command == kResetError;
    return order.reg == kErrStat || (order.longword && order.reg == kErrStat - 1);
}

}  // namespace

Machine::Machine(const sequencer::Table& table, Assume assume, const OrderTime& order_time,
                 const ImageSet& permitted, bool tells_motion)
    : assume_(assume),
      permitted_(permitted),
      tells_motion_(tells_motion),
      rows_(kRows),
      group_with_(kRows),
      first_(kRows) {
    for (std::size_t i = 0; i < table.size(); ++i) {
        const TermView term = table.term(i);
        steps_with_terms_ |= std::uint64_t{1} << sequencer::step_of(term);
        cared_bits_ = static_cast<std::uint8_t>(cared_bits_ | (term[2] & 0x7F));
        if (sequencer::is_flex(term)) continue;
        Pending pending;
        pending.fold(term);
        greatest_counter_ = std::max(greatest_counter_, pending.counter_preset);
    }
    for (std::uint8_t step = 0; step <= sequencer::kLastStep; ++step) fill_step(table, step, order_time);
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        first_[row] = group_count_;
        group_count_ += rows_[row].size();
    }
}

void Machine::fill_step(const sequencer::Table& table, std::uint8_t step, const OrderTime& order_time) {
    const bool driver = assume_ == Assume::driver;
    std::vector<std::uint16_t> own;
    const auto range = table.terms_of(step);
    for (std::uint16_t i = range.begin; i != range.end; ++i) {
        if (sequencer::step_of(table.term(i)) == step) own.push_back(i);
    }
    Outcome outcome;
    for (unsigned zeros = 0; zeros < 4; ++zeros) {
        std::vector<Group>& row = rows_[step * 4U + zeros];
        std::unordered_map<Outcome, std::size_t, OutcomeHash> known;
        for (unsigned image = 0; image < 256; ++image) {
            const auto key = static_cast<sequencer::Key>(image | (zeros << 8U));
            outcome.pending = {};
            outcome.senders.clear();
            outcome.error = driver && (image & sequencer::kError) != 0;
            outcome.in_pos = tells_motion_ && (image & sequencer::kInPos) != 0;
            for (const std::uint16_t index : own) {
                const TermView term = table.term(index);
                if (!sequencer::is_true(term, key)) continue;
                if (!sequencer::is_flex(term)) outcome.pending.fold(term);
                if (sequencer::has_order(term)) outcome.senders.push_back(index);
            }
            std::vector<std::uint16_t> senders = outcome.senders;
            if (!driver && !tells_motion_ && !senders.empty()) outcome.senders = {0};
            const auto [found, is_new] = known.try_emplace(outcome, row.size());
            if (is_new) {
                Group group;
                group.pending = outcome.pending;
                group.sends = !senders.empty();
                group.in_pos = outcome.in_pos;
                for (const std::uint16_t index : senders)
                    group.orders.push_back(sequencer::order_of(table.term(index)));
                group.resets_error = std::any_of(group.orders.begin(), group.orders.end(), may_reset_error);
                group.delay = {0, kMostIdle, 0};
                if (group.sends && driver) group.delay = order_time(group.orders);
                row.push_back(std::move(group));
            }
            row[found->second].images.set(image);
            group_with_[step * 4U + zeros][image] = static_cast<std::uint16_t>(found->second);
        }
    }
}

}  // namespace nplc::verify
