#pragma once

#include "ports/digital_io.h"
#include "ports/serial.h"
#include "ports/storage.h"
#include "ports/watchdog.h"

/// Null ports, for missing hardware.
namespace nplc::boards {

struct NoLine final : ports::SerialPort {
    std::size_t write(std::span<const std::uint8_t> bytes) override { return bytes.size(); }
    std::size_t read(std::span<ports::ReceivedByte>) override { return 0; }
    bool transmitter_idle() override { return true; }
};

struct NoStorage final : ports::Storage {
    explicit NoStorage(const ports::StorageGeometry& geometry) : geometry_(geometry) {}
    ports::StorageGeometry geometry() const override { return geometry_; }
    base::Status read(std::uint32_t, std::span<std::uint8_t>) override { return base::Error::storage_failed; }
    base::Status program(std::uint32_t, std::span<const std::uint8_t>) override {
        return base::Error::storage_failed;
    }
    base::Status erase(std::uint32_t) override { return base::Error::storage_failed; }
    ports::StorageState state() override { return ports::StorageState::failed; }

  private:
    ports::StorageGeometry geometry_;
};

struct NoInputs final : ports::DigitalInputs {
    std::uint8_t read() override { return 0; }
};

struct NoOutputs final : ports::DigitalOutputs {
    void write(std::uint8_t) override {}
};

struct NoWatchdog final : ports::Watchdog {
    void feed() override {}
};

}  // namespace nplc::boards
