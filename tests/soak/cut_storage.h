#pragma once

#include <cstdint>
#include <optional>

#include "random_tables.h"
#include "sim/sim_storage.h"
#include "sim/world.h"

namespace nplc::soak {

/// The board's flash, whose power can be cut in the middle of an operation. As a deliberate fault the erasure
/// of a table slot's first block goes astray, to the other slot's.
class CutStorage final : public ports::Storage {
  public:
    CutStorage() : device_(sim::World::kFlash, kBusyPolls) { watch(); }
    CutStorage(const CutStorage&) = delete;
    CutStorage& operator=(const CutStorage&) = delete;

    /// Of those erasures from now on, that of this number.
    void lead_astray(std::uint64_t number) { astray_ = number; }

    /// True if an operation was under way: it is torn.
    bool cut_power(property::Dice& dice) {
        const bool torn = before_ && device_.state() == ports::StorageState::busy;
        if (torn) {
            const auto tears = sim::tears_of(operation_, device_.geometry());
            device_ = before_->torn(operation_, tears[dice.below(static_cast<unsigned>(tears.size()))]);
        }
        before_.reset();
        watch();
        return torn;
    }

    ports::StorageGeometry geometry() const override { return device_.geometry(); }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override {
        return device_.read(address, out);
    }
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override {
        return device_.program(address, bytes);
    }
    base::Status erase(std::uint32_t address) override {
        const store::Area area = sim::World::kTableArea;
        const bool begins_slot = address == area.begin || address == area.begin + area.slot_bytes;
        if (begins_slot && astray_ && (*astray_)-- == 0) {
            astray_.reset();
            address = area.begin + (address - area.begin + area.slot_bytes) % (2 * area.slot_bytes);
        }
        return device_.erase(address);
    }
    ports::StorageState state() override { return device_.state(); }

  private:
    static constexpr unsigned kBusyPolls = 50;

    void watch() {
        device_.watch([this](const sim::StorageOperation& operation) {
            before_.emplace(device_);
            operation_ = operation;
        });
    }

    sim::SimStorage device_;
    std::optional<sim::SimStorage> before_;  ///< the operation that was begun last
    sim::StorageOperation operation_;
    std::optional<std::uint64_t> astray_;
};

}  // namespace nplc::soak
