#pragma once

#include "hal_mcu/i2c_bus.h"
#include "ports/clock.h"
#include "ports/storage.h"

namespace nplc::hal_mcu {

/// A serial EEPROM with two address bytes (24C32 to 24C512). Writes and erases run in the background; state()
/// polls the memory for the end of its write cycle, one transfer each time. A read waits for the bus: 64
/// bytes take 1.6 ms at 400 kHz.
class I2cMemory final : public ports::Storage {
  public:
    struct Kind {
        std::uint32_t size;   ///< bytes
        std::uint32_t page;   ///< bytes, 128 at the most
        std::uint8_t device;  ///< 7 bits
    };
    static constexpr Kind k24C256{.size = 32 * 1024, .page = 64, .device = 0x50};

    I2cMemory(I2cBus& bus, ports::Clock& clock, const Kind& kind) : bus_(bus), clock_(clock), kind_(kind) {}

    /// For the start-up: waits up to 20 ms until the memory answers, since a reset may have interrupted a
    /// write cycle. False: no answer.
    bool wait_until_ready();

    ports::StorageGeometry geometry() const override;
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override;
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override;
    base::Status erase(std::uint32_t address) override;
    ports::StorageState state() override;

  private:
    enum class Phase : std::uint8_t { rest, writing, write_cycle };

    base::Status write(const I2cBus::Transfer& transfer);
    I2cBus::Transfer at(std::uint32_t address) const;
    ports::StorageState end(ports::StorageState result);
    bool is_late() { return clock_.now() - begun_ > kLongest; }
    void ask();

    /// Longer than any such memory's write cycle (5 or 10 ms) and the transfer before it.
    static constexpr base::Microseconds kLongest{20'000};

    I2cBus& bus_;
    ports::Clock& clock_;
    Kind kind_;
    Phase phase_ = Phase::rest;
    ports::StorageState result_ = ports::StorageState::ready;
    base::Instant begun_{};
};

}  // namespace nplc::hal_mcu
