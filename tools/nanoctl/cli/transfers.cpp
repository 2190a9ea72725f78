#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/crc32.h"
#include "cli/certificates.h"
#include "cli/dropped.h"
#include "cli/session.h"
#include "digest/digest.h"
#include "nanoctl/set_points.h"
#include "nanoctl/stopping.h"
#include "nanoctl/texts.h"
#include "nanoctl/transfer.h"
#include "uploads/uploads.h"
#include "whole_files/whole_files.h"

namespace nplc::nanoctl::cli {
namespace {

using mactalk_client::LineError;
using namespace uploads;  // NOLINT(google-build-using-namespace): its verbs are the commands here

struct UploadOptions {
    std::string file;
    std::string proof;
    bool stop = false;
    bool only_store = false;
    bool run = false;
};

/// Shows the progress of a transfer during its lifetime.
class ProgressLine {
  public:
    ProgressLine(const char* verb, Session& session)
        : verb_(verb), session_(session), begun_(session.now()) {}
    ~ProgressLine() { session_.progress(""); }
    Progress callback() {
        return [this](std::size_t done, std::size_t all) {
            if (all > 0)
                session_.progress(fmt::format("{} {} of {} bytes, {} %, {:.1f} s", verb_, done, all,
                                              100 * done / all, seconds()));
        };
    }
    double seconds() const { return static_cast<double>((session_.now() - begun_).count()) / 1e6; }

