#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ports/storage.h"

namespace nplc::sim {

/// A gateway's flash in a file, which is the flash's bytes and nothing else. Each operation is in the file,
/// whole, before it is reported as done; a new one is all FFh.
class FlashFile final : public ports::Storage {
  public:
    /// Throws InputError if the file is there and cannot be read, or has another size.
    FlashFile(std::string path, const ports::StorageGeometry& geometry);

    ports::StorageGeometry geometry() const override { return geometry_; }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override;
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override;
    base::Status erase(std::uint32_t address) override;
    ports::StorageState state() override { return state_; }

  private:
    bool holds(std::uint32_t address, std::size_t size, std::uint32_t alignment) const;
    void save();

    std::string path_;
    ports::StorageGeometry geometry_;
    std::vector<std::uint8_t> bytes_;
    ports::StorageState state_ = ports::StorageState::ready;
};

}  // namespace nplc::sim
