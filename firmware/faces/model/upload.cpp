#include "faces/upload.h"

#include <algorithm>
#include <utility>

#include "base/crc32.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;

constexpr std::size_t kUploadPiece = 128;
constexpr base::Milliseconds kUploadPause{20};
/// Timeout of an erase of the store, and of the motor's standstill.
constexpr base::Milliseconds kLongestUpload{10'000};

}  // namespace

Upload::Upload(std::vector<std::uint8_t> table, Afterwards afterwards, std::uint64_t request)
    : table_(std::move(table)), afterwards_(afterwards), request_(request) {}

std::uint32_t Upload::crc() const {
    return base::crc32(table_);
}

std::span<const std::uint8_t> Upload::piece() const {
    return std::span(table_).subspan(sent_, std::min(kUploadPiece, table_.size() - sent_));
}

std::string_view Upload::stage_in_words() const {
    switch (is_over() ? failed_in_ : stage_) {
        case Stage::begin:
        case Stage::pieces:
            return "sending the table";
        case Stage::length:
        case Stage::check:
        case Stage::commit:
        case Stage::storing:
            return "storing the table";
        case Stage::stop:
            return "stopping the sequence";
        case Stage::activate:
            return "making the table active";
        case Stage::run:
            return "running it";
        case Stage::over:
            break;
    }
    return "";
}

std::optional<Command> Upload::command(base::Instant now) const {
    switch (stage_) {
        case Stage::begin:
            return Command::of(gw::Command::upload_begin, now);
        case Stage::pieces:
            return Command::table_piece(piece(), now);
        case Stage::length:
            return Command::own(gw::UPLOAD_BYTES, static_cast<std::uint32_t>(table_.size()), now);
        case Stage::check:
            return Command::own(gw::UPLOAD_CRC, crc(), now);
        case Stage::commit:
            return Command::of(gw::Command::upload_commit, now);
        case Stage::stop:
            return Command::of(gw::Command::stop, now);
        case Stage::activate:
            return Command::of(gw::Command::activate, now);
        case Stage::run:
            return Command::of(gw::Command::run, now);
        case Stage::storing:
        case Stage::over:
            break;
    }
    return std::nullopt;
}

std::optional<Command> Upload::look_at_store(const AxisImage& image) {
    if (image.number <= image_at_commit_) return std::nullopt;
    const std::uint32_t state = image[gw::UPLOAD_STATE];
    const auto phase = static_cast<gw::StorePhase>(state & 0xFF);
    if (phase == gw::StorePhase::done) go_on();
    if (phase == gw::StorePhase::idle)
        fail(Result::too_late, 0);  // aborted by another client: safe, or a reset
    if (phase == gw::StorePhase::failed)
        fail(static_cast<Result>(state >> 8 & 0xFF), static_cast<std::uint16_t>(state >> 16));
    return std::nullopt;
}

std::optional<Command> Upload::next(const AxisImage& image, base::Instant now) {
    if (is_over() || is_waiting_ || now < not_before_) return std::nullopt;
    if (stage_ == Stage::storing) look_at_store(image);
    if (stage_ == Stage::commit) image_at_commit_ = image.number + 1;
    const auto result = command(now);
    is_waiting_ = result.has_value();
    return result;
}

void Upload::fail(Result result, std::uint16_t detail) {
    failed_in_ = stage_;
    stage_ = Stage::over;
    result_ = result;
    detail_ = detail;
}

void Upload::go_on() {
    first_refusal_.reset();
    if (stage_ == Stage::pieces) {
        sent_ += piece().size();
        if (sent_ < table_.size()) return;
    }
    const bool ends = (stage_ == Stage::storing && !afterwards_.activate) ||
                      (stage_ == Stage::activate && !afterwards_.run) || stage_ == Stage::run;
    failed_in_ = stage_;
    stage_ = ends ? Stage::over : static_cast<Stage>(static_cast<unsigned>(stage_) + 1);
}

bool Upload::may_try_again(Result result, base::Instant now) const {
    const bool passes = result == Result::busy || (stage_ == Stage::activate && result == Result::moving);
    return passes && (!first_refusal_ || now - *first_refusal_ < kLongestUpload);
}

void Upload::ended(const Completion& completion, base::Instant now) {
    is_waiting_ = false;
    if (is_over()) return;
    if (completion.result == Result::done) return go_on();
    if (!may_try_again(completion.result, now)) return fail(completion.result, completion.detail);
    if (!first_refusal_) first_refusal_ = now;
    not_before_ = now + kUploadPause;
}

}  // namespace nplc::faces
