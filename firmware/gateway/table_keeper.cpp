#include "gateway/table_keeper.h"

#include <algorithm>

#include "base/bytes.h"
#include "base/crc32.h"
#include "registers/gateway.h"

namespace nplc::gateway {

using store::Phase;

namespace {

/// The mark and the digest, if nothing but they follow the end term.
std::span<const std::uint8_t> trailer_of(std::span<const std::uint8_t> content) {
    using namespace registers::gateway;
    std::size_t end = 0;
    while (end < content.size() && (content[end] & 0x3FU) != sequencer::kEndOfTable)
        end += sequencer::kTermBytes;
    end += sequencer::kTermBytes;
    if (content.size() != end + kProofBytes) return {};
    const auto trailer = content.subspan(end);
    return std::equal(kProofMark.begin(), kProofMark.end(), trailer.begin())
               ? trailer
               : std::span<const std::uint8_t>();
}

}  // namespace

void TableKeeper::mount() {
    is_readable_ = slots_.mount().ok();
    if (!is_readable_ || slots_.is_fallback()) gateway_.note(Event::store_damaged);
}

/// A store that held a table and has none that is whole is a bad table, not a new board.
Outcome TableKeeper::start(base::Instant now) {
    Outcome outcome = Result::nothing_stored;
    if (slots_.has_current() || slots_.is_fallback()) {
        outcome = load_stored(now);
        if (slots_.is_fallback()) gateway_.block_start(SafeReason::bad_table);
    }
    gateway_.end_start_up();
    return outcome;
}

Gateway::LoadResult TableKeeper::use(std::span<const std::uint8_t> table, base::Instant now) {
    const std::size_t length = std::min(table.size(), memory_.size());
    std::copy_n(table.begin(), length, memory_.begin());
    return take(length, now);
}

Gateway::LoadResult TableKeeper::take(std::size_t length, base::Instant now) {
    trailer_ = trailer_of(memory_.first(length));
    const auto result = gateway_.load(memory_.first(length), now, !trailer_.empty());
    active_ = result.ok ? memory_.first((gateway_.table().size() + 1) * sequencer::kTermBytes)
                        : std::span<const std::uint8_t>();
    active_crc_ = active_.empty() ? 0 : base::crc32(active_);
    return result;
}

Outcome TableKeeper::load_stored(base::Instant now) {
    const auto length = slots_.load(memory_);
    if (!length && length.error() == base::Error::busy) return {Result::busy};
    if (slots_.is_fallback()) gateway_.end_start_up();
    const auto loaded = take(length ? length.value() : 0, now);
    if (!length) return {Result::nothing_stored};
    if (!loaded.ok) return {result_of(loaded.fault.error), loaded.fault.term};
    gateway_.note(Event::table_activated);
    return {};
}

void TableKeeper::poll() {
    slots_.poll();
    const Phase phase = slots_.phase();
    if (phase == last_phase_) return;
    last_phase_ = phase;
    if (phase == Phase::done) gateway_.note(Event::table_stored);
    if (phase == Phase::failed)
        gateway_.note(Event::upload_failed, static_cast<std::uint16_t>(result_of(slots_.error())));
}

void TableKeeper::abandon_upload() {
    constexpr std::uint32_t kMost = 0xFFFF;
    if (uploads())
        gateway_.note(Event::upload_given_up, static_cast<std::uint16_t>(std::min(kMost, uploaded())));
    slots_.abandon();
}

base::Status TableKeeper::begin_upload() {
    abandon_upload();
    return slots_.begin();
}

bool TableKeeper::uploads() const {
    const Phase phase = slots_.phase();
    return phase == Phase::erasing || phase == Phase::receiving || phase == Phase::closing;
}

std::uint32_t TableKeeper::upload_state() const {
    const auto phase = static_cast<std::uint32_t>(slots_.phase());
    if (slots_.phase() != Phase::failed) return phase;
    const auto result = static_cast<std::uint32_t>(result_of(slots_.error()));
    return phase | (result << 8) | (std::uint32_t{check_.fault_term()} << 16);
}

void TableKeeper::begin_activation(base::Instant now) {
    gateway_.end_start_up();
    standstill_.begin(now);
}

Progress TableKeeper::poll_activation(base::Instant now) {
    if (gateway_.run_state() != RunState::stopped) return Outcome{Result::not_stopped};
    if (!slots_.has_current()) return Outcome{Result::nothing_stored};
    const Progress still = standstill_.poll(now);
    if (!still.is_done()) return still;
    return load_stored(now);
}

std::uint32_t TableKeeper::capacity() const {
    return std::min(slots_.capacity(), static_cast<std::uint32_t>(memory_.size()));
}

bool TableKeeper::stored_is_active() const {
    const store::Header stored = slots_.current();
    return stored.length == active_.size() + trailer_.size() &&
           stored.crc == base::crc32(trailer_, active_crc_);
}

std::uint32_t TableKeeper::proof_word(std::size_t index) const {
    if (trailer_.empty()) return 0;
    return base::load_u32(&trailer_[registers::gateway::kProofMark.size() + 4 * index]);
}

}  // namespace nplc::gateway
