#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "ports/storage.h"

namespace nplc::sim {

/// A program or erase operation about to start.
struct StorageOperation {
    bool is_erase = false;
    std::uint32_t address = 0;
    std::vector<std::uint8_t> bytes;  ///< for a program operation
};

/// Progress of an operation when the power failed.
struct Tear {
    /// Program: bytes done; the unit after them is torn. Erase: bytes at the block's start that are unchanged
    /// while all others are FFh, or with `from_start` the reverse.
    std::uint32_t bytes = 0;
    bool from_start = false;
    /// Of the bits that were to change in the torn unit (erase: in each byte not yet erased), those in this
    /// mask have changed; the mask is repeated byte by byte and rotated by one bit each. 0: none.
    std::uint8_t mask = 0;
};

/// Flash or EEPROM of any geometry, with power cuts, worn bits and bits flipped at rest. Initially all bytes
/// are FFh. A copy is an independent device.
class SimStorage final : public ports::Storage {
  public:
    /// An operation takes `busy_polls` calls of state().
    explicit SimStorage(const ports::StorageGeometry& geometry, unsigned busy_polls = 1);
    /// Takes effect with the next operation.
    void work_for(unsigned busy_polls) { busy_polls_ = busy_polls; }

    ports::StorageGeometry geometry() const override { return geometry_; }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override;
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override;
    base::Status erase(std::uint32_t address) override;
    ports::StorageState state() override;

    /// Called before each operation that is accepted.
    void watch(std::function<void(const StorageOperation&)> watcher) { watcher_ = std::move(watcher); }

    /// A copy of the device, without its watcher, as found at the next start if the power fails in
    /// `operation`.
    SimStorage torn(const StorageOperation& operation, const Tear& tear) const;

    void flip(std::uint32_t address, unsigned bit);
    /// Overwrites bytes, as by data loss at rest.
    void fill(std::uint32_t address, std::uint32_t count, std::uint8_t value);
    /// From now on program operations leave this bit 1.
    void wear_out(std::uint32_t address, unsigned bit) { worn_ = {address, bit}; }
    /// Operation `number` from now, counted from 0, has no effect and is reported as failed.
    void fail_operation(std::uint64_t number) { fail_at_ = operations_ + number; }

    std::span<const std::uint8_t> bytes() const { return bytes_; }
    std::uint64_t operations() const { return operations_; }
    /// Units programmed twice without an erase between.
    std::uint64_t programmed_twice() const { return programmed_twice_; }

  private:
    struct Bit {
        std::uint32_t address;
        unsigned bit;
    };

    void begin(const StorageOperation& operation);
    void carry_out(const StorageOperation& operation);
    void change(std::uint32_t address, std::uint8_t value, std::uint8_t mask);

    ports::StorageGeometry geometry_;
    unsigned busy_polls_;
    std::vector<std::uint8_t> bytes_;
    std::vector<bool> programmed_;  ///< by unit
    std::function<void(const StorageOperation&)> watcher_;
    std::optional<Bit> worn_;
    std::optional<std::uint64_t> fail_at_;
    std::uint64_t operations_ = 0;
    std::uint64_t programmed_twice_ = 0;
    unsigned busy_ = 0;
    bool failed_ = false;
};

/// The relevant tears: none, complete, and for each unit (each part of a block) several partial ones.
std::vector<Tear> tears_of(const StorageOperation& operation, const ports::StorageGeometry& geometry);

}  // namespace nplc::sim
