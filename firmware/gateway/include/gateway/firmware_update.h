#pragma once

#include <cstdint>
#include <span>

#include "base/bytes.h"
#include "gateway/command_result.h"
#include "registers/gateway.h"
#include "update/receiver.h"

/// Whether the firmware can be renewed over the user's port: only on boards with a loader.
#ifndef NPLC_UPDATE
#define NPLC_UPDATE 0
#endif

namespace nplc::gateway {

/// The registers FIRMWARE_... on a board's update::Receiver (REGISTERS.md, Firmware).
class FirmwareUpdate {
  public:
    static constexpr bool kIsThere = true;

    /// Before it is polled or asked anything.
    void attach(update::Receiver& receiver) { receiver_ = &receiver; }

    Result begin(std::uint32_t bytes) { return receiver_->begin(bytes); }
    Result commit(std::uint32_t length, std::uint32_t crc) { return receiver_->finish(length, crc); }
    Result abandon();
    /// Offset and piece.
    Result write(std::span<const std::uint8_t> bytes);
    std::uint32_t value(std::uint8_t reg) const;

    /// An image on trial is healthy when it has run for kHealthyAfter and somebody has reached its user's
    /// port: it can be renewed again.
    void poll(std::uint32_t uptime, bool was_reached);
    static constexpr std::uint32_t kHealthyAfter = 10'000;  ///< milliseconds
    /// From one erasure's begin to the next one's: a board may hear nothing meanwhile, and messages want to
    /// be heard between.
    static constexpr std::uint32_t kEraseEvery = 50;

  private:
    std::uint32_t state() const;

    update::Receiver* receiver_ = nullptr;
    std::uint32_t erased_at_ = 0;  ///< uptime
};

struct NoFirmwareUpdate {
    static constexpr bool kIsThere = false;
    static void attach(update::Receiver&) {}
    static Result begin(std::uint32_t) { return Result::no_register; }
    static Result commit(std::uint32_t, std::uint32_t) { return Result::no_register; }
    static Result abandon() { return Result::no_register; }
    static Result write(std::span<const std::uint8_t>) { return Result::no_register; }
    static std::uint32_t value(std::uint8_t) { return 0; }
    static void poll(std::uint32_t, bool) {}
};

#if NPLC_UPDATE
using FirmwarePart = FirmwareUpdate;
#else
using FirmwarePart = NoFirmwareUpdate;
#endif

}  // namespace nplc::gateway