  private:
    const char* verb_;
    Session& session_;
    base::Instant begun_;
};

/// What of the kept values was dropped for it.
std::vector<set_points::Dropped> make_active(Session& session, const UploadOptions& options,
                                             const set_points::Record& record) {
    GatewayClient& gateway = session.gateway();
    const Status status = session.status();
    if (status.run_state != gw::RunState::stopped) {
        if (!options.stop)
            throw Refused(gw::Result::not_stopped, gw::COMMAND, 0,
                          "the table is stored and not active, since the sequence runs; `nanoctl stop` and "
                          "`nanoctl activate`, or upload with --stop");
        stop_machine(gateway, gw::Command::stop);
    }
    const std::optional<ValuesBefore> before = read_before(gateway, record);
    try {
        gateway.activate();
    } catch (const Interrupted&) {
        throw Interrupted("interrupted; the table is stored and not active");
    } catch (const LineError& error) {
        throw LineError(
            error.kind(),
            fmt::format("{}; the table is stored, and `nanoctl verify` tells whether it is active",
                        error.what()));
    }
    return read_dropped(gateway, before, record);
}

/// What a stored table will drop of the values once it is the active one.
std::vector<set_points::Dropped> foresee(GatewayClient& gateway, const set_points::Record& record) {
    const std::optional<ValuesBefore> before = read_before(gateway, record);
    return before ? foreseen_drops(*before, record) : std::vector<set_points::Dropped>{};
}

std::string dropped_text(const std::vector<set_points::Dropped>& dropped, bool only_store) {
    return (only_store && !dropped.empty() ? "\nonce it is the active one:" : "") + lines_of(dropped);
}

/// The bytes behind the end term are sent only to a gateway that supports them.
void look_for_room(GatewayClient& gateway) {
    if (!read_proof(gateway).is_taken)
        throw Refused(
            gw::Result::no_register, gw::PROOF_BYTES, 0,
            "the gateway's firmware is too old for certificates: renew it, or upload without --proof");
}

/// The active table has the digest.
void confirm(GatewayClient& gateway, const digest::Digest& digest) {
    if (read_proof(gateway).digest != digest)
        throw Refused(
            gw::Result::wrong_check, gw::PROOF, 0,
            "the active table does not have this certificate; another client changed it, upload it again");
}

void upload_file(Session& session, const UploadOptions& options) {
    const auto table = read_table(options.file);
    GatewayClient& gateway = session.gateway();
    const set_points::Record record = read_record(options.file, session.symbols(), table);
    const bool keeps = record.values.empty() || takes_set_points(gateway);
    std::vector<std::uint8_t> content = keeps ? set_points::with_record(table, record) : table;
    std::optional<digest::Digest> digest;
    if (!options.proof.empty()) {
        digest = certificate_for(options.proof, table);
        look_for_room(gateway);
        content = with_digest(content, *digest);
    }
    double seconds = 0;
    {
        ProgressLine line("sent", session);
        upload(gateway, content, line.callback());
        seconds = line.seconds();
    }
    const std::vector<set_points::Dropped> dropped =
        options.only_store ? foresee(gateway, record) : make_active(session, options, record);
    if (digest && !options.only_store) confirm(gateway, *digest);
    if (options.run) gateway.command(gw::Command::run);
    const std::uint32_t crc = base::crc32(table);
    const std::size_t terms = table.size() / 8 - 1;
    session.tell(
        fmt::format("{} of {} {} in {:.1f} s, CRC {:08X}h{}{}{}{}", options.file, terms_text(table.size()),
                    options.only_store ? "stored" : "stored and active", seconds, crc,
                    digest ? fmt::format(", certificate {}", options.proof) : "",
                    options.run ? ", started" : "",
                    keeps ? "" : "; its firmware keeps no set-points, the defaults stand in the table",
                    dropped_text(dropped, options.only_store)),
        {{"file", options.file},
         {"terms", terms},
         {"bytes", table.size()},
         {"crc32", crc},
         {"proof", digest ? digest::hex(*digest) : ""},
         {"active", !options.only_store},
         {"started", options.run},
         {"dropped", json_of(dropped)},
         {"seconds", seconds}});
}

struct VerifyOptions {
    std::string file;
    std::string proof;
    bool all_bytes = false;
};

/// The active table is known even if its set-points cannot be read.
set_points::Record record_if_readable(const std::string& file, const std::string& symbols,
                                      std::span<const std::uint8_t> table) {
    try {
        return read_record(file, symbols, table);
    } catch (const UserError&) {
        return {};
    }
}

/// What keeps the gateway's tables from being the file's.
std::string difference(const Block& about, bool active, bool stored, bool asks_certificate) {
    const auto of = [&](const char* name, gw::Number bytes) {
        if (about[bytes - gw::IDENTITY] == 0) return fmt::format("no table is {}", name);
        return fmt::format("the {} table of the gateway is another one{}", name,
                           asks_certificate ? ", or has not this certificate" : "");
    };
    std::string text;
    if (!stored) text = of("stored", gw::STORED_BYTES);
    if (!active) text += (text.empty() ? "" : "; ") + of("active", gw::TABLE_BYTES);
    return text;
}

void verify(Session& session, const VerifyOptions& options) {
    const auto& [file, certificate, all_bytes] = options;
    const auto table = read_table(file);
    std::optional<digest::Digest> asked;
    if (!certificate.empty()) asked = certificate_for(certificate, table);
    const Block about = session.gateway().read_block(gw::IDENTITY);
    const std::optional<digest::Digest> kept = read_proof(session.gateway()).digest;
    const std::uint32_t crc = base::crc32(table);
    const auto is_same = [&](std::span<const std::uint8_t> content, gw::Number crc_at, gw::Number bytes_at) {
        return about[crc_at - gw::IDENTITY] == base::crc32(content) &&
               about[bytes_at - gw::IDENTITY] == content.size();
    };
    const set_points::Record record = record_if_readable(file, session.symbols(), table);
    const bool keeps = !record.values.empty() && takes_set_points(session.gateway());
    const std::vector<std::uint8_t> content = keeps ? set_points::with_record(table, record) : table;
    const auto is_stored_with = [&](const std::optional<digest::Digest>& digest) {
        return is_same(digest ? with_digest(content, *digest) : content, gw::STORED_CRC, gw::STORED_BYTES);
    };
    bool active = is_same(table, gw::TABLE_CRC, gw::TABLE_BYTES) && (!asked || asked == kept);
    const bool stored = is_stored_with(asked) || (!asked && is_stored_with(kept));
    if (active && all_bytes) {
        ProgressLine line("read", session);
        active = download(session.gateway(), line.callback()) == table;
    }
    if (about[gw::STORED_BYTES - gw::IDENTITY] == 0 && about[gw::TABLE_BYTES - gw::IDENTITY] == 0)
        throw Refused(
            gw::Result::nothing_stored, gw::STORED_CRC, 0,
            fmt::format("{}: the gateway has no table, neither stored nor active; upload it", file));
    if (!active || !stored)
        throw Refused(gw::Result::wrong_check, gw::TABLE_CRC, 0,
                      fmt::format("{}: {}", file, difference(about, active, stored, asked.has_value())));
    session.tell(
        fmt::format("{}: stored and active in the gateway, CRC {:08X}h{}", file, crc,
                    all_bytes ? ", every byte read" : ""),
        {{"file", file}, {"crc32", crc}, {"active", true}, {"stored", true}, {"bytes_read", all_bytes}});
}

struct DownloadOptions {
    std::string file;
    bool force = false;
};

void download_to(Session& session, const DownloadOptions& options) {
    const std::string& file = options.file;
    if (const std::string why = whole_files::why_kept(file); !why.empty() && !options.force)
        throw UserError(why);
    std::vector<std::uint8_t> table;
    {
        ProgressLine line("read", session);
        table = download(session.gateway(), line.callback());
    }
    if (table.empty())
        throw Refused(gw::Result::no_table, gw::TABLE_DATA, 0, "the gateway has no active table");
    write_table(file, table);
    session.tell(fmt::format("{}: {}, CRC {:08X}h", file, terms_text(table.size()), base::crc32(table)),
                 {{"file", file},
                  {"terms", table.size() / 8 - 1},
                  {"bytes", table.size()},
                  {"crc32", base::crc32(table)}});
}

}  // namespace

void add_transfers(arguments::App& app, Common& common) {
    auto [up, options] =
        add_command(app, common, "upload",
                    "Store a table in the gateway and make it the active one. The sequence must be "
                    "stopped for that, and the motor stand still (it is waited for 5 s)",
                    upload_file);
    up.add_option("table", options.file, "The table that seqc built, F.bin or F.hex")->required();
    up.add_option(
          "--proof", options.proof,
          "The table's certificate, of seqc verify --proof; without one the gateway forgets the last one")
        ->type_name("F.proof");
    up.add_flag("--stop", options.stop, "Stop the sequence first if it runs");
    up.add_flag("--run", options.run, "Start the sequence afterwards");
    up.add_flag("--only-store", options.only_store,
                "Do not make it the active one; what runs goes on, and the next power-up takes the new one")
        ->excludes("--stop")
        ->excludes("--run");

    auto [check, verified] =
        add_command(app, common, "verify", "Is this table the stored and the active one?", verify);
    check.add_option("table", verified.file, "The table, F.bin or F.hex")->required();
    check.add_option("--proof", verified.proof, "And with this certificate?")->type_name("F.proof");
    check.add_flag("--bytes", verified.all_bytes, "Read every byte back, not only length and CRC");

    auto [down, target] =
        add_command(app, common, "download", "Write the active table into a file", download_to);
    down.add_option("-o,--output", target.file, "F.bin, or F.hex for Intel HEX")->required();
    down.add_flag("--force", target.force, "Replace a file that is there");
}

}  // namespace nplc::nanoctl::cli
