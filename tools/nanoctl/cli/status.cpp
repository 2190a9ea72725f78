#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "causes/codes.h"
#include "cli/certificates.h"
#include "cli/session.h"
#include "digest/digest.h"
#include "nanoctl/stopping.h"
#include "nanoctl/texts.h"
#include "nanoctl/why.h"

namespace nplc::nanoctl::cli {
namespace {

Json document_of(const Status& status, const Names& names, std::uint32_t unconfirmed_ms) {
    return {{"state", name_of(status.run_state)},
            {"step", status.step},
            {"step_name", names.step_name(status.step)},
            {"timer", status.timer},
            {"counter", status.counter},
            {"inputs", status.inputs & 0x3F},
            {"terminals", status.terminals & 0x3F},
            {"outputs", status.outputs},
            {"written_outputs", status.written_outputs},
            {"forced_outputs", status.forced_outputs},
            {"force_left_ms", status.force_left},
            {"in_position", status.has(gw::kInPosition)},
            {"error", status.has(gw::kMotorError)},
            {"safe_reason", status.safe_reason == gw::SafeReason::none ? "" : name_of(status.safe_reason)},
            {"safe_since_ms", status.safe_since},
            {"uptime_ms", status.uptime},
            {"link", name_of(status.link)},
            {"scans", status.scans},
            {"scan_time_us", status.scan_time},
            {"scan_worst_us", status.scan_worst},
            {"forced_inputs", status.has(gw::kForcedInputs)},
            {"breakpoints", status.has(gw::kBreakpoints)},
            {"at_breakpoint", status.has(gw::kAtBreakpoint)},
            {"can_go_on", !status.has(gw::kCannotGoOn)},
            {"stop_unconfirmed", status.has(gw::kStopUnconfirmed)},
            {"stop_unconfirmed_ms", unconfirmed_ms},
            {"table", status.has(gw::kTable)},
            {"upload", status.has(gw::kUpload)},
            {"stored_differs", status.has(gw::kStoredDiffers)},
            {"settings_differ", status.has(gw::kSettingsDiffer)},
            {"enabled", status.has(gw::kEnabled)},
            {"virtual_motor", status.has(gw::kVirtualMotor)}};
}

/// `overdue_ms`: how long a stop that should have been confirmed is not, 0: not known. Empty: none is.
std::string line_of(const Status& status, const Names& names, std::optional<std::uint32_t> overdue_ms) {
    std::string text = fmt::format("{}, step {}, timer {} ms, counter {}, in {}, out {}",
                                   name_of(status.run_state), names.step(status.step), status.timer,
                                   status.counter, signals_text(status.inputs, 6, names, true),
                                   signals_text(status.outputs, 4, names, false));
    if (status.has(gw::kInPosition)) text += ", IN_POS";
    if (status.has(gw::kMotorError)) text += ", ERROR";
    if (status.has(gw::kAtBreakpoint)) text += ", at a breakpoint";
    text += held_remark(status);
    if (overdue_ms)
        text += ", " + unconfirmed_text(*overdue_ms);
    else if (status.has(gw::kStopUnconfirmed))
        text += ", the motor is being stopped";
    if (status.has(gw::kForcedInputs) || status.has(gw::kForcedOutputs))
        text += fmt::format(", FORCED for {} ms", status.force_left);
    if (status.has(gw::kSafe)) text += fmt::format(", SAFE: {}", name_of(status.safe_reason));
    if (status.has(gw::kUpload)) text += ", an upload is under way";
    return text;
}

std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}.{}", version >> 16, version >> 8 & 0xFF, version & 0xFF);
}

std::string table_text(std::uint32_t bytes, std::uint32_t crc) {
    return bytes == 0 ? "none" : fmt::format("{}, CRC {:08X}h", terms_text(bytes), crc);
}

/// A stored table's length and CRC include its certificate; those of the active one do not.
std::string stored_text(const Block& about, const Status& status) {
    const bool same = about[gw::STORED_BYTES - gw::IDENTITY] != 0 && !status.has(gw::kStoredDiffers);
    const auto of = [&](gw::Number number) { return about[number - gw::IDENTITY]; };
    return same ? table_text(of(gw::TABLE_BYTES), of(gw::TABLE_CRC))
                : table_text(of(gw::STORED_BYTES), of(gw::STORED_CRC));
}

