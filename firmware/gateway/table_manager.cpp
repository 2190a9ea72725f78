#include "gateway/table_manager.h"

#include <algorithm>

#include "base/bytes.h"
#include "base/crc32.h"
#include "registers/gateway.h"

namespace nplc::gateway {

using store::Phase;

namespace {

/// The bytes behind the end term.
std::span<const std::uint8_t> behind_end_of(std::span<const std::uint8_t> content) {
    std::size_t end = 0;
    while (end < content.size() && (content[end] & 0x3FU) != sequencer::kEndOfTable)
        end += sequencer::kTermBytes;
    return content.subspan(std::min(end + sequencer::kTermBytes, content.size()));
}

/// Mark and digest of the certificate, if `bytes` holds nothing else.
std::span<const std::uint8_t> proof_in(std::span<const std::uint8_t> bytes) {
    using namespace registers::gateway;
    const bool is_one =
        bytes.size() == kProofBytes && std::equal(kProofMark.begin(), kProofMark.end(), bytes.begin());
    return is_one ? bytes : std::span<const std::uint8_t>();
}

}  // namespace

void TableManager::mount() {
    is_readable_ = slots_.mount().ok();
    if (!is_readable_ || slots_.is_fallback()) gateway_.note(Event::store_damaged);
}

/// A damaged store is reported as a bad table, not as an empty board.
CommandResult TableManager::start(base::Instant now) {
    CommandResult outcome = Result::nothing_stored;
    if (slots_.has_current() || slots_.is_fallback()) {
        outcome = load_stored(now);
        if (slots_.is_fallback()) gateway_.block_start(SafeReason::bad_table);
        if (set_points_.were_damaged() && SetPointsPart::record_bytes(behind_) != 0)
            gateway_.block_start(SafeReason::bad_set_points);
    }
    gateway_.end_start_up();
    return outcome;
}

Gateway::LoadResult TableManager::use(std::span<const std::uint8_t> table, base::Instant now) {
    const std::size_t length = std::min(table.size(), memory_.size());
    std::copy_n(table.begin(), length, memory_.begin());
    return take(length, now);
}

Gateway::LoadResult TableManager::take(std::size_t length, base::Instant now) {
    const auto content = memory_.first(length);
    behind_ = behind_end_of(content);
    const std::size_t record_bytes = SetPointsPart::record_bytes(behind_);
    const auto record = behind_.first(std::min(record_bytes, behind_.size()));
    set_points_.use({}, {});
    const auto table = content.first(length - behind_.size());
    const bool fits =
        record_bytes == record.size() && (record.empty() || SetPointsPart::is_sound(record, table));
    if (set_points_.were_damaged() && !record.empty()) gateway_.end_start_up();
    auto result = gateway_.load(fits ? content : content.first(0), now, !proof().empty());
    if (!fits) result.fault = {base::Error::bad_set_points, 0};
    active_ = result.ok ? table : std::span<const std::uint8_t>();
    active_crc_ = active_.empty() ? 0 : base::crc32(active_);
    if (result.ok) set_points_.use(table, record);
    return result;
}

std::span<const std::uint8_t> TableManager::proof() const {
    return proof_in(behind_.subspan(std::min(SetPointsPart::record_bytes(behind_), behind_.size())));
}

CommandResult TableManager::load_stored(base::Instant now) {
    const auto length = slots_.load(memory_);
    if (!length && length.error() == base::Error::busy) return {Result::busy};
    if (slots_.is_fallback()) gateway_.end_start_up();
    const auto loaded = take(length ? length.value() : 0, now);
    if (!length) return {Result::nothing_stored};
    if (!loaded.ok) return {result_of(loaded.fault.error), loaded.fault.term};
    gateway_.note(Event::table_activated);
    return {};
}

void TableManager::poll() {
    slots_.poll();
    const Phase phase = slots_.phase();
    if (phase == last_phase_) return;
    last_phase_ = phase;
    if (phase == Phase::done) gateway_.note(Event::table_stored);
    if (phase == Phase::failed)
        gateway_.note(Event::upload_failed, static_cast<std::uint16_t>(result_of(slots_.error())));
}

void TableManager::abandon_upload() {
    constexpr std::uint32_t kMost = 0xFFFF;
    if (uploads())
        gateway_.note(Event::upload_aborted, static_cast<std::uint16_t>(std::min(kMost, uploaded())));
    slots_.abandon();
}

base::Status TableManager::begin_upload() {
    abandon_upload();
    return slots_.begin();
}

bool TableManager::uploads() const {
    const Phase phase = slots_.phase();
    return phase == Phase::erasing || phase == Phase::receiving || phase == Phase::closing;
}

std::uint32_t TableManager::upload_state() const {
    const auto phase = static_cast<std::uint32_t>(slots_.phase());
    if (slots_.phase() != Phase::failed) return phase;
    const auto result = static_cast<std::uint32_t>(result_of(slots_.error()));
    return phase | (result << 8) | (std::uint32_t{check_.fault_term()} << 16);
}

void TableManager::begin_activation(base::Instant now) {
    gateway_.end_start_up();
    standstill_.begin(now);
}

PendingResult TableManager::poll_activation(base::Instant now) {
    if (gateway_.run_state() != RunState::stopped) return CommandResult{Result::not_stopped};
    if (!slots_.has_current()) return CommandResult{Result::nothing_stored};
    const PendingResult still = standstill_.poll(now);
    if (!still.is_done()) return still;
    return load_stored(now);
}

std::uint32_t TableManager::capacity() const {
    return std::min(slots_.capacity(), static_cast<std::uint32_t>(memory_.size()));
}

bool TableManager::stored_is_active() const {
    const store::Header stored = slots_.current();
    return stored.length == active_.size() + behind_.size() &&
           stored.crc == base::crc32(behind_, active_crc_);
}

std::uint32_t TableManager::proof_word(std::size_t index) const {
    const auto bytes = proof();
    if (bytes.empty()) return 0;
    return base::load_u32(&bytes[registers::gateway::kProofMark.size() + 4 * index]);
}

}  // namespace nplc::gateway
