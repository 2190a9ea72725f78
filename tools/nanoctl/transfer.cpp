#include "nanoctl/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/bytes.h"
#include "base/crc32.h"
#include "registers/family.h"
#include "sequencer/state.h"
#include "sequencer/table.h"

namespace nplc::nanoctl {
namespace {

using gw::StorePhase;
using mactalk_client::LineError;

constexpr std::size_t kLargestPiece = protocol::mactalk::kMaxLongWrite;
constexpr std::size_t kSmallestPiece = 8;
constexpr unsigned kLostInARow = 40;
constexpr unsigned kGoodBeforeLarger = 4;
/// Maximum time that the gateway waits for room in its storage before it refuses a piece.
constexpr base::Milliseconds kRoomWait{1'000};
constexpr base::Milliseconds kPollPause{20};
constexpr unsigned kMostPolls = 1'500;

struct UploadStatus {
    StorePhase phase;
    gw::Result result;
    std::uint16_t detail;
    std::uint32_t received;
};

UploadStatus upload_status(GatewayClient& gateway) {
    const std::uint32_t state = gateway.read(gw::UPLOAD_STATE);
    return {static_cast<StorePhase>(state & 0xFF), static_cast<gw::Result>((state >> 8) & 0xFF),
            static_cast<std::uint16_t>(state >> 16), gateway.read(gw::UPLOAD_RECEIVED)};
}

[[noreturn]] void upload_failed(gw::Result result, std::uint16_t detail) {
    std::string what(gw::describe(result));
    if (result == gw::Result::wrong_check)
        what += "; another client uploads at the same time, or the line is bad";
    if (result == gw::Result::no_upload) what = "the gateway or another client gave the upload up";
    if (result >= gw::Result::table_no_end) what += fmt::format(" (term {})", detail);
    throw Refused(result, gw::UPLOAD_STATE, detail,
                  "the table was not stored: " + what + "; upload it again");
}

/// Waits while the upload is in `phase`.
UploadStatus wait_while(GatewayClient& gateway, StorePhase phase) {
    for (unsigned i = 0; i < kMostPolls; ++i) {
        const UploadStatus status = upload_status(gateway);
        if (status.phase == StorePhase::failed) upload_failed(status.result, status.detail);
        if (status.phase != phase) return status;
        gateway.look_for_interruption();
        gateway.master().pause(kPollPause);
    }
    throw LineError(LineError::Kind::no_answer, "the gateway's storage does not come to an end; restart it");
}

class Upload {
  public:
    Upload(GatewayClient& gateway, std::span<const std::uint8_t> table) : gateway_(gateway), table_(table) {}

    void send(const Progress& progress) {
        while (sent_ < table_.size()) {
            gateway_.look_for_interruption();
            progress(sent_, table_.size());
            if (send_piece()) {
                lost_in_a_row_ = 0;
                if (++good_ >= kGoodBeforeLarger) piece_ = std::min(2 * piece_, kLargestPiece);
            } else {
                recover();
            }
        }
        progress(sent_, table_.size());
    }

  private:
    bool send_piece() {
        const auto piece = table_.subspan(sent_, std::min(piece_, table_.size() - sent_));
        if (!gateway_.master().try_write_long(gateway_.address(), gw::TABLE_DATA, piece, kRoomWait))
            return false;
        sent_ += piece.size();
        return true;
    }

    /// Reads how much has arrived and continues from there.
    void recover() {
        good_ = 0;
        piece_ = std::max(piece_ / 2, kSmallestPiece);
        const UploadStatus status = upload_status(gateway_);
        if (status.phase == StorePhase::failed) upload_failed(status.result, status.detail);
        if (status.phase != StorePhase::receiving && status.phase != StorePhase::erasing)
            upload_failed(gw::Result::no_upload, 0);
        const std::size_t before = sent_;
        sent_ = std::min<std::size_t>(status.received, table_.size());
        lost_in_a_row_ = sent_ > before ? 0 : lost_in_a_row_ + 1;
        if (lost_in_a_row_ == kLostInARow)
            throw LineError(LineError::Kind::no_answer,
                            fmt::format("{}: byte {} of the table was never accepted; the line is too bad",
                                        gateway_.master().wire().name(), sent_));
        gateway_.write(gw::TABLE_POINTER, static_cast<std::uint32_t>(sent_));
    }

    GatewayClient& gateway_;
    std::span<const std::uint8_t> table_;
    std::size_t sent_ = 0;
    std::size_t piece_ = kLargestPiece;
    unsigned good_ = 0;
    unsigned lost_in_a_row_ = 0;
};

void commit(GatewayClient& gateway) {
    try {
        gateway.command(gw::Command::upload_commit);
    } catch (const Refused& refused) {
        upload_failed(refused.result(), refused.detail());
    }
}

/// Runs a part of an upload; if the connection is lost in it, the error also says what the gateway has
/// stored.
void part(const char* stored, const std::function<void()>& what) {
    try {
        what();
    } catch (const LineError& error) {
        throw LineError(error.kind(), fmt::format("{}; {}", error.what(), stored));
    }
}

void upload_whole(GatewayClient& gateway, std::span<const std::uint8_t> table, const Progress& progress) {
    part("the upload was not finished, the stored table is as it was and so is the active one", [&] {
        gateway.command(gw::Command::upload_begin);
        wait_while(gateway, StorePhase::erasing);
        Upload(gateway, table).send(progress);
        gateway.write(gw::UPLOAD_CRC, base::crc32(table));
        gateway.write(gw::UPLOAD_BYTES, static_cast<std::uint32_t>(table.size()));
    });
    part(
        "the old table or the new one is stored, whole, and the active one is as it was; `nanoctl verify` "
        "tells "
        "which is stored",
        [&] {
            commit(gateway);
            const UploadStatus end = wait_while(gateway, StorePhase::closing);
            if (end.phase != StorePhase::done) upload_failed(gw::Result::no_upload, 0);
        });
}

/// Why the gateway's drive cannot carry out the command of a term; empty where that is unknown.
std::string_view why_not(GatewayClient& gateway, std::span<const std::uint8_t> table, std::uint16_t term) {
    const auto loaded = sequencer::Table::load(table);
    if (!loaded.ok || term >= loaded.table.size()) return {};
    const registers::DriveModel* drive =
        registers::drive_of_kind(gateway.read(gw::register_of(gw::Setting::motor_kind)));
    if (drive == nullptr) return {};
    const auto order = sequencer::order_of(loaded.table.term(term));
    return order.is_register_write
               ? drive->family->refuses_write(*drive, order.reg, order.longword, order.value)
               : drive->family->refuses_command(*drive, order.command);
}

void cancel_upload(GatewayClient& gateway) {
    try {
        gateway.command(gw::Command::upload_abort);
    } catch (const Refused&) {  // it was aborted already
    }
}

}  // namespace

void upload(GatewayClient& gateway, std::span<const std::uint8_t> table, const Progress& progress) {
    const std::uint32_t most = gateway.read(gw::STORED_MAX);
    if (table.size() > most)
        throw Refused(gw::Result::no_space, gw::TABLE_DATA, 0,
                      fmt::format("the table has {} bytes and the gateway takes {}", table.size(), most));
    try {
        upload_whole(gateway, table, progress);
    } catch (const Refused& refused) {
        // The present upload is another client's if this one was aborted.
        if (refused.reg() != gw::UPLOAD_STATE && refused.result() != gw::Result::no_upload)
            cancel_upload(gateway);
        if (refused.result() != gw::Result::not_for_motor) throw;
        const std::string_view why = why_not(gateway, table, refused.detail());
        if (why.empty()) throw;
        throw Refused(refused.result(), refused.reg(), refused.detail(),
                      fmt::format("the table was not stored, for its term {}: {}", refused.detail(), why));
    } catch (const Interrupted&) {
        cancel_upload(gateway);
        throw Interrupted("interrupted; the upload was aborted, the stored table is as it was");
    }
}

std::vector<std::uint8_t> download(GatewayClient& gateway, const Progress& progress) {
    const Block about = gateway.read_block(gw::IDENTITY);
    const std::uint32_t length = about[gw::TABLE_BYTES - gw::IDENTITY];
    const std::uint32_t crc = about[gw::TABLE_CRC - gw::IDENTITY];
    std::vector<std::uint8_t> table;
    unsigned lost_in_a_row = 0;
    bool in_place = false;
    while (table.size() < length) {
        gateway.look_for_interruption();
        progress(table.size(), length);
        if (!in_place) gateway.write(gw::TABLE_POINTER, static_cast<std::uint32_t>(table.size()));
        const auto block = gateway.master().try_read_block(gateway.address(), gw::TABLE_DATA);
        in_place = block.has_value();
        lost_in_a_row = in_place ? 0 : lost_in_a_row + 1;
        if (lost_in_a_row == kLostInARow)
            throw LineError(LineError::Kind::no_answer,
                            fmt::format("{}: byte {} of the table cannot be read; the line is too bad",
                                        gateway.master().wire().name(), table.size()));
        if (!block) continue;
        const std::size_t count = std::min<std::size_t>(block->size(), length - table.size());
        table.insert(table.end(), block->begin(), block->begin() + static_cast<std::ptrdiff_t>(count));
    }
    progress(table.size(), length);
    if (base::crc32(table) != crc || gateway.read(gw::TABLE_CRC) != crc)
        throw Refused(gw::Result::wrong_check, gw::TABLE_DATA, 0,
                      "what was read is not the active table; another client changes it, read it again");
    return table;
}

}  // namespace nplc::nanoctl
