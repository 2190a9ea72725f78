#include "cli/session.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <system_error>

#include "cli/files.h"
#include "seqc/symbol_file.h"

namespace nplc::nanoctl::cli {
namespace {

volatile std::sig_atomic_t g_ended = 0;

/// A second signal ends the program at once.
void on_signal(int signal) {
    g_ended = 1;
    std::signal(signal, SIG_DFL);
}

std::unique_ptr<mactalk_client::Wire> open(const Common& common) {
    if (common.port.empty())
        throw UserError("no port; name one with --port or in the environment's NANOCTL_PORT");
    auto opened = mactalk_client::open_wire(common.port, common.baud);
    if (opened.wire == nullptr)
        throw mactalk_client::LineError(mactalk_client::LineError::Kind::port_gone, opened.error);
    return std::move(opened.wire);
}

}  // namespace

Session::Session(const Common& common)
    : common_(common),
      wire_(open(common)),
      master_(*wire_, {.baud = common.baud,
                       .patience = base::Milliseconds{common.patience_ms},
                       .attempts = common.attempts}),
      gateway_(master_, static_cast<std::uint8_t>(common.address)) {
    gateway_.set_goes_on(goes_on);
    gateway_.identify();
    if (common.symbols.empty()) return;
    const auto reading = seqc::read_symbols(read_whole(common.symbols));
    if (!reading.error.empty()) throw UserError(fmt::format("{}: {}", common.symbols, reading.error));
    const Block about = gateway_.read_block(gw::IDENTITY);
    if (about[gw::TABLE_BYTES - 1] != 0 && about[gw::TABLE_CRC - 1] != reading.file.crc32)
        throw UserError(
            fmt::format("{} belongs to another table than the active one (CRC {:08X}h, {:08X}h); "
                        "upload its table, or name the right file",
                        common.symbols, reading.file.crc32, about[gw::TABLE_CRC - 1]));
    names_ = Names(reading.file);
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

void Session::tell(const std::string& text, Json document) const {
    if (common_.json) {
        Json whole{{"ok", true}};
        whole.update(document);
        fmt::print("{}\n", whole.dump(-1, ' ', false, Json::error_handler_t::replace));
    } else {
        fmt::print("{}\n", text);
    }
    std::fflush(stdout);
}

void fail(Common& common, int exit_code, const std::string& text) {
    common.exit_code = exit_code;
    if (common.json)
        fmt::print("{}\n",
                   Json{{"ok", false}, {"error", text}}.dump(-1, ' ', false, Json::error_handler_t::replace));
    fmt::print(stderr, "nanoctl: {}\n", text);
}

void guard(Common& common, const std::function<void()>& what) {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_signal);
    std::signal(SIGPIPE, SIG_IGN);
    try {
        what();
    } catch (const UserError& error) {
        fail(common, kUsageOrFile, error.what());
    } catch (const Refused& error) {
        fail(common, kRefused, error.what());
    } catch (const WrongDevice& error) {
        fail(common, kNoAnswer, error.what());
    } catch (const mactalk_client::LineError& error) {
        fail(common, kNoAnswer, error.what());
    } catch (const Interrupted& error) {
        fail(common, kInterrupted, error.what());
    } catch (const std::system_error&) {  // of fmt::print; told below
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        fmt::print(stderr, "nanoctl: cannot write to standard output\n");
        common.exit_code = kUsageOrFile;
    }
}

void work(Common& common, const std::function<void(Session&)>& what) {
    guard(common, [&] {
        Session session(common);
        what(session);
    });
}

bool goes_on() {
    return g_ended == 0;
}

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& text) {
    CLI::App& command = *app.add_subcommand(name, text);
    command.fallthrough();
    return command;
}

}  // namespace nplc::nanoctl::cli