/// Without an adapter an echo takes two or three characters, 1.6 ms at 19200 baud.
std::string echo_text(std::uint32_t us) {
    constexpr std::uint32_t kSlow = 4'000;
    constexpr std::uint32_t kMost = 40'000;
    if (us == 0) return {};
    std::string text = fmt::format("\nechoes from the motor take up to {:.1f} ms", us / 1000.0);
    if (us > kMost)
        text += ", more than the 40 ms that are allowed: set the latency timer of its USB adapter to 1 ms";
    else if (us > kSlow)
        text +=
            ": every order waits for one, which costs the machine time, and a cut is noticed later; set the "
            "latency timer of its USB adapter to 1 ms";
    return text;
}

/// The most urgent cause first.
std::string why_text(const Why& why) {
    std::string text;
    for (const causes::Finding& one : why.findings) {
        text += fmt::format("\n{} {} ({}, {})\n    -> {}", text.empty() ? "why:" : "    ", one.sentence,
                            one.code, causes::number_of(one.code), one.remedy);
    }
    if (why.motor_is_silent)
        text += "\nthe motor's registers could not be read: the gateway's own causes alone are shown";
    return text;
}

Json why_document(const Why& why) {
    Json list = Json::array();
    for (const causes::Finding& one : why.findings) {
        list.push_back({{"code", one.code},
                        {"number", causes::number_of(one.code)},
                        {"severity", causes::name_of(one.severity)},
                        {"sentence", one.sentence},
                        {"remedy", one.remedy}});
    }
    return list;
}

/// Both of one state of the tables: read again if one was exchanged between.
std::pair<Block, Status> identity_and_status(GatewayClient& gateway) {
    constexpr int kTries = 5;
    Block about = gateway.read_block(gw::IDENTITY);
    for (int i = 1;; ++i) {
        const Status status = status_after_stop(gateway);
        const Block after = gateway.read_block(gw::IDENTITY);
        if (after == about || i == kTries) return {after, status};
        about = after;
    }
}

std::string first_run_text(std::uint32_t flags) {
    if ((flags & gw::kFirstRunWanted) == 0) return {};
    if ((flags & gw::kStoreLost) != 0)
        return "\nLOST: the store that the axis had; look at its table and settings: waits for `nanoctl run`";
    if ((flags & gw::kStoreOfAnother) != 0)
        return "\nthe store of another axis, which the gateway's journal names; look at its table and "
               "settings: waits for `nanoctl run`";
    return "\nnew here: waits for a first run command, `nanoctl run`";
}

struct StatusOptions {
    bool why = false;
};

std::string store_text(const Status& status, std::uint32_t flags) {
    if (status.safe_reason == gw::SafeReason::no_store)
        return "\nNO STORE: it is locked, missing or not writable; the gateway's journal says why";
    std::string text;
    if ((flags & gw::kTableDamaged) != 0)
        text += "\nDAMAGED: a stored table; an older one or none is in use, upload again";
    if ((flags & gw::kSettingsDamaged) != 0)
        text += "\nDAMAGED: the stored settings; older or initial ones are in use, set and keep them";
    if ((flags & gw::kSetPointsDamaged) != 0)
        text += "\nDAMAGED: the stored set-points; older ones or the defaults are in use, set them anew";
    return text;
}

