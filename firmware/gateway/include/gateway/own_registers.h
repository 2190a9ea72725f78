#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gateway/settings_keeper.h"
#include "gateway/table_keeper.h"
#include "ports/serial.h"

namespace nplc::gateway {

/// What the user's port counts itself.
struct PortCounters {
    std::uint32_t messages = 0;
    std::uint32_t refused = 0;
};

/// The gateway's own registers (REGISTERS.md): what a number reads, and what a write does.
class OwnRegisters {
  public:
    /// Whose faults LINE_FAULTS shows, in its order; null: none.
    using Lines = std::array<const ports::SerialPort*, registers::gateway::kLines>;

    OwnRegisters(Gateway& gateway, TableKeeper& tables, SettingsKeeper& settings, const Lines& lines)
        : gateway_(gateway), tables_(tables), settings_(settings), lines_(lines) {}

    /// 4 bytes of one register, or 64 of sixteen. Reading FIRED_SCAN, and a block from TABLE_DATA, have
    /// effects.
    void read(std::uint8_t reg, std::span<std::uint8_t> out, base::Instant now);

    /// Begins a write, 2 or 4 bytes, or more for TABLE_DATA. poll_write() says how it ended.
    void begin_write(std::uint8_t reg, std::span<const std::uint8_t> bytes, base::Instant now);
    /// `bytes` as before. RESULT has the outcome too.
    Progress poll_write(std::span<const std::uint8_t> bytes, base::Instant now);
    /// Nobody waits for the write any more.
    void drop_write();

    PortCounters& port() { return port_; }
    /// A user has asked for a reset.
    bool reset_asked() const { return reset_asked_; }
    void poll();
    /// When poll(), and poll_write() while a write is not done, must be called at the latest.
    base::Instant next_poll(base::Instant now);

  private:
    /// What poll_write() still has to wait for.
    enum class Waiting : std::uint8_t { nothing, room, activation, reset, saving };

    std::uint32_t value(std::uint8_t reg, base::Instant now) const;
    std::uint32_t live_value(std::uint8_t reg, base::Instant now) const;
    std::uint32_t count_value(std::uint8_t reg) const;
    std::uint32_t table_value(std::uint8_t reg) const;
    std::uint32_t line_faults(const ports::SerialPort* line) const;
    std::uint32_t status() const;
    std::uint32_t fired(std::size_t word) const;
    std::uint32_t log_value(std::uint8_t reg) const;
    void take_fired();
    void read_table(std::span<std::uint8_t> out);

    Progress write(std::uint8_t reg, std::span<const std::uint8_t> bytes, base::Instant now);
    Progress write_value(std::uint8_t reg, std::uint32_t value, base::Instant now);
    Result force(std::uint8_t reg, std::uint32_t value, base::Instant now);
    Progress command(std::uint32_t value, base::Instant now);
    Progress reset(base::Instant now);
    Progress table_command(registers::gateway::Command command, base::Instant now);
    Progress write_table(std::span<const std::uint8_t> bytes);
    Progress continue_write(std::span<const std::uint8_t> bytes, base::Instant now);

    Gateway& gateway_;
    TableKeeper& tables_;
    SettingsKeeper& settings_;
    PortCounters port_;
    Lines lines_;
    bool reset_asked_ = false;

    std::uint8_t written_ = 0;
    base::Instant write_begun_{};
    Waiting waiting_ = Waiting::nothing;
    Progress outcome_;
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
