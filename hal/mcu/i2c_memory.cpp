#include "hal_mcu/i2c_memory.h"

namespace nplc::hal_mcu {

using ports::StorageState;

ports::StorageGeometry I2cMemory::geometry() const {
    return {.size = kind_.size, .erase_block = kind_.page, .program_page = kind_.page, .program_unit = 1};
}

bool I2cMemory::wait_until_ready() {
    begun_ = clock_.now();
    phase_ = Phase::write_cycle;
    ask();
    while (state() == StorageState::busy) {
    }
    return result_ == StorageState::ready;
}

base::Status I2cMemory::read(std::uint32_t address, std::span<std::uint8_t> out) {
    if (phase_ != Phase::rest) return base::Error::busy;
    if (address > kind_.size || kind_.size - address < out.size()) return base::Error::bad_geometry;
    if (out.empty()) return {};
    I2cBus::Transfer transfer = at(address);
    transfer.in = out;
    begun_ = clock_.now();
    bus_.begin(transfer);
    while (bus_.state() == I2cBus::State::busy) {
        if (!is_late()) continue;
        bus_.abandon();
        return base::Error::storage_failed;
    }
    if (bus_.state() == I2cBus::State::refused) return base::Error::storage_failed;
    return {};
}

base::Status I2cMemory::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
    if (phase_ != Phase::rest) return base::Error::busy;
    const std::uint32_t in_page = address % kind_.page;
    if (address >= kind_.size || bytes.size() > kind_.page - in_page) return base::Error::bad_geometry;
    I2cBus::Transfer transfer = at(address);
    transfer.out = bytes;
    return write(transfer);
}

base::Status I2cMemory::erase(std::uint32_t address) {
    if (phase_ != Phase::rest) return base::Error::busy;
    if (address >= kind_.size || address % kind_.page != 0) return base::Error::bad_geometry;
    I2cBus::Transfer transfer = at(address);
    transfer.blanks = static_cast<std::uint8_t>(kind_.page);
    return write(transfer);
}

base::Status I2cMemory::write(const I2cBus::Transfer& transfer) {
    begun_ = clock_.now();
    phase_ = Phase::writing;
    bus_.begin(transfer);
    return {};
}

StorageState I2cMemory::state() {
    if (phase_ == Phase::rest) return result_;
    const I2cBus::State bus = bus_.state();
    if (bus == I2cBus::State::busy && !is_late()) return StorageState::busy;
    if (bus == I2cBus::State::busy) {
        bus_.abandon();
        return end(StorageState::failed);
    }
    const bool refused = bus == I2cBus::State::refused;
    if (phase_ == Phase::writing && refused) return end(StorageState::failed);
    if (phase_ == Phase::write_cycle && !refused) return end(StorageState::ready);
    if (is_late()) return end(StorageState::failed);
    phase_ = Phase::write_cycle;
    ask();
    return StorageState::busy;
}

StorageState I2cMemory::end(StorageState result) {
    phase_ = Phase::rest;
    result_ = result;
    return result;
}

/// During its write cycle the memory acknowledges nothing (acknowledge polling). An address without data
/// writes nothing.
void I2cMemory::ask() {
    bus_.begin(at(0));
}

I2cBus::Transfer I2cMemory::at(std::uint32_t address) const {
    return {.device = kind_.device,
            .address = {static_cast<std::uint8_t>(address >> 8), static_cast<std::uint8_t>(address)}};
}

}  // namespace nplc::hal_mcu
