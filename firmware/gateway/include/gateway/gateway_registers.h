#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gateway/firmware_update.h"
#include "gateway/settings_manager.h"
#include "gateway/store_trace.h"
#include "gateway/table_manager.h"
#include "ports/serial.h"

namespace nplc::gateway {

/// The user port's own counters.
struct PortCounters {
    std::uint32_t messages = 0;
    std::uint32_t refused = 0;
};

/// The gateway's own registers (REGISTERS.md): reads, and the effects of writes.
class GatewayRegisters {
  public:
    /// The lines whose faults LINE_FAULTS shows, in its order; null: none.
    using Lines = std::array<const ports::SerialPort*, registers::gateway::kLines>;

    GatewayRegisters(Gateway& gateway, TableManager& tables, SetPointsPart& set_points,
                     SettingsManager& settings, const Lines& lines)
        : gateway_(gateway), tables_(tables), set_points_(set_points), settings_(settings), lines_(lines) {}

    /// `out`: 4 bytes for one register, or 64 for sixteen. Reading FIRED_SCAN, and a block from TABLE_DATA,
    /// has side effects.
    void read(std::uint8_t reg, std::span<std::uint8_t> out, base::Instant now);

    /// Begins a write of 2 or 4 bytes, or more for TABLE_DATA. poll_write() returns its outcome.
    void begin_write(std::uint8_t reg, std::span<const std::uint8_t> bytes, base::Instant now);
    /// `bytes`: as in begin_write(). The outcome is also in RESULT.
    PendingResult poll_write(std::span<const std::uint8_t> bytes, base::Instant now);
    /// The same for a write to SET_POINT_WRITE, which is independent of the others: SetPoints::serve().
    PendingResult serve_set_points(SetPointsPart::Writer& writer, std::span<const std::uint8_t> bytes,
                                   base::Instant now);
    /// The client no longer waits for the write.
    void drop_write();

    /// For writers other than the user port: RESULT belongs to that port and is restored after their writes.
    std::uint32_t result() const { return result_; }
    void set_result(std::uint32_t result) { result_ = result; }
    /// Changes with every write begun.
    std::uint8_t writes_begun() const { return writes_begun_; }
    std::uint8_t written() const { return written_; }  ///< register of the last write

    FirmwarePart& firmware() { return firmware_; }
    /// For STORE_FLAGS, which shows it while a first run is waited for.
    StoreTracePart& store_traces() { return store_traces_; }
    const SettingsManager& settings() const { return settings_; }
    PortCounters& port() { return port_; }
    /// A client has requested a reset, and no set-point request is being stored.
    bool reset_asked() const { return reset_asked_ && !set_points_.stores(); }
    /// An activation or a reset reads the motor to check for standstill: its access is in use.
    bool asks_motor() const { return waiting_ == Waiting::activation || waiting_ == Waiting::reset; }
    void poll();
    /// Latest time of the next poll(), and of poll_write() while a write is in progress.
    base::Instant next_poll(base::Instant now);

  private:
    static constexpr bool kHasSetPoints = SetPointsPart::kIsThere;
    static constexpr bool kHasFirmware = FirmwarePart::kIsThere;

    /// What poll_write() still has to wait for.
    enum class Waiting : std::uint8_t { nothing, room, activation, reset, saving, mark };

    std::uint32_t value(std::uint8_t reg, base::Instant now) const;
    std::uint32_t live_value(std::uint8_t reg, base::Instant now) const;
    std::uint32_t count_value(std::uint8_t reg) const;
    std::uint32_t time_value(std::uint8_t reg) const;
    std::uint32_t table_value(std::uint8_t reg) const;
    std::uint32_t line_faults(const ports::SerialPort* line) const;
    std::uint32_t status() const;
    std::uint32_t fired(std::size_t word) const;
    std::uint32_t log_value(std::uint8_t reg) const;
    void take_fired();
    void read_table(std::span<std::uint8_t> out);

    PendingResult write(std::uint8_t reg, std::span<const std::uint8_t> bytes, base::Instant now);
    PendingResult write_value(std::uint8_t reg, std::uint32_t value, base::Instant now);
    Result force(std::uint8_t reg, std::uint32_t value, base::Instant now);
    PendingResult command(std::uint32_t value, base::Instant now);
    PendingResult started(const base::Status& status);
    PendingResult reset(base::Instant now);
    PendingResult table_command(registers::gateway::Command command, base::Instant now);
    PendingResult write_table(std::span<const std::uint8_t> bytes);
    CommandResult firmware_command(registers::gateway::Command command);
    PendingResult write_firmware(std::span<const std::uint8_t> bytes);
    PendingResult continue_write(std::span<const std::uint8_t> bytes, base::Instant now);

    Gateway& gateway_;
    TableManager& tables_;
    SetPointsPart& set_points_;
    SettingsManager& settings_;
    PortCounters port_;
    Lines lines_;
    bool reset_asked_ = false;
    [[no_unique_address]] FirmwarePart firmware_;  ///< if the firmware supports it
    [[no_unique_address]] StoreTracePart store_traces_;

    std::uint8_t written_ = 0;
    std::uint8_t writes_begun_ = 0;
    base::Instant write_begun_{};
    Waiting waiting_ = Waiting::nothing;
    PendingResult outcome_;
    std::uint32_t result_ = 0;
    std::uint32_t last_command_ = 0;

    std::uint32_t upload_bytes_ = 0;
    std::uint32_t upload_crc_ = 0;
    std::uint32_t pointer_ = 0;

    struct Fired {
        std::uint32_t scan = 0;
        std::uint8_t step = 0;
        sequencer::Key key = 0;
        bool any = false;
    };
    Fired fired_;
};

}  // namespace nplc::gateway
