#pragma once

#include "ports/storage.h"

namespace nplc::hal_mcu::nrf51 {

/// Pages of the chip's own flash. The core halts during an operation, interrupts included: 46 us at most per
/// word, with interrupts served in between, and 22.3 ms for a page erase. So erase only while nothing moves.
class Flash final : public ports::Storage {
  public:
    static constexpr std::uint32_t kPage = 1024;

    /// `begin`: start of a page; `size`: whole pages.
    constexpr Flash(std::uint32_t begin, std::uint32_t size) : begin_(begin), size_(size) {}

    ports::StorageGeometry geometry() const override;
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override;
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override;
    base::Status erase(std::uint32_t address) override;
    ports::StorageState state() override;

  private:
    static constexpr std::uint32_t kWord = 4;

    std::uint32_t begin_;
    std::uint32_t size_;
    std::uint32_t at_ = 0;                        ///< chip address of the next word
    std::span<const std::uint8_t> to_program_{};  ///< bytes still to program
};

}  // namespace nplc::hal_mcu::nrf51
