#include "nanoctl/gateway_client.h"

#include <fmt/format.h>

#include "base/bytes.h"
#include "nanoctl/operating.h"
#include "nanoctl/texts.h"

namespace nplc::nanoctl {

using mactalk_client::LineError;
using mactalk_client::Width;

namespace {

constexpr unsigned kAttempts = 12;
constexpr base::Milliseconds kBusyPause{50};
constexpr unsigned kBusyTries = 100;
constexpr base::Milliseconds kStartPause{200};
constexpr unsigned kStartLooks = 5;

/// What to do, for errors where it depends on the command.
std::string reason(gw::Command command, gw::Result result) {
    if (result == gw::Result::not_stopped && command == gw::Command::run) return "the sequence runs already";
    if (result == gw::Result::not_stopped && (command == gw::Command::step || command == gw::Command::scan))
        return "the sequence runs; hold it first with `nanoctl hold`";
    return std::string(gw::describe(result));
}

Block block_of(const std::array<std::uint8_t, protocol::mactalk::kBlockBytes>& bytes) {
    Block block{};
    for (std::size_t i = 0; i < block.size(); ++i) block[i] = base::load_u32(&bytes[4 * i]);
    return block;
}

}  // namespace

void GatewayClient::identify() {
    const Block block = read_block(gw::IDENTITY);
    check_identity(block[0], block[gw::MAP_VERSION - gw::IDENTITY]);
}

void GatewayClient::identify_briefly() {
    const std::uint32_t identity = read(gw::IDENTITY);
    check_identity(identity, identity == gw::kIdentity ? read(gw::MAP_VERSION) : 0);
}

void GatewayClient::check_identity(std::uint32_t identity, std::uint32_t map) const {
    if (identity != gw::kIdentity)
        throw WrongDevice(fmt::format(
            "{}: what answers at address {} is no gateway (IDENTITY is {:08X}h); the motor behind "
            "one has an address of its own",
            master_.wire().name(), address_, identity));
    if (map != gw::kMapVersion)
        throw WrongDevice(
            fmt::format("{}: the gateway has register map {}, this program knows {}; take the "
                        "program that belongs to its firmware",
                        master_.wire().name(), map, gw::kMapVersion));
}

Block GatewayClient::read_block(std::uint8_t reg) {
    return block_of(master_.read_block(address_, reg));
}

std::optional<Block> GatewayClient::try_read_block(std::uint8_t reg) {
    const auto bytes = master_.try_read_block(address_, reg);
    return bytes ? std::optional(block_of(*bytes)) : std::nullopt;
}

GatewayClient::LastResult GatewayClient::last_result() {
    const std::uint32_t value = read(gw::RESULT);
    return {static_cast<gw::Result>(value & 0xFF), static_cast<std::uint8_t>(value >> 8),
            static_cast<std::uint16_t>(value >> 16)};
}

void GatewayClient::refuse(const LastResult& last, const std::string& what, const std::string& why) {
    const bool is_others = last.result == gw::Result::seat_taken &&
                           (last.detail == gw::kSeatOfAnother || last.detail == gw::kSeatTakenOver);
    throw Refused(last.result, last.reg, last.detail,
                  fmt::format("{}: {}", what, is_others ? why_seat_is_taken(*this) : why));
}

void GatewayClient::look_for_interruption() const {
    if (goes_on_ && !goes_on_()) throw Interrupted("interrupted");
}

void GatewayClient::lost(const std::string& what) const {
    throw LineError(LineError::Kind::no_answer, fmt::format("{}: {} was never accepted; the line is too bad",
                                                            master_.wire().name(), what));
}

/// A refusal must be read twice: the first may belong to an earlier write to the same register.
void GatewayClient::write(std::uint8_t reg, std::uint32_t value) {
    const gw::Row* row = gw::find(reg);
    const std::string what = row != nullptr ? std::string(row->name) : fmt::format("register {}", reg);
    unsigned refusals = 0;
    for (unsigned i = 0; i < kAttempts; ++i) {
        if (master_.try_write(address_, reg, value, Width::longword)) return;
        const LastResult last = last_result();
        if (last.reg != reg || last.result == gw::Result::done) continue;
        if (++refusals == 2) refuse(last, what, std::string(gw::describe(last.result)));
    }
    lost(what);
}

/// A write to another register first, so that RESULT distinguishes a lost command from a lost accept.
void GatewayClient::command_once(gw::Command command, base::Microseconds more_patience) {
    const auto code = static_cast<std::uint32_t>(command);
    const std::string what(name_of(command));
    for (unsigned i = 0; i < kAttempts; ++i) {
        if (master_.try_write(address_, gw::COMMAND, code, Width::longword, more_patience)) return;
        const LastResult last = last_result();
        if (last.reg != gw::COMMAND) continue;
        if (last.result == gw::Result::done) return;
        refuse(last, what, reason(command, last.result));
    }
    lost(what);
}

void GatewayClient::command(gw::Command command, base::Microseconds more_patience) {
    const std::uint32_t bytes = read(gw::UPLOAD_BYTES);
    bool has_waited = false;
    for (unsigned i = 1;; ++i) {
        write(gw::UPLOAD_BYTES, bytes);
        try {
            return command_once(command, more_patience);
        } catch (const Refused& refused) {
            const bool is_busy = refused.result() == gw::Result::busy && i < kBusyTries;
            const bool is_stopping = refused.result() == gw::Result::stop_unconfirmed &&
                                     !std::exchange(has_waited, true) && is_stop_confirmed_soon();
            if (!is_busy && !is_stopping) throw;
        }
        master_.pause(kBusyPause);
    }
}

bool GatewayClient::is_stop_confirmed_soon() {
    const base::Instant end = master_.wire().now() + kConfirmationWait;
    while ((read(gw::STATUS) & gw::kStopUnconfirmed) != 0) {
        if (master_.wire().now() >= end) return false;
        look_for_interruption();
        master_.pause(kBusyPause);
    }
    return true;
}

void GatewayClient::activate() {
    const base::Instant end = master_.wire().now() + kStillWait;
    for (;;) {
        try {
            return command(gw::Command::activate, base::Milliseconds{2'000});
        } catch (const Refused& refused) {
            if (refused.result() != gw::Result::moving) throw;
            if (master_.wire().now() >= end)
                throw Refused(refused.result(), refused.reg(), refused.detail(),
                              "activate: the motor does not stand still, also not after 5 s; stop it first, "
                              "then `nanoctl activate`");
        }
        look_for_interruption();
        master_.pause(kStartPause);
        look_for_interruption();
    }
}

/// The gateway does not answer to a reset; RESULT, which named a register before, is 0 afterwards. A stored
/// table that the reset would activate is activated before it, so that refusals are answered.
void GatewayClient::reset() {
    if ((read(gw::STATUS) & gw::kStoredDiffers) != 0) activate();
    const std::uint32_t bytes = read(gw::UPLOAD_BYTES);
    const std::uint8_t before = address_;
    const auto after = static_cast<std::uint8_t>(read(gw::register_of(gw::Setting::gateway_address)));
    for (unsigned i = 0; i < kAttempts; ++i) {
        write(gw::UPLOAD_BYTES, bytes);
        static_cast<void>(master_.try_write(address_, gw::COMMAND,
                                            static_cast<std::uint32_t>(gw::Command::reset), Width::longword));
        bool answers = false;
        for (unsigned look = 0; look < kStartLooks && !answers; ++look) {
            look_for_interruption();
            master_.pause(kStartPause);
            auto last = try_last_result();
            if (!last && after != before) {
                address_ = address_ == before ? after : before;
                last = try_last_result();
            }
            if (!last) continue;
            if (last->reg == 0) return identify();
            if (last->reg == gw::COMMAND && last->result != gw::Result::done)
                refuse(*last, "reset", reason(gw::Command::reset, last->result));
            answers = true;
        }
        if (!answers) break;
    }
    throw LineError(
        LineError::Kind::no_answer,
        fmt::format("{}: no answer after the reset; if the port's speed was changed, name the new "
                    "one with --baud",
                    master_.wire().name()));
}

std::optional<GatewayClient::LastResult> GatewayClient::try_last_result() {
    try {
        return last_result();
    } catch (const LineError& error) {
        if (error.kind() != LineError::Kind::no_answer) throw;
        return std::nullopt;
    }
}

}  // namespace nplc::nanoctl
