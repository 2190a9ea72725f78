#include "cli/session.h"

#include <fmt/format.h>

#include "command_line/files.h"
#include "seqc/symbol_file.h"

namespace nplc::nanoctl::cli {
Session::Session(const Common& common)
    : common_(common),
      wire_(command_line::open_port(common)),
      master_(*wire_, {.baud = common.baud,
                       .patience = base::Milliseconds{common.patience_ms},
                       .attempts = common.attempts}),
      gateway_(master_, static_cast<std::uint8_t>(common.address)) {
    gateway_.set_goes_on(goes_on);
    gateway_.identify();
    if (common.symbols.empty()) return;
    const auto reading = seqc::read_symbols(command_line::read_whole(common.symbols));
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

void work(Common& common, const std::function<void(Session&)>& what) {
    command_line::guard(common, [&] {
        try {
            Session session(common);
            what(session);
        } catch (const Refused& error) {
            throw command_line::Failure(command_line::kRefused, error.what());
        } catch (const WrongDevice& error) {
            throw command_line::Failure(command_line::kNoAnswer, error.what());
        }
    });
}

}  // namespace nplc::nanoctl::cli
