#include "cli/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "command_line/files.h"
#include "host/clock.h"
#include "host/endpoint.h"
#include "host/printable.h"
#include "nanoctl/reconnecting.h"
#include "nanoctl/stopping.h"
#include "seqc/symbol_file.h"

namespace nplc::nanoctl::cli {

using host::ByteClient;
using mactalk_client::LineError;

namespace {

/// Long enough for another program's whole upload.
constexpr base::Milliseconds kTurnWait{60'000};

/// Connects to a socket whose gateway is restarting or has no free connection at the moment, and again where
/// it closed the connection.
std::unique_ptr<ByteClient> open_for_stop(const Common& common) {
    constexpr auto kHolding = ByteClient::Holding::at_once;
    const base::Instant end = host::steady_now() + kLongestStop;
    auto first = command_line::open_for_stop(common, kHolding);
    if (!host::Endpoint(common.port).is_socket()) return first;
    const auto sleep = [](base::Microseconds time) {
        std::this_thread::sleep_for(std::chrono::microseconds(time.count()));
    };
    const auto again = [&common] { return ByteClient::open(common.port, common.baud, kHolding); };
    return std::make_unique<Reconnecting>(std::move(first), again, sleep, end - host::steady_now());
}

/// Stop commands neither wait nor need a password.
std::unique_ptr<ByteClient> open(const Common& common, ByteClient::Holding holding) {
    if (holding == ByteClient::Holding::at_once) return open_for_stop(common);
    return command_line::open_with_password(common, static_cast<std::uint8_t>(common.address), holding);
}

}  // namespace

Session::Session(const Common& common) : Session(common, ByteClient::Holding::in_turns) {
    gateway_.identify();
}

Session::Session(const Common& common, ByteClient::Holding holding)
    : common_(common),
      wire_(open(common, holding)),
      master_(*wire_, {.baud = common.baud,
                       .patience = base::Milliseconds{common.patience_ms},
                       .attempts = common.attempts}),
      gateway_(master_, static_cast<std::uint8_t>(common.address)) {
    gateway_.set_goes_on(goes_on);
}

Names Session::read_names() {
    if (common_.symbols.empty()) return {};
    const auto reading = seqc::read_symbols(command_line::read_text(common_.symbols));
    if (!reading.error.empty()) throw UserError(fmt::format("{}: {}", common_.symbols, reading.error));
    const Block about = gateway_.read_block(gw::IDENTITY);
    if (about[gw::TABLE_BYTES - 1] != 0 && about[gw::TABLE_CRC - 1] != reading.file.crc32)
        throw UserError(
            fmt::format("{} belongs to another table than the active one (CRC {:08X}h, {:08X}h); "
                        "upload its table, or name the right file",
                        common_.symbols, reading.file.crc32, about[gw::TABLE_CRC - 1]));
    return Names(reading.file);
}

const Names& Session::right_names() {
    if (!names_) names_ = read_names();
    return *names_;
}

const Names& Session::names() {
    try {
        return right_names();
    } catch (const UserError& error) {
        host::complain(
            fmt::format("{}: {}; steps and signals have their numbers", common_.program, error.what()));
        return names_.emplace();
    }
}

void Session::pause(base::Microseconds time) {
    ByteClient::Rest rest = wire_->rest(time);
    if (rest == ByteClient::Rest::not_shared) return master_.pause(time);
    const base::Instant end = now() + kTurnWait;
    while (rest == ByteClient::Rest::still_taken && goes_on()) {
        if (now() >= end)
            throw LineError(LineError::Kind::port_gone,
                            fmt::format("{}: {} has held this port for a minute; end it first", wire_->name(),
                                        wire_->holder()));
        rest = wire_->rest(base::Microseconds{0});
    }
}

bool Session::wait_until_held(base::Milliseconds patience) {
    constexpr base::Milliseconds kPause{20};
    const base::Instant end = now() + patience;
    for (;;) {
        const auto state = status().run_state;
        if (state == gw::RunState::held) return true;
        if (state == gw::RunState::stopped || now() >= end) return false;
        gateway_.look_for_interruption();
        pause(kPause);
    }
}

void stop_work(Common& common, const std::function<void(Session&)>& what) {
    constexpr unsigned kMostPatience = 500;  // lost requests are repeated
    common.patience_ms = std::min(common.patience_ms, kMostPatience);
    command_line::guard(common, [&] {
        std::optional<Session> session;
        try {
            session.emplace(common, ByteClient::Holding::at_once);
        } catch (const LineError& error) {
            throw command_line::Failure(command_line::kNotConfirmed,
                                        fmt::format("{}: {}", error.what(), kMayStillRun));
        } catch (const mactalk_client::Interrupted& error) {
            throw mactalk_client::Interrupted(fmt::format("{}: {}", error.what(), kMayStillRun));
        } catch (const UserError& error) {
            throw UserError(fmt::format("{}: {}", error.what(), kMayStillRun));
        }
        what(*session);
    });
}

}  // namespace nplc::nanoctl::cli
