#include "sim/sim_storage.h"

#include <algorithm>
#include <array>
#include <utility>

namespace nplc::sim {
namespace {

constexpr std::array<std::uint8_t, 3> kEraseMasks{0x00, 0x55, 0x80};
constexpr std::array<std::uint8_t, 4> kProgramMasks{0x00, 0x55, 0xFE, 0x80};

std::uint8_t turned(std::uint8_t mask, std::uint32_t by) {
    const unsigned shift = by % 8;
    return static_cast<std::uint8_t>((mask << shift) | (mask >> (8 - shift)));
}

}  // namespace

SimStorage::SimStorage(const ports::StorageGeometry& geometry, unsigned busy_polls)
    : geometry_(geometry),
      busy_polls_(busy_polls),
      bytes_(geometry.size, 0xFF),
      programmed_(geometry.size / geometry.program_unit, false) {}

base::Status SimStorage::read(std::uint32_t address, std::span<std::uint8_t> out) {
    if (busy_ > 0) return base::Error::busy;
    if (!geometry_.can_read(address, out.size())) return base::Error::bad_geometry;
    std::copy_n(bytes_.data() + address, out.size(), out.begin());
    return {};
}

base::Status SimStorage::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
    if (busy_ > 0) return base::Error::busy;
    if (bytes.empty() || !geometry_.can_program(address, bytes.size())) return base::Error::bad_geometry;
    begin({.is_erase = false, .address = address, .bytes = {bytes.begin(), bytes.end()}});
    return {};
}

base::Status SimStorage::erase(std::uint32_t address) {
    if (busy_ > 0) return base::Error::busy;
    if (!geometry_.can_erase(address)) return base::Error::bad_geometry;
    begin({.is_erase = true, .address = address, .bytes = {}});
    return {};
}

ports::StorageState SimStorage::state() {
    if (busy_ > 0) {
        --busy_;
        return ports::StorageState::busy;
    }
    return failed_ ? ports::StorageState::failed : ports::StorageState::ready;
}

void SimStorage::begin(const StorageOperation& operation) {
    if (watcher_) watcher_(operation);
    failed_ = fail_at_ == operations_;
    ++operations_;
    busy_ = busy_polls_;
    if (!failed_) carry_out(operation);
}

void SimStorage::carry_out(const StorageOperation& operation) {
    if (operation.is_erase) {
        std::fill_n(bytes_.data() + operation.address, geometry_.erase_block, std::uint8_t{0xFF});
        const std::uint32_t first = operation.address / geometry_.program_unit;
        for (std::uint32_t i = 0; i < geometry_.erase_block / geometry_.program_unit; ++i)
            programmed_[first + i] = false;
        return;
    }
    for (std::uint32_t i = 0; i < operation.bytes.size(); ++i) {
        if (i % geometry_.program_unit == 0) {
            const std::uint32_t unit = (operation.address + i) / geometry_.program_unit;
            if (programmed_[unit]) ++programmed_twice_;
            programmed_[unit] = true;
        }
        change(operation.address + i, operation.bytes[i], 0xFF);
    }
}

/// Clears the bits of `mask` that are 0 in `value`, except worn-out ones.
void SimStorage::change(std::uint32_t address, std::uint8_t value, std::uint8_t mask) {
    auto kept = static_cast<std::uint8_t>(value | ~mask);
    if (worn_ && worn_->address == address) kept = static_cast<std::uint8_t>(kept | (1U << worn_->bit));
    bytes_[address] = bytes_[address] & kept;
}

SimStorage SimStorage::torn(const StorageOperation& operation, const Tear& tear) const {
    SimStorage after(*this);
    after.watcher_ = nullptr;
    after.busy_ = 0;
    after.failed_ = false;
    if (operation.is_erase) {
        for (std::uint32_t i = 0; i < geometry_.erase_block; ++i) {
            std::uint8_t& byte = after.bytes_[operation.address + i];
            const bool as_it_was = (i < tear.bytes) != tear.from_start;
            byte = as_it_was ? static_cast<std::uint8_t>(byte | turned(tear.mask, i)) : std::uint8_t{0xFF};
        }
        return after;
    }
    const std::uint32_t done =
        std::min<std::uint32_t>(tear.bytes, static_cast<std::uint32_t>(operation.bytes.size()));
    StorageOperation whole{false, operation.address, {operation.bytes.data(), operation.bytes.data() + done}};
    after.carry_out(whole);
    for (std::uint32_t i = done; i < operation.bytes.size() && i < done + geometry_.program_unit; ++i) {
        after.change(operation.address + i, operation.bytes[i], turned(tear.mask, i));
        if (tear.mask != 0) after.programmed_[(operation.address + i) / geometry_.program_unit] = true;
    }
    return after;
}

void SimStorage::flip(std::uint32_t address, unsigned bit) {
    bytes_[address] = static_cast<std::uint8_t>(bytes_[address] ^ (1U << bit));
}

void SimStorage::fill(std::uint32_t address, std::uint32_t count, std::uint8_t value) {
    std::fill_n(bytes_.data() + address, count, value);
}

std::vector<Tear> tears_of(const StorageOperation& operation, const ports::StorageGeometry& geometry) {
    std::vector<Tear> tears;
    if (operation.is_erase) {
        const std::uint32_t block = geometry.erase_block;
        for (const std::uint32_t bytes : std::initializer_list<std::uint32_t>{block, block / 2, 1U, 0U}) {
            for (const std::uint8_t mask : kEraseMasks) tears.push_back({bytes, false, mask});
            tears.push_back({bytes, true, 0x24});
        }
        return tears;
    }
    for (std::uint32_t done = 0; done < operation.bytes.size(); done += geometry.program_unit) {
        for (const std::uint8_t mask : kProgramMasks) tears.push_back({done, false, mask});
    }
    tears.push_back({static_cast<std::uint32_t>(operation.bytes.size()), false, 0});
    return tears;
}

}  // namespace nplc::sim
