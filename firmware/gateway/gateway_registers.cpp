#include "gateway/gateway_registers.h"

#include <algorithm>
#include <bit>

#include "base/bytes.h"
#include "gateway/version.h"

namespace nplc::gateway {

using namespace registers::gateway;

namespace {

constexpr std::size_t kRegisterBytes = 4;

std::uint32_t in_milliseconds(base::Microseconds time) {
    return (static_cast<std::uint32_t>(time.count()) + 999U) / 1000U;
}

constexpr std::uint32_t flag(StoreFlag bit, bool is_set) {
    return is_set ? std::uint32_t{bit} : 0U;
}

}  // namespace

[[gnu::noinline]] void GatewayRegisters::read(std::uint8_t reg, std::span<std::uint8_t> out,
                                              base::Instant now) {
    if (reg == TABLE_DATA && out.size() > kRegisterBytes) return read_table(out);
    if (kHasSetPoints && reg == SET_POINT_POINTER && out.size() > kRegisterBytes)
        return set_points_.read_window(out);
    for (std::size_t i = 0; i * kRegisterBytes < out.size(); ++i) {
        const std::size_t number = reg + i;
        if (number == FIRED_SCAN) take_fired();
        base::store_u32(&out[i * kRegisterBytes],
                        number > 255 ? 0 : value(static_cast<std::uint8_t>(number), now));
    }
}

void GatewayRegisters::read_table(std::span<std::uint8_t> out) {
    const std::span<const std::uint8_t> table = tables_.active();
    const std::size_t begin = std::min<std::size_t>(pointer_, table.size());
    const auto part = table.subspan(begin, std::min(out.size(), table.size() - begin));
    std::fill(out.begin(), out.end(), std::uint8_t{0});
    std::copy(part.begin(), part.end(), out.begin());
    set_points_.show_defaults(out.first(part.size()), begin);
    pointer_ += static_cast<std::uint32_t>(out.size());
}

std::uint32_t GatewayRegisters::value(std::uint8_t reg, base::Instant now) const {
    if (reg >= FIRED && reg < FIRED + kFiredWords) return fired(reg - std::size_t{FIRED});
    if (reg >= LOG && reg < LOG + 2 * kLogEntries) return log_value(reg);
    if (reg >= STATUS && reg <= RESULT) return live_value(reg, now);
    if (reg >= LINK_LOSSES && reg <= REFUSED) return count_value(reg);
    if (reg >= PROOF && reg < PROOF + kProofWords) return tables_.proof_word(reg - PROOF);
    if (reg >= POLL_WORST && reg <= STOP_SINCE) return time_value(reg);
    if (reg >= LINE_FAULTS && reg < LINE_FAULTS + kLines) return line_faults(lines_[reg - LINE_FAULTS]);
    if (kHasSetPoints && reg == SET_POINT_POINTER) return set_points_.pointer();
    if (kHasSetPoints && ((reg >= SET_POINT_COUNT && reg <= SET_POINT_BYTES) ||
                          (reg >= SET_POINT && reg < SET_POINT_WANTED + kSetPoints)))
        return set_points_.value(reg);
    if (kHasFirmware && reg >= FIRMWARE_BOARD && reg < FIRMWARE_DATA) return firmware_.value(reg);
    if (reg >= SETTINGS) {
        const auto id = static_cast<std::uint8_t>(reg - SETTINGS);
        return registers::gateway::is_setting(id) ? settings_.get(store::Setting{id}) : 0;
    }
    return table_value(reg);
}

std::uint32_t GatewayRegisters::table_value(std::uint8_t reg) const {
    switch (reg) {
        case IDENTITY:
            return kIdentity;
        case FW_VERSION:
            return kFirmwareVersion;
        case MAP_VERSION:
            return kMapVersion;
        case TABLE_CRC:
            return tables_.active_crc();
        case TABLE_BYTES:
            return static_cast<std::uint32_t>(tables_.active().size());
        case STORED_CRC:
            return tables_.stored().crc;
        case STORED_BYTES:
            return tables_.stored().length;
        case STORED_MAX:
            return tables_.capacity();
        case STORE_FLAGS:
            return flag(kTableDamaged, tables_.fell_back()) |
                   flag(kSettingsDamaged, settings_.were_damaged()) |
                   flag(kSetPointsDamaged, set_points_.were_damaged()) |
                   (gateway_.waits_for_first_run() ? kFirstRunWanted | store_traces_.flags() : 0U);
        case COMMAND:
            return last_command_;
        case FORCE_IN:
            return gateway_.forces().inputs().in_register();
        case FORCE_OUT:
            return gateway_.forces().outputs().in_register();
        case BREAK_LOW:
            return static_cast<std::uint32_t>(gateway_.breakpoints());
        case BREAK_HIGH:
            return static_cast<std::uint32_t>(gateway_.breakpoints() >> 32);
        case UPLOAD_STATE:
            return tables_.upload_state();
        case UPLOAD_RECEIVED:
            return tables_.uploaded();
        case UPLOAD_BYTES:
            return upload_bytes_;
        case UPLOAD_CRC:
            return upload_crc_;
        case TABLE_POINTER:
            return pointer_;
        case PROOF_BYTES:
            return kProofBytes;
        case FIRED_SCAN:
            return fired_.scan;
        case FIRED_STEP:
            return fired_.step;
        case FIRED_KEY:
            return fired_.key;
        default:
            return 0;
    }
}

std::uint32_t GatewayRegisters::live_value(std::uint8_t reg, base::Instant now) const {
    const sequencer::State& state = gateway_.state();
    const ForcedIo& forces = gateway_.forces();
    switch (reg) {
        case STATUS:
            return status();
        case SAFE_REASON:
            return static_cast<std::uint32_t>(gateway_.safe_reason());
        case SAFE_SINCE:
            return gateway_.safe_since_uptime();
        case UPTIME:
            return gateway_.uptime();
        case STEP:
            return state.step;
        case TIMER:
            return state.timer;
        case COUNTER:
            return state.counter;
        case INPUTS:
            return gateway_.inputs() | (gateway_.motor().in_position() ? 0x40U : 0U) |
                   (gateway_.motor().error() ? 0x80U : 0U) |
                   (static_cast<std::uint32_t>(gateway_.terminals()) << 8) |
                   (static_cast<std::uint32_t>(gateway_.image()) << 16);
        case OUTPUTS:
            return gateway_.outputs() | (static_cast<std::uint32_t>(state.outputs) << 8) |
                   (static_cast<std::uint32_t>(forces.outputs().mask) << 16);
        case SCANS:
            return gateway_.scans();
        case SCAN_TIME:
            return static_cast<std::uint32_t>(gateway_.scan_time().count());
        case SCAN_WORST:
            return static_cast<std::uint32_t>(gateway_.worst_scan_time().count());
        case LINK:
            return static_cast<std::uint32_t>(gateway_.motor().link());
        case FORCE_LEFT:
            return in_milliseconds(forces.left(now, gateway_.settings().force_time));
        case LOG_COUNT:
            return gateway_.log().count();
        default:
            return result_;
    }
}

std::uint32_t GatewayRegisters::count_value(std::uint8_t reg) const {
    if (reg == MESSAGES) return port_.messages;
    if (reg == REFUSED) return port_.refused;
    const auto counters =
        std::bit_cast<std::array<std::uint32_t, MESSAGES - LINK_LOSSES>>(gateway_.motor().counters());
    return counters[reg - LINK_LOSSES];
}

std::uint32_t GatewayRegisters::time_value(std::uint8_t reg) const {
    switch (reg) {
        case POLL_WORST:
            return gateway_.polls().worst();
        case LATE_POLLS:
            return gateway_.polls().late();
        case ECHO_TIME:
            return static_cast<std::uint32_t>(gateway_.motor().echo_time().count());
        default:
            return gateway_.stop_unconfirmed() ? gateway_.stop_asked() : 0;
    }
}

std::uint32_t GatewayRegisters::line_faults(const ports::SerialPort* line) const {
    constexpr std::uint32_t kMost = 0xFFFF;
    if (line == nullptr) return 0;
    const ports::LineFaults faults = line->faults();
    return std::min(faults.framing, kMost) | (std::min(faults.overruns, kMost) << 16);
}

/// From the highest bit down, each shifted into its place: nothing has to be kept beside.
std::uint32_t GatewayRegisters::status() const {
    static_assert(kStopUnconfirmed == 1U << 19 && kLinkDelivers == 1U << 3 && kRunState == 7);
    const motor::Motor& motor = gateway_.motor();
    std::uint32_t bits = gateway_.stop_unconfirmed() ? 1U : 0U;
    bits = 2 * bits + (gateway_.run_state() == RunState::held && !gateway_.can_go_on() ? 1U : 0U);
    bits = 2 * bits + (gateway_.has_single() ? 1U : 0U);
    bits = 2 * bits + (gateway_.settings().virtual_motor ? 1U : 0U);
    bits = 2 * bits + (gateway_.enabled() ? 1U : 0U);
    bits = 2 * bits + (settings_.differ() ? 1U : 0U);
    bits = 2 * bits + (tables_.stored().length != 0 && !tables_.stored_is_active() ? 1U : 0U);
    bits = 2 * bits + (tables_.uploads() ? 1U : 0U);
    bits = 2 * bits + (!gateway_.table().empty() ? 1U : 0U);
    bits = 2 * bits + (gateway_.at_breakpoint() ? 1U : 0U);
    bits = 2 * bits + (gateway_.breakpoints() != 0 ? 1U : 0U);
    bits = 2 * bits + (gateway_.forces().outputs().mask != 0 ? 1U : 0U);
    bits = 2 * bits + (gateway_.forces().inputs().mask != 0 ? 1U : 0U);
    bits = 2 * bits + (gateway_.safe_reason() != SafeReason::none ? 1U : 0U);
    bits = 2 * bits + (motor.in_position() ? 1U : 0U);
    bits = 2 * bits + (motor.error() ? 1U : 0U);
    bits = 2 * bits + (motor::link_is_usable(motor.link()) ? 1U : 0U);
    return bits << 3 | static_cast<std::uint32_t>(gateway_.run_state());
}

void GatewayRegisters::take_fired() {
    fired_ = {.scan = gateway_.scans(),
              .step = gateway_.scanned_step(),
              .key = gateway_.scanned_key(),
              .any = gateway_.scans() != 0};
}

std::uint32_t GatewayRegisters::fired(std::size_t word) const {
    const sequencer::Table& table = gateway_.table();
    std::uint32_t bits = 0;
    for (std::size_t i = 0; fired_.any && i < 32; ++i) {
        const std::size_t number = 32 * word + i;
        if (number >= table.size()) break;
        const sequencer::TermView term = table.term(number);
        if (sequencer::step_of(term) == fired_.step && sequencer::is_true(term, fired_.key)) bits |= 1U << i;
    }
    return bits;
}

std::uint32_t GatewayRegisters::log_value(std::uint8_t reg) const {
    const unsigned index = reg - unsigned{LOG};
    const EventLog::Entry& entry = gateway_.log().slot(index / 2);
    if (index % 2 == 0) return entry.milliseconds;
    return entry.event | (static_cast<std::uint32_t>(entry.step) << 8) |
           (static_cast<std::uint32_t>(entry.detail) << 16);
}

}  // namespace nplc::gateway
