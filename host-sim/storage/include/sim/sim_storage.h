#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "ports/storage.h"

namespace nplc::sim {

/// A programming or erasure about to happen.
struct StorageOperation {
    bool is_erase = false;
    std::uint32_t address = 0;
    std::vector<std::uint8_t> bytes;  ///< of a programming
};

/// How far an operation came when the power failed.
struct Tear {
    /// A programming: bytes done; the unit after them is torn. An erasure: bytes at the block's start that
    /// are as they were while all others are FFh, or with `from_start` the other way round.
    std::uint32_t bytes = 0;
    bool from_start = false;
    /// Of the bits that the torn unit (of an erasure: each byte not yet erased) was to change, those of this
    /// mask have; repeated byte by byte and turned by one bit each. 0: none.
    std::uint8_t mask = 0;
};

/// Flash or EEPROM of any sizes, with power cuts, worn bits and bits flipped at rest. New, all bytes are FFh.
/// Copies are devices of their own.
class SimStorage final : public ports::Storage {
  public:
    /// An operation takes `busy_polls` calls of state().
    explicit SimStorage(const ports::StorageGeometry& geometry, unsigned busy_polls = 1);
    /// From the next operation on.
    void work_for(unsigned busy_polls) { busy_polls_ = busy_polls; }

    ports::StorageGeometry geometry() const override { return geometry_; }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override;
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override;
    base::Status erase(std::uint32_t address) override;
    ports::StorageState state() override;

    /// Called before each operation that is accepted.
    void watch(std::function<void(const StorageOperation&)> watcher) { watcher_ = std::move(watcher); }

    /// The same device, without its watcher, as the next start finds it if the power fails in `operation`.
    SimStorage torn(const StorageOperation& operation, const Tear& tear) const;

    void flip(std::uint32_t address, unsigned bit);
    /// Bytes that are lost at rest.
    void fill(std::uint32_t address, std::uint32_t count, std::uint8_t value);
    /// Programmings leave this bit 1 from now on.
    void wear_out(std::uint32_t address, unsigned bit) { worn_ = {address, bit}; }
    /// Operation number `number` from now, counted from 0, does nothing and is reported as failed.
    void fail_operation(std::uint64_t number) { fail_at_ = operations_ + number; }

    std::span<const std::uint8_t> bytes() const { return bytes_; }
    std::uint64_t operations() const { return operations_; }
    /// Units programmed again without an erasure between.
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

/// The tears worth trying: none and all of it, and in between each unit (each block's part) in several ways.
std::vector<Tear> tears_of(const StorageOperation& operation, const ports::StorageGeometry& geometry);

}  // namespace nplc::sim
