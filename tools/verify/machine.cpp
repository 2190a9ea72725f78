#include "verify/machine.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace nplc::verify {
namespace {

using sequencer::MotorOrder;
using sequencer::Pending;
using sequencer::TermView;

constexpr std::size_t kRows = std::size_t{63} * 4;  // steps, timer and counter zero or not

/// Terms that are true together, and the images with which they are.
struct ScanResult {
    Pending pending;
    std::vector<std::uint16_t> senders;
    bool error = false;   ///< driver only: what the motor may do next depends on it
    bool in_pos = false;  ///< it may end a motion
    bool disturbs = false;
    bool operator==(const ScanResult&) const = default;
};

struct Class {
    ScanResult outcome;
    ImageSet images;
};

struct ScanResultHash {
    std::size_t operator()(const ScanResult& o) const {
        std::size_t hash = o.pending.next_step | (std::size_t{o.pending.output_byte} << 8U) |
                           (o.error ? 1U << 16U : 0U) | (o.in_pos ? 1U << 17U : 0U) |
                           (o.disturbs ? 1U << 18U : 0U);
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

/// For which images a term is true, if timer and counter let it.
ImageSet images_of(TermView term) {
    ImageSet set = ~ImageSet{};
    const unsigned compared = (term[2] & 0x7FU) | sequencer::kError;
    for (unsigned bit = 0; bit < 8; ++bit) {
        if (((compared >> bit) & 1U) == 0) continue;
        set &= ((static_cast<unsigned>(term[1]) >> bit) & 1U) != 0 ? images_with_bit(bit)
                                                                   : ~images_with_bit(bit);
    }
    return set;
}

/// Splits the classes by whether an image is of `set`; `apply` changes the outcome of those that are.
template <class Apply>
void split(std::vector<Class>& classes, const ImageSet& set, const Apply& apply) {
    const std::size_t count = classes.size();
    for (std::size_t i = 0; i < count; ++i) {
        const ImageSet within = classes[i].images & set;
        if (within.none()) continue;
        if (within != classes[i].images) {
            classes.push_back({classes[i].outcome, classes[i].images & ~set});
            classes[i].images = within;
        }
        apply(classes[i].outcome);
    }
}

bool can_be_true(TermView term, unsigned zeros) {
    const bool timer = (zeros & 1U) != 0 || (term[0] & 0x80U) != 0;
    const bool counter = (zeros & 2U) != 0 || (term[0] & 0x40U) != 0;
    return timer && counter;
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
    std::array<std::vector<std::uint16_t>, sequencer::kLastStep + 1> terms;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const TermView term = table.term(i);
        const std::uint8_t step = sequencer::step_of(term);
        terms[step].push_back(static_cast<std::uint16_t>(i));
        steps_with_terms_ |= std::uint64_t{1} << step;
        cared_bits_ = static_cast<std::uint8_t>(cared_bits_ | (term[2] & 0x7F));
        if (sequencer::is_flex(term)) continue;
        Pending pending;
        pending.fold(term);
        greatest_counter_ = std::max(greatest_counter_, pending.counter_preset);
        if ((pending.output_byte & 0x80U) != 0) steps_that_count_ |= std::uint64_t{1} << step;
    }
    for (const auto& own : terms) {
        for (unsigned zeros = 0; zeros < 4; ++zeros) fill_row(table, own, zeros, order_time);
    }
    first_.push_back(groups_.size());
}

void Machine::fill_row(const sequencer::Table& table, const std::vector<std::uint16_t>& terms, unsigned zeros,
                       const OrderTime& order_time) {
    const bool driver = assume_ == Assume::driver;
    std::vector<Class> classes(1);
    classes[0].images.set();
    if (driver) {
        split(classes, images_with_bit(7), [](ScanResult& outcome) { outcome.error = true; });
    }
    if (tells_motion_) {
        split(classes, images_with_bit(6), [](ScanResult& outcome) { outcome.in_pos = true; });
    }
    if (move_ms_ != 0) {
        split(classes, images_with_bit(7), [](ScanResult& outcome) { outcome.disturbs = true; });
    }
    for (const std::uint16_t index : terms) {
        const TermView term = table.term(index);
        if (!can_be_true(term, zeros)) continue;
        split(classes, images_of(term), [&](ScanResult& outcome) {
            if (!sequencer::is_flex(term)) outcome.pending.fold(term);
            if (sequencer::has_order(term)) outcome.senders.push_back(index);
        });
    }
    std::sort(classes.begin(), classes.end(),
              [](const Class& a, const Class& b) { return a.images._Find_first() < b.images._Find_first(); });
    first_.push_back(groups_.size());
    auto& group_with = group_with_[first_.size() - 1];
    std::unordered_map<ScanResult, std::uint32_t, ScanResultHash> known;
    for (Class& one : classes) {
        const std::vector<std::uint16_t> senders = one.outcome.senders;
        if (!driver && !tells_motion_ && !senders.empty()) one.outcome.senders = {0};
        const auto [found, is_new] =
            known.try_emplace(std::move(one.outcome), static_cast<std::uint32_t>(groups_.size()));
        if (is_new) add_group(table, found->first.pending, senders, order_time);
        Group& group = groups_[found->second];
        group.error = found->first.error;
        group.in_pos = found->first.in_pos;
        group.disturbs = found->first.disturbs;
        group.images |= one.images;
        for (std::size_t image = one.images._Find_first(); image < 256; image = one.images._Find_next(image))
            group_with[image] = static_cast<std::uint16_t>(found->second);
    }
}

void Machine::add_group(const sequencer::Table& table, const Pending& pending,
                        const std::vector<std::uint16_t>& senders, const OrderTime& order_time) {
    Group group;
    group.number = static_cast<std::uint32_t>(groups_.size());
    group.pending = pending;
    group.sends = !senders.empty();
    for (const std::uint16_t index : senders) group.orders.push_back(sequencer::order_of(table.term(index)));
    group.resets_error = std::any_of(group.orders.begin(), group.orders.end(), may_reset_error);
    group.delay = {0, kMostIdle, 0};
    if (group.sends && assume_ == Assume::driver) group.delay = order_time(group.orders);
    groups_.push_back(std::move(group));
}

}  // namespace nplc::verify
