#include "shared_line.h"

#include <algorithm>
#include <array>

namespace nplc::sim {

namespace mactalk = protocol::mactalk;

namespace {

/// Samples are 8 or 16 bytes: over once nothing more comes.
constexpr Time kSilenceAfterSamples = std::chrono::milliseconds{20};
constexpr std::size_t kMostWaiting = 64;

}  // namespace

SharedLine::SharedLine(hal_linux::ByteServer& server) : server_(server), decoders_(server.seats()) {}

void SharedLine::listen(std::size_t seat, std::uint8_t gateway_address) {
    std::array<std::uint8_t, 4096> bytes;
    mactalk::RequestDecoder& decoder = decoders_[seat];
    decoder.take_long_writes(gateway_address);
    const std::size_t count = server_.read_seat(seat, bytes);
    for (const std::uint8_t byte : std::span(bytes).first(count)) {
        const auto request = decoder.receive(byte);
        if (!request || frames_.size() == kMostWaiting) continue;
        Frame frame{seat, request->kind, {}};
        const bool is_long = request->kind == mactalk::Kind::write && request->length > 4;
        const auto take = [&frame](auto&& encoded) {
            frame.bytes.assign(encoded.view().begin(), encoded.view().end());
        };
        if (is_long) {
            take(mactalk::encode_long_write(request->address, request->reg, decoder.data()));
        } else {
            take(mactalk::encode(*request));
        }
        frames_.push_back(std::move(frame));
    }
}

/// While an answer is to come only the same client may go on.
std::deque<SharedLine::Frame>::iterator SharedLine::next_frame() {
    if (!asking_) return frames_.begin();
    return std::find_if(frames_.begin(), frames_.end(),
                        [this](const Frame& frame) { return frame.seat == *asking_; });
}

std::vector<std::uint8_t> SharedLine::to_line(Time now, std::uint8_t gateway_address) {
    for (std::size_t seat = 0; seat < decoders_.size(); ++seat) listen(seat, gateway_address);
    if (asking_ && now >= until_) asking_.reset();
    const auto next = next_frame();
    if (next == frames_.end()) return {};
    const Frame frame = std::move(*next);
    frames_.erase(next);
    expect(frame, now);
    return frame.bytes;
}

void SharedLine::expect(const Frame& frame, Time now) {
    const mactalk::Answer answer = mactalk::answer_to(frame.kind);
    last_ = frame.seat;
    asking_.reset();
    if (answer == mactalk::Answer::none) return;
    asking_ = frame.seat;
    until_ = now + kLongestAnswer;
    samples_ = answer == mactalk::Answer::samples;
    const bool is_block = frame.kind == mactalk::Kind::read_block;
    const std::size_t bytes = is_block ? mactalk::kBlockBytes : mactalk::kReadBytes;
    answer_.expect(answer, answer == mactalk::Answer::registers ? bytes : 0);
}

void SharedLine::from_line(std::span<const std::uint8_t> bytes, Time now) {
    if (bytes.empty()) return;
    server_.write_seat(asking_.value_or(last_), bytes);
    if (!asking_) return;
    if (samples_) until_ = now + kSilenceAfterSamples;
    for (const std::uint8_t byte : bytes) {
        if (!samples_ && answer_.receive(byte)) asking_.reset();
    }
}

}  // namespace nplc::sim
