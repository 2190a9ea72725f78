#include "gateway/set_points.h"

#include <algorithm>
#include <utility>

#include "base/bytes.h"
#include "base/crc32.h"

namespace nplc::gateway {

using namespace registers::gateway;
using registers::set_points::Entry;

SetPoints::SetPoints(Gateway& gateway, ports::Storage& storage, const store::Area* area)
    : gateway_(gateway),
      available_(area != nullptr),
      store_(storage, area != nullptr ? *area : store::Area{}) {
    gateway.take_values_from(*this);
}

void SetPoints::mount() {
    if (!available_) return;
    damaged_ = !store_.mount();
    if (damaged_) gateway_.note(Event::store_damaged);
}

/// A value stored for another table is kept if name and unit are the same and the range contains it.
void SetPoints::use(std::span<std::uint8_t> table, std::span<const std::uint8_t> record) {
    ++edition_;
    table_ = table;
    record_ = registers::set_points::Record(record);
    record_crc_ = record.empty() ? 0 : base::crc32(record);
    if (record_crc_ != 0 && record_crc_ != changed_record_) first_change_ = changes_;
    if (record_crc_ != 0) changed_record_ = record_crc_;
    to_write_ = 0;
    is_for_other_table_ = true;
    wanted_ = {};
    for (std::size_t i = 0; i < record_.count(); ++i) wanted_[i] = record_.entry(i).initial();
    in_force_ = wanted_;
    if (record_.count() == 0 || !available_) return;
    const bool is_kept = !store_.image().wanted().is_empty();
    const std::uint16_t dropped = find_values(store_.image().wanted(), wanted_);
    if (is_kept) dropped_ = dropped;
    take_all();
}

/// Uses the default where the set has no valid value; returns a bit mask of these.
std::uint16_t SetPoints::find_values(store::ValueSet set, Values& values) const {
    std::uint16_t missing = 0;
    for (std::size_t i = 0; i < record_.count(); ++i) {
        const Entry entry = record_.entry(i);
        values[i] = entry.initial();
        if (set.find(entry, values[i]) && motor_takes(entry, values[i])) continue;
        values[i] = entry.initial();
        missing = static_cast<std::uint16_t>(missing | 1U << i);
    }
    return missing;
}

bool SetPoints::motor_takes(const Entry& entry, std::int32_t value) const {
    if (entry.kind() != registers::set_points::ValueKind::motor_register) return true;
    std::array<std::uint8_t, sequencer::kTermBytes> term;
    std::copy_n(&table_[std::size_t{entry.place(0)} * term.size()], term.size(), term.begin());
    registers::set_points::patch(term.data(), entry, value);
    return gateway_.motor_takes(term);
}

void SetPoints::patch(std::size_t index) {
    const Entry entry = record_.entry(index);
    for (std::size_t i = 0; i < entry.places(); ++i) {
        registers::set_points::patch(&table_[std::size_t{entry.place(i)} * sequencer::kTermBytes], entry,
                                     in_force_[index]);
    }
}

void SetPoints::take_all() {
    std::uint16_t count = 0;
    to_write_ = 0;
    for (std::size_t i = 0; i < record_.count(); ++i) {
        if (in_force_[i] == wanted_[i]) continue;
        ++count;
        if (record_.entry(i).is(registers::set_points::kAtPowerUp))
            to_write_ |= static_cast<std::uint16_t>(1U << i);
        in_force_[i] = wanted_[i];
        patch(i);
    }
    if (count != 0) gateway_.note(Event::set_points_taken, count);
}

bool SetPoints::has_change(std::uint8_t step) const {
    return record_.takes_at(step) &&
           (to_write_ != 0 ||
            !std::equal(wanted_.begin(), wanted_.begin() + static_cast<std::ptrdiff_t>(record_.count()),
                        in_force_.begin()));
}

/// In step 0 nothing is returned: POWER_UP writes all values itself.
std::optional<sequencer::MotorOrder> SetPoints::take(std::uint8_t step) {
    if (to_write_ == 0) take_all();
    if (step == 0) to_write_ = 0;
    for (std::size_t i = 0; i < record_.count(); ++i) {
        const auto bit = static_cast<std::uint16_t>(1U << i);
        if ((to_write_ & bit) == 0) continue;
        to_write_ = static_cast<std::uint16_t>(to_write_ & ~bit);
        const std::size_t at = std::size_t{record_.entry(i).place(0)} * sequencer::kTermBytes;
        return sequencer::order_of(sequencer::TermView(&table_[at], sequencer::kTermBytes));
    }
    return std::nullopt;
}

/// While stopped, changes take effect at once: a run begins at POWER_UP, which writes the values.
void SetPoints::poll() {
    if (!available_) return;
    store_.poll();
    end_request();
    if (dropped_ != 0) gateway_.note(Event::set_points_dropped, std::exchange(dropped_, 0));
    if (gateway_.run_state() != RunState::stopped) return;
    take_all();
    to_write_ = 0;
}

void SetPoints::show_defaults(std::span<std::uint8_t> part, std::size_t offset) const {
    for (std::size_t i = 0; i < record_.count(); ++i) {
        const Entry entry = record_.entry(i);
        for (std::size_t p = 0; p < entry.places(); ++p) {
            const std::size_t begin = std::size_t{entry.place(p)} * sequencer::kTermBytes;
            if (begin + sequencer::kTermBytes <= offset || begin >= offset + part.size()) continue;
            std::array<std::uint8_t, sequencer::kTermBytes> term;
            std::copy_n(&table_[begin], term.size(), term.begin());
            registers::set_points::patch(term.data(), entry, entry.initial());
            for (std::size_t b = 0; b < term.size(); ++b) {
                if (begin + b >= offset && begin + b < offset + part.size())
                    part[begin + b - offset] = term[b];
            }
        }
    }
}

[[gnu::noinline]] std::uint32_t SetPoints::value(std::uint8_t reg) {
    if (!available_) return 0;
    const std::size_t count = record_.count();
    if (reg >= SET_POINT_WANTED && reg < SET_POINT_WANTED + kSetPoints) {
        const std::size_t index = reg - std::size_t{SET_POINT_WANTED};
        return index < count ? static_cast<std::uint32_t>(wanted_[index]) : 0;
    }
    if (reg >= SET_POINT && reg < SET_POINT + kSetPoints) {
        const std::size_t index = reg - std::size_t{SET_POINT};
        return index < count ? static_cast<std::uint32_t>(in_force_[index]) : 0;
    }
    switch (reg) {
        case SET_POINT_COUNT:
            return static_cast<std::uint32_t>(count | registers::set_points::kMost << 8 |
                                              store::kRecipes << 16);
        case SET_POINT_STATE:
            return state_word();
        case SET_POINT_CRC: {
            std::uint32_t crc = 0;
            std::array<std::uint8_t, 4> bytes;
            for (std::size_t i = 0; i < count; ++i) {
                base::store_u32(bytes.data(), static_cast<std::uint32_t>(in_force_[i]));
                crc = base::crc32(bytes, crc);
            }
            return crc;
        }
        case SET_POINT_CHANGES:
            return changes_;
        case SET_POINT_RECORD:
            return record_crc_;
        case SET_POINT_BYTES:
            return static_cast<std::uint32_t>(record_.bytes().size());
        default:
            return 0;
    }
}

std::uint32_t SetPoints::state_word() {
    std::uint32_t word = std::uint32_t{store_.image().active()} << 8;
    if (in_force_ != wanted_) word |= kChangeWaits;
    if (damaged_) word |= kValuesDamaged;
    if (differs_from_recipe()) word |= kRecipeDiffers;
    return word;
}

bool SetPoints::differs_from_recipe() {
    const std::uint8_t active = store_.image().active();
    if (active == 0 || record_.count() == 0) return false;
    Values values{};
    find_values(store_.image().values_of(active), values);
    return !std::equal(wanted_.begin(), wanted_.begin() + static_cast<std::ptrdiff_t>(record_.count()),
                       values.begin());
}

void SetPoints::read(std::uint32_t pointer, std::span<std::uint8_t> out) {
    std::fill(out.begin(), out.end(), std::uint8_t{0});
    if (!available_) return;
    const std::size_t view = pointer >> 16;
    const std::size_t offset = pointer & 0xFFFF;
    if (view == static_cast<std::size_t>(SetPointView::changes)) return view_changes(offset, out);
    std::span<const std::uint8_t> bytes = record_.bytes();
    if (view == static_cast<std::size_t>(SetPointView::requests)) {
        bytes = {reinterpret_cast<const std::uint8_t*>(asked_.data()), sizeof asked_};
    } else if (view > store::kRecipes) {
        return;
    } else if (view != 0) {
        bytes = store_.image().recipe(view);
    }
    if (offset >= bytes.size()) return;
    const auto part = bytes.subspan(offset, std::min(out.size(), bytes.size() - offset));
    std::copy(part.begin(), part.end(), out.begin());
}

void SetPoints::read_window(std::span<std::uint8_t> out) {
    base::store_u32(out.data(), pointer_);
    read(pointer_, out.subspan(sizeof pointer_));
}

void SetPoints::view_changes(std::size_t offset, std::span<std::uint8_t> out) const {
    const std::size_t end = shown_changes() * kChangeBytes;
    for (std::uint8_t& byte : out) {
        if (offset >= end) return;
        byte = reinterpret_cast<const std::uint8_t*>(&change(offset / kChangeBytes))[offset % kChangeBytes];
        ++offset;
    }
}

}  // namespace nplc::gateway
