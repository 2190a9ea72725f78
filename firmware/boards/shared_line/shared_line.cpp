#include "shared_line/shared_line.h"

#include <algorithm>
#include <array>
#include <utility>

namespace nplc::boards {

namespace mactalk = protocol::mactalk;

namespace {

using Time = SharedLine::Time;

/// Samples are 8 or 16 bytes: over once nothing more comes.
constexpr Time kSilenceAfterSamples = std::chrono::milliseconds{20};
/// At 19200 baud, the user's port's own speed.
constexpr Time kCharacter = std::chrono::microseconds{521};
constexpr std::size_t kMostWaiting = 16;  ///< of one client
constexpr int kReadsPerLook = 16;

bool is_for_somebody(std::uint8_t address, const SharedLine::Addresses& addresses) {
    return address == addresses.gateway || address == addresses.motor || address == mactalk::kEveryone;
}

}  // namespace

SharedLine::SharedLine(hal_linux::ByteServer& server)
    : server_(server), seats_(server.seats()), last_(seats_.size() - 1) {}

void SharedLine::welcome(Seat& seat, std::size_t number, std::uint64_t visit) {
    seat = Seat{};
    seat.visit = visit;
    if (asking_ != number) return;
    asker_is_gone_ = true;
    until_ = std::min(until_, sent_ + kBriefly);
}

void SharedLine::listen(std::size_t number, std::uint8_t gateway_address) {
    std::array<std::uint8_t, 4096> bytes;
    Seat& seat = seats_[number];
    if (const auto visit = server_.visit(number); visit != seat.visit) welcome(seat, number, visit);
    seat.decoder.take_long_writes(gateway_address);
    std::size_t count = bytes.size();
    for (int i = 0; i < kReadsPerLook && count == bytes.size(); ++i) {
        count = server_.read_seat(number, bytes);
        for (const std::uint8_t byte : std::span(bytes).first(count)) take_byte(seat, byte);
    }
}

void SharedLine::take_byte(Seat& seat, std::uint8_t byte) {
    mactalk::RequestDecoder& decoder = seat.decoder;
    const auto request = decoder.receive(byte);
    if (!request || seat.frames.size() == kMostWaiting) return;
    Frame frame{request->kind, request->address, {}};
    const bool is_long = request->kind == mactalk::Kind::write && request->length > 4;
    const auto take = [&frame](auto&& encoded) {
        frame.bytes.assign(encoded.view().begin(), encoded.view().end());
    };
    if (is_long) {
        take(mactalk::encode_long_write(request->address, request->reg, decoder.data()));
    } else {
        take(mactalk::encode(*request));
    }
    seat.frames.push_back(std::move(frame));
}

/// While an answer is to come only the same client may go on, and only once.
std::optional<std::size_t> SharedLine::next_seat() const {
    if (asking_) {
        const bool goes_on = !asked_again_ && !asker_is_gone_ && !seats_[*asking_].frames.empty();
        return goes_on ? asking_ : std::nullopt;
    }
    for (std::size_t i = 1; i <= seats_.size(); ++i) {
        const std::size_t number = (last_ + i) % seats_.size();
        if (!seats_[number].frames.empty()) return number;
    }
    return std::nullopt;
}

std::vector<std::uint8_t> SharedLine::to_line(Time now, const Addresses& addresses) {
    for (std::size_t number = 0; number < seats_.size(); ++number) listen(number, addresses.gateway);
    if (asking_ && now >= until_) end_turn(samples_);
    const auto next = next_seat();
    if (!next) return {};
    const Frame frame = std::move(seats_[*next].frames.front());
    seats_[*next].frames.pop_front();
    expect(*next, frame, now, addresses);
    return frame.bytes;
}

std::optional<Time> SharedLine::next_turn(Time now) const {
    if (next_seat()) return now;
    if (asking_) return until_;
    return std::nullopt;
}

void SharedLine::expect(std::size_t number, const Frame& frame, Time now, const Addresses& addresses) {
    const mactalk::Answer answer = mactalk::answer_to(frame.kind);
    const bool again = asking_.has_value();
    if (again) end_turn(false);
    last_ = number;
    asker_is_gone_ = false;
    if (answer == mactalk::Answer::none || !is_for_somebody(frame.address, addresses)) return;
    asking_ = number;
    asked_again_ = again;
    sent_ = now + kCharacter * static_cast<int>(frame.bytes.size());
    until_ = seats_[number].unanswered ? sent_ + kBriefly : now + kLongestAnswer;
    samples_ = answer == mactalk::Answer::samples;
    const bool is_block = frame.kind == mactalk::Kind::read_block;
    const std::size_t bytes = is_block ? mactalk::kBlockBytes : mactalk::kReadBytes;
    answer_.expect(answer, answer == mactalk::Answer::registers ? bytes : 0);
}

void SharedLine::end_turn(bool answered) {
    if (!asker_is_gone_) seats_[*asking_].unanswered = !answered;
    asking_.reset();
    asker_is_gone_ = false;
}

/// An answer that nobody waits for any more may have been for someone who left.
void SharedLine::from_line(std::span<const std::uint8_t> bytes, Time now) {
    if (bytes.empty()) return;
    if (!asker_is_gone_) server_.write_seat(asking_.value_or(last_), bytes);
    if (!asking_) return;
    if (samples_) until_ = now + kSilenceAfterSamples;
    for (const std::uint8_t byte : bytes) {
        if (!samples_ && asking_ && answer_.receive(byte)) end_turn(true);
    }
}

}  // namespace nplc::boards