void show_status(Session& session, const StatusOptions& options) {
    session.right_names();
    GatewayClient& gateway = session.gateway();
    const auto [about, status] = identity_and_status(gateway);
    const std::optional<digest::Digest> digest = read_proof(gateway).digest;
    const Block counters = gateway.read_block(gw::LINK_LOSSES);
    const auto of = [&](gw::Number number) { return about[number - gw::IDENTITY]; };
    const auto count = [&](gw::Number number) { return counters[number - gw::LINK_LOSSES]; };
    const std::uint32_t flags = of(gw::STORE_FLAGS);
    const std::uint32_t unconfirmed_ms = stop_unconfirmed_ms(gateway, status);
    const auto overdue_ms = status.has(gw::kStopUnconfirmed) ? std::optional(unconfirmed_ms) : std::nullopt;
    std::string text = line_of(status, session.names(), overdue_ms);
    text +=
        fmt::format("\nfirmware {}, up for {}", version_text(of(gw::FW_VERSION)), time_text(status.uptime));
    text += fmt::format("\nactive table {}; stored table {}",
                        table_text(of(gw::TABLE_BYTES), of(gw::TABLE_CRC)), stored_text(about, status));
    if (digest) text += fmt::format("\ncertificate {}", digest::hex(*digest));
    text += store_text(status, flags);
    text += first_run_text(flags);
    text += fmt::format("\nmotor link {}, lost {} times, {} messages repeated, {} orders done, {} discarded",
                        name_of(status.link), count(gw::LINK_LOSSES), count(gw::RESENT), count(gw::ORDERS),
                        count(gw::DISCARDED));
    text += fmt::format("\n{} scans, the last {} us, the longest {} us", status.scans, status.scan_time,
                        status.scan_worst);
    text += fmt::format("\npolls at most {} us late, {} of them beyond the limit", count(gw::POLL_WORST),
                        count(gw::LATE_POLLS));
    text += echo_text(count(gw::ECHO_TIME));
    if (status.has(gw::kSettingsDiffer)) text += "\nsettings differ from the stored ones";
    const Why why = options.why ? ask_why(gateway, status) : why_of_gateway(gateway, status);
    text += why_text(why);
    Json document = document_of(status, session.names(), unconfirmed_ms);
    document.update({{"firmware", version_text(of(gw::FW_VERSION))},
                     {"table_bytes", of(gw::TABLE_BYTES)},
                     {"table_crc32", of(gw::TABLE_CRC)},
                     {"stored_bytes", of(gw::STORED_BYTES)},
                     {"stored_crc32", of(gw::STORED_CRC)},
                     {"proof", digest ? digest::hex(*digest) : ""},
                     {"table_damaged", (flags & gw::kTableDamaged) != 0},
                     {"settings_damaged", (flags & gw::kSettingsDamaged) != 0},
                     {"set_points_damaged", (flags & gw::kSetPointsDamaged) != 0},
                     {"waits_for_first_run", (flags & gw::kFirstRunWanted) != 0},
                     {"store_lost", (flags & gw::kStoreLost) != 0},
                     {"store_of_another_axis", (flags & gw::kStoreOfAnother) != 0},
                     {"link_losses", count(gw::LINK_LOSSES)},
                     {"resent", count(gw::RESENT)},
                     {"orders", count(gw::ORDERS)},
                     {"discarded", count(gw::DISCARDED)},
                     {"poll_worst_us", count(gw::POLL_WORST)},
                     {"late_polls", count(gw::LATE_POLLS)},
                     {"echo_time_us", count(gw::ECHO_TIME)},
                     {"why", why_document(why)},
                     {"why_of_motor", why.knows_motor}});
    session.tell(text, document);
}

struct WatchOptions {
    unsigned interval_ms = 100;
    double seconds = 0;
    bool all = false;
};

/// A line at every relevant change, with the gateway's time.
void watch(Session& session, const WatchOptions& options) {
    session.right_names();
    std::string last;
    StopConfirmation confirmation;
    command_line::watch(session, base::Milliseconds{options.interval_ms}, options.seconds, [&] {
        const Status status = session.status();
        Status quiet = status;
        quiet.timer = 0;
        quiet.force_left = 0;
        const bool is_overdue = confirmation.is_overdue(status);
        const auto line_at = [&](const Status& shown, std::uint32_t ms) {
            return line_of(shown, session.names(), is_overdue ? std::optional(ms) : std::nullopt);
        };
        const std::string line = line_at(quiet, 0);
        if (line != last || options.all) {
            const std::uint32_t unconfirmed_ms = stop_unconfirmed_ms(session.gateway(), status);
            session.tell(fmt::format("{:>12}  {}", time_text(status.uptime), line_at(status, unconfirmed_ms)),
                         document_of(status, session.names(), unconfirmed_ms));
        }
        last = line;
    });
}

}  // namespace

void add_status(arguments::App& app, Common& common) {
    auto [status, status_options] =
        add_command(app, common, "status",
                    "What the gateway does, has and went through, and why nothing moves", show_status);
    status.add_flag(
        "--why", status_options.why,
        "Read the motor's registers too, some 3 seconds long: the causes are then those of `macreg "
        "why`; else the gateway's own");
    auto [command, options] = add_command(
        app, common, "watch",
        "A line at every change, until Ctrl-C or until nobody reads it; with --json a document a line",
        watch);
    command.add_option("--interval", options.interval_ms, "Milliseconds between two looks")
        ->capture_default_str()
        ->in_range(0, 60'000);
    command.add_option("--for", options.seconds, "End after so many seconds; 0: at Ctrl-C")->non_negative();
    command.add_flag("--all", options.all, "A line at every look, changed or not");
}

}  // namespace nplc::nanoctl::cli
