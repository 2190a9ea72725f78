#include "hal_mcu/stellaris/flash.h"

#include "base/bytes.h"

namespace nplc::hal_mcu::stellaris {

using ports::StorageState;

namespace {

// Register offsets of the flash controller.
constexpr std::uint32_t kFma = 0x000;
constexpr std::uint32_t kFmd = 0x004;
constexpr std::uint32_t kFmc = 0x008;
constexpr std::uint32_t kFcris = 0x00C;
constexpr std::uint32_t kFcmisc = 0x014;

constexpr std::uint32_t kKey = 0xA442U << 16;
constexpr std::uint32_t kWrite = 1U << 0;
constexpr std::uint32_t kErase = 1U << 1;
constexpr std::uint32_t kAccessViolated = 1U << 0;  // of FCRIS; cleared in FCMISC

}  // namespace

ports::StorageGeometry Flash::geometry() const {
    return {.size = size_, .erase_block = kPage, .program_page = kPage, .program_unit = kWord};
}

base::Status Flash::read(std::uint32_t address, std::span<std::uint8_t> out) {
    if (state() == StorageState::busy) return base::Error::busy;
    if (!geometry().can_read(address, out.size())) return base::Error::bad_geometry;
    for (std::uint32_t i = 0; i < out.size(); ++i) out[i] = chip_.byte(begin_ + address + i);
    return {};
}

base::Status Flash::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
    if (state() == StorageState::busy) return base::Error::busy;
    if (!geometry().can_program(address, bytes.size())) return base::Error::bad_geometry;
    failed_ = false;
    at_ = begin_ + address;
    to_program_ = bytes;
    return {};
}

base::Status Flash::erase(std::uint32_t address) {
    if (state() == StorageState::busy) return base::Error::busy;
    if (!geometry().can_erase(address)) return base::Error::bad_geometry;
    failed_ = false;
    order(begin_ + address, 0, kErase);
    return {};
}

/// Programs some words per call: a millisecond at the most.
StorageState Flash::state() {
    constexpr int kAtOnce = 16;
    for (int i = 0; i < kAtOnce; ++i) {
        if (works()) return StorageState::busy;
        if ((chip_.get(kFcris) & kAccessViolated) != 0) {
            failed_ = true;
            to_program_ = {};
            chip_.set(kFcmisc, kAccessViolated);
        }
        if (to_program_.empty()) return failed_ ? StorageState::failed : StorageState::ready;
        program_next();
    }
    return StorageState::busy;
}

void Flash::program_next() {
    order(at_, base::load_u32(to_program_.data()), kWrite);
    at_ += kWord;
    to_program_ = to_program_.subspan(kWord);
}

bool Flash::works() {
    return (chip_.get(kFmc) & (kWrite | kErase)) != 0;
}

/// Not inlined: a test on the emulated board, which has no flash controller, replaces this function.
[[gnu::noinline]] void Flash::order(std::uint32_t address, std::uint32_t data, std::uint32_t command) {
    chip_.set(kFma, address);
    chip_.set(kFmd, data);
    chip_.set(kFmc, kKey | command);
}

}  // namespace nplc::hal_mcu::stellaris
