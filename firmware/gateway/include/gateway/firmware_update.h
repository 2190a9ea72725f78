#pragma once

#include <cstdint>
#include <span>

#include "base/bytes.h"
#include "gateway/command_result.h"
#include "registers/gateway.h"
#include "update/receiver.h"

/// Firmware update over the user port; only on boards with a boot loader.
#ifndef NPLC_UPDATE
#define NPLC_UPDATE 0
#endif

namespace nplc::gateway {

/// Maps the registers FIRMWARE_... (REGISTERS.md, Firmware) to a board's update::Receiver.
class FirmwareUpdate {
  public:
    static constexpr bool kIsThere = true;

    /// To be called before all other functions.
    void attach(update::Receiver& receiver) { receiver_ = &receiver; }

    Result begin(std::uint32_t bytes) { return receiver_->begin(bytes); }
    Result commit(std::uint32_t length, std::uint32_t crc) { return receiver_->finish(length, crc); }
    Result abandon();
    /// `bytes`: the offset (4 bytes), then the piece of the image.
    Result write(std::span<const std::uint8_t> bytes);
    std::uint32_t value(std::uint8_t reg) const;

    /// Confirms an image on trial once it has run for kHealthyAfter and a client has reached the user port,
    /// so that it can be updated again.
    void poll(std::uint32_t uptime, bool was_reached);
    static constexpr std::uint32_t kHealthyAfter = 10'000;  ///< milliseconds
    /// Milliseconds from the start of one erase to the start of the next: a board may receive nothing during
    /// an erase, and messages must get through in between.
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
