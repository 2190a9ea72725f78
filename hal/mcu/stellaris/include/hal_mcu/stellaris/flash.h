#pragma once

#include "ports/storage.h"

namespace nplc::hal_mcu::stellaris {

/// The flash and its controller, or a test model of both.
class FlashAccess {
  public:
    /// `offset`: of a controller register, from 400FD000h on.
    virtual std::uint32_t get(std::uint32_t offset) = 0;
    virtual void set(std::uint32_t offset, std::uint32_t value) = 0;
    virtual std::uint8_t byte(std::uint32_t address) = 0;

  protected:
    ~FlashAccess() = default;
};

/// The chip's flash. Needs begin_flash().
FlashAccess& chip_flash();
/// Sets the clock for the controller's pulse timing: 50 MHz. Before any program or erase.
void begin_flash();

/// Pages of the chip's own flash. The core halts during an operation, interrupts included, since its code is
/// in the same flash: some 50 us per word, with interrupts served in between, and 25 ms for a page erase. So
/// erase only while nothing moves. An operation on protected pages (FMPPE) changes nothing: failed.
class Flash final : public ports::Storage {
  public:
    static constexpr std::uint32_t kPage = 1024;

    /// `begin`: start of a page; `size`: whole pages.
    constexpr Flash(FlashAccess& chip, std::uint32_t begin, std::uint32_t size)
        : chip_(chip), begin_(begin), size_(size) {}

    ports::StorageGeometry geometry() const override;
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override;
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override;
    base::Status erase(std::uint32_t address) override;
    ports::StorageState state() override;

  private:
    static constexpr std::uint32_t kWord = 4;

    void order(std::uint32_t address, std::uint32_t data, std::uint32_t command);
    void program_next();
    bool works();

    FlashAccess& chip_;
    std::uint32_t begin_;
    std::uint32_t size_;
    std::uint32_t at_ = 0;                        ///< chip address of the next word
    std::span<const std::uint8_t> to_program_{};  ///< bytes still to program
    bool failed_ = false;
};

}  // namespace nplc::hal_mcu::stellaris
