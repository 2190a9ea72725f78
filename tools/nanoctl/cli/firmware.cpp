#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "command_line/files.h"
#include "nanoctl/firmware.h"

namespace nplc::nanoctl::cli {
namespace {

using mactalk_client::LineError;

/// An image on trial confirms itself after 10 s; before that it may start three times.
constexpr base::Milliseconds kTrialWait{60'000};
constexpr base::Milliseconds kTrialLookPause{250};

struct FirmwareOptions {
    std::string file;
    bool only_store = false;
};

std::string slot_text(const FirmwareStatus& status, unsigned slot) {
    const std::uint32_t marks = status.slots[slot];
    std::string text = fmt::format("slot {}: ", slot);
    if ((marks & gw::kSlotComplete) == 0) return text + "empty";
    text += version_text(status.versions[slot]);
    const std::uint32_t tries = (marks & gw::kSlotTries) >> 8;
    if ((marks & gw::kSlotConfirmed) != 0) {
        text += ", confirmed";
    } else if (slot == status.running) {
        text += ", on trial";
    } else {
        text += tries == 0 ? ", to be tried at the next start"
                           : fmt::format(", not confirmed in {} starts", tries);
    }
    return text + (slot == status.running ? ", runs" : "");
}

Json firmware_document(const FirmwareStatus& status) {
    Json slots = Json::array();
    for (unsigned slot = 0; slot < gw::kFirmwareSlots; ++slot) {
        const std::uint32_t marks = status.slots[slot];
        slots.push_back(
            {{"version", (marks & gw::kSlotComplete) != 0 ? version_text(status.versions[slot]) : ""},
             {"confirmed", (marks & gw::kSlotConfirmed) != 0},
             {"tries", (marks & gw::kSlotTries) >> 8}});
    }
    return {{"board", status.board},
            {"running", status.running},
            {"confirmed", status.confirmed},
            {"slots", slots}};
}

void show_firmware(Session& session, const FirmwareStatus& status) {
    session.tell(slot_text(status, 0) + '\n' + slot_text(status, 1), firmware_document(status));
}

[[noreturn]] void refuse_firmware(gw::Result result, const std::string& what) {
    throw Refused(result, gw::FIRMWARE_STATE, 0, what);
}

/// Checks the file before sending it, which takes half a minute.
FirmwareLink link_for(const FirmwareStatus& status, const std::vector<FirmwareLink>& links,
                      const std::string& file) {
    if (links.empty())
        throw UserError(
            fmt::format("{}: no signed firmware, or only a part; tools/sign_firmware makes one", file));
    const FirmwareLink& link = links[status.other()];
    if (link.header.board != status.board)
        refuse_firmware(gw::Result::other_board, fmt::format("{}: it is for board {}, this is board {}", file,
                                                             link.header.board, status.board));
    if (link.header.version <= status.versions[status.running])
        refuse_firmware(
            gw::Result::not_newer,
            fmt::format("{}: it is {}, and {} runs; a board takes only a later version", file,
                        version_text(link.header.version), version_text(status.versions[status.running])));
    return link;
}

/// After a reset, while the gateway may not answer: nullopt without an answer.
std::optional<FirmwareStatus> look_at_firmware(GatewayClient& gateway) {
    try {
        return firmware_status(gateway);
    } catch (const LineError& error) {
        if (error.kind() != LineError::Kind::no_answer) throw;
        return std::nullopt;
    }
}

void restart_firmware(GatewayClient& gateway) {
    try {
        gateway.reset();
    } catch (const LineError& error) {
        if (error.kind() != LineError::Kind::no_answer) throw;
    }
}

[[noreturn]] void tell_fallback(const FirmwareStatus& status, unsigned slot, const std::string& version) {
    const std::uint32_t tries = (status.slots[slot] & gw::kSlotTries) >> 8;
    const std::string runs = version_text(status.versions[status.running]);
    if (tries == 0)
        refuse_firmware(
            gw::Result::bad_firmware,
            fmt::format("the loader did not start {}: it is not signed with the key of this board; {} runs",
                        version, runs));
    refuse_firmware(
        gw::Result::not_confirmed,
        fmt::format("{} did not run healthily in {} starts; {} runs again", version, tries, runs));
}

/// Waits until the image of `slot` is confirmed.
FirmwareStatus wait_for_trial(Session& session, unsigned slot, const std::string& version) {
    GatewayClient& gateway = session.gateway();
    const base::Instant end = session.now() + kTrialWait;
    while (session.now() < end) {
        const auto status = look_at_firmware(gateway);
        if (status && status->running != slot) tell_fallback(*status, slot, version);
        if (status && status->confirmed) return *status;
        session.progress(status ? fmt::format("{} runs on trial", version) : "waiting for the board");
        gateway.look_for_interruption();
        gateway.master().pause(kTrialLookPause);
    }
    throw LineError(
        LineError::Kind::no_answer,
        fmt::format("{} is stored, and was not confirmed within {} s; look at `nanoctl firmware`. A board "
                    "whose user's port must be chosen at the start (button A) needs that at this one too",
                    version, kTrialWait.count() / 1000));
}

void renew(Session& session, const FirmwareStatus& before, const FirmwareOptions& options) {
    const std::string content = command_line::read_whole(options.file);
    const std::vector<std::uint8_t> file(content.begin(), content.end());
    const FirmwareLink link = link_for(before, firmware_links(file), options.file);
    const std::string version = version_text(link.header.version);
    send_firmware(session.gateway(), link.bytes, [&](std::size_t done, std::size_t all) {
        session.progress(fmt::format("sent {} of {} bytes, {} %", done, all, 100 * done / all));
    });
    session.progress("");
    if (options.only_store) {
        session.tell(fmt::format("{} is stored, and tried at the next start (`nanoctl reset`)", version),
                     {{"version", version}, {"slot", before.other()}, {"confirmed", false}});
        return;
    }
    restart_firmware(session.gateway());
    const FirmwareStatus after = wait_for_trial(session, before.other(), version);
    session.progress("");
    session.tell(fmt::format("{} runs and is confirmed; {} stays in slot {}", version,
                             version_text(after.versions[after.other()]), after.other()),
                 {{"version", version}, {"slot", after.running}, {"confirmed", true}});
}

void firmware(Session& session, const FirmwareOptions& options) {
    const FirmwareStatus status = firmware_status(session.gateway());
    if (status.board == 0)
        refuse_firmware(
            gw::Result::no_register,
            "the firmware of this gateway is not renewed over its user's port: its board has no loader");
    if (options.file.empty()) return show_firmware(session, status);
    renew(session, status, options);
}

}  // namespace

void add_firmware(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "firmware",
                    "What firmware a microcontroller board has in its two slots; with a file, a new one: "
                    "stored, started on trial, "
                    "confirmed once it has run for 10 s, otherwise the old one starts again",
                    firmware);
    command.add_option("file", options.file, "A signed firmware, F.npfw of tools/sign_firmware");
    command.add_flag("--only-store", options.only_store, "Do not restart the board");
}

}  // namespace nplc::nanoctl::cli
