#include "hal_mcu/nrf51/flash.h"

#include <algorithm>

#include "base/bytes.h"
#include "registers.h"

namespace nplc::hal_mcu::nrf51 {

using ports::StorageState;

namespace {

bool is_ready() {
    return (flash_controller().READY & 1U) != 0;
}

}  // namespace

ports::StorageGeometry Flash::geometry() const {
    return {.size = size_, .erase_block = kPage, .program_page = kPage, .program_unit = kWord};
}

base::Status Flash::read(std::uint32_t address, std::span<std::uint8_t> out) {
    if (state() == StorageState::busy) return base::Error::busy;
    if (!geometry().can_read(address, out.size())) return base::Error::bad_geometry;
    const auto* const bytes = reinterpret_cast<const volatile std::uint8_t*>(begin_ + address);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = bytes[i];
    return {};
}

base::Status Flash::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
    if (state() == StorageState::busy) return base::Error::busy;
    if (!geometry().can_program(address, bytes.size())) return base::Error::bad_geometry;
    at_ = begin_ + address;
    to_program_ = bytes;
    return {};
}

base::Status Flash::erase(std::uint32_t address) {
    if (state() == StorageState::busy) return base::Error::busy;
    if (!geometry().can_erase(address)) return base::Error::bad_geometry;
    flash_controller().CONFIG = kFlashErases;
    flash_controller().ERASEPAGE = begin_ + address;
    return {};
}

/// Programs some words per call: a millisecond at the most.
StorageState Flash::state() {
    constexpr int kAtOnce = 16;
    for (int i = 0; i < kAtOnce && !to_program_.empty() && is_ready(); ++i) {
        flash_controller().CONFIG = kFlashWrites;
        block<Register>(at_) = base::load_u32(to_program_.data());
        at_ += kWord;
        to_program_ = to_program_.subspan(kWord);
    }
    if (!is_ready() || !to_program_.empty()) return StorageState::busy;
    flash_controller().CONFIG = kFlashReads;
    return StorageState::ready;
}

}  // namespace nplc::hal_mcu::nrf51
