#include "macreg/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/bytes.h"
#include "protocol/mactalk.h"

namespace nplc::macreg {

namespace mactalk = protocol::mactalk;

namespace {

constexpr std::size_t kHead = 3;
constexpr std::uint8_t kFirstHead = 0x50;
constexpr std::uint8_t kLastHead = 0x57;
constexpr std::uint8_t kAccept = 0x11;
constexpr std::uint8_t kEnd = 0xAA;
constexpr std::size_t kLongest = mactalk::kMaxLongRequestBytes;
constexpr std::size_t kMostNoise = 64;  // a line's worth

bool is_head(std::uint8_t byte) {
    return (byte >= kFirstHead && byte <= kLastHead) || byte == kAccept;
}

bool ends_with_head(const std::vector<std::uint8_t>& bytes) {
    const std::size_t size = bytes.size();
    return size >= kHead && is_head(bytes[size - 1]) && bytes[size - 1] == bytes[size - 2] &&
           bytes[size - 1] == bytes[size - 3];
}

/// The name of a message's protected byte number `index`.
std::string part_of(std::uint8_t head, std::size_t index) {
    constexpr std::array<const char*, 3> kParts{"address", "register", "length"};
    const bool long_head = head >= 0x50 && head <= 0x52;
    if (index < (head == 0x52 ? 3U : long_head ? 2U : 1U)) return kParts[index];
    return head == 0x52 ? fmt::format("data byte {}", index - 2) : "end";
}

}  // namespace

void FrameCutter::receive(std::uint8_t byte, base::Instant at) {
    pass(at);
    bytes_.push_back(byte);
    times_.push_back(at);
    if (state_ != State::message) {
        if (begin_at_head()) return;
        const std::size_t size = bytes_.size();
        if (state_ == State::hunting) {
            if (size >= kMostNoise && !is_head(byte)) emit(Frame::Kind::noise);
        } else if ((byte == kEnd && bytes_[size - 2] == kEnd) || (size >= kLongest && !is_head(byte))) {
            emit(Frame::Kind::broken, std::move(flaw_));
        }
        return;
    }
    if ((bytes_.size() - kHead) % 2 == 0) take_pair();
}

void FrameCutter::pass(base::Instant now) {
    if (!times_.empty() && now - times_.back() > longest_pause_) finish();
}

void FrameCutter::finish() {
    if (bytes_.empty()) return;
    const bool only_a_head =
        state_ == State::hunting && std::all_of(bytes_.begin(), bytes_.end(), [&](std::uint8_t byte) {
            return is_head(byte) && byte == bytes_.front();
        });
    if (state_ == State::message || only_a_head)
        emit(Frame::Kind::broken, cut_off());
    else
        emit(state_ == State::hunting ? Frame::Kind::noise : Frame::Kind::broken, std::move(flaw_));
}

std::vector<Frame> FrameCutter::take() {
    return std::exchange(ready_, {});
}

void FrameCutter::emit(Frame::Kind kind, std::string flaw) {
    ready_.push_back({kind, times_.front(), std::move(bytes_), std::move(flaw)});
    bytes_.clear();
    times_.clear();
    flaw_.clear();
    state_ = State::hunting;
}

/// Three equal head bytes: the message before them has ended.
bool FrameCutter::begin_at_head() {
    if (!ends_with_head(bytes_)) return false;
    const std::vector<std::uint8_t> head(bytes_.end() - kHead, bytes_.end());
    const std::vector<base::Instant> times(times_.end() - kHead, times_.end());
    bytes_.resize(bytes_.size() - kHead);
    times_.resize(times_.size() - kHead);
    if (!bytes_.empty()) {
        if (state_ == State::hunting)
            emit(Frame::Kind::noise);
        else
            emit(Frame::Kind::broken, flaw_at_ > bytes_.size() ? cut_off() : std::move(flaw_));
    }
    bytes_ = head;
    times_ = times;
    state_ = State::message;
    if (head.front() == kAccept) emit(Frame::Kind::accept);
    return true;
}

void FrameCutter::take_pair() {
    const std::size_t size = bytes_.size();
    const std::uint8_t first = bytes_[size - 2];
    const std::uint8_t second = bytes_[size - 1];
    if (second == base::inverse(first)) {
        if (size >= kLongest) fault("longer than any message");
        return;
    }
    if (first == kEnd && second == kEnd) return emit(Frame::Kind::message);
    if (size == kHead + 2 && first == bytes_.front()) return shift_head();
    const std::size_t index = (size - kHead) / 2 - 1;
    fault(fmt::format("byte {} ({}): {:02X} is followed by {:02X}, its complement is {:02X}", size - 1,
                      part_of(bytes_.front(), index), first, second, base::inverse(first)));
}

/// Four equal bytes: the first one did not belong to the message.
void FrameCutter::shift_head() {
    ready_.push_back({Frame::Kind::noise, times_.front(), {bytes_.front()}, {}});
    bytes_.erase(bytes_.begin());
    times_.erase(times_.begin());
}

void FrameCutter::fault(std::string flaw) {
    state_ = State::broken;
    flaw_ = std::move(flaw);
    flaw_at_ = bytes_.size();
}

std::string FrameCutter::cut_off() const {
    return fmt::format("cut off after {} byte{}", bytes_.size(), bytes_.size() == 1 ? "" : "s");
}

}  // namespace nplc::macreg
