#include "timely_port.h"

#include <algorithm>
#include <array>

#include "shared_line/purpose.h"

namespace nplc::boards {

namespace mactalk = protocol::mactalk;

namespace {

constexpr base::Milliseconds kLongestUnread{1'000};
constexpr base::Milliseconds kBetweenLooks{250};

}  // namespace

void TimelyPort::look(base::Instant now, std::uint8_t gateway_address) {
    if (looked_ && now - *looked_ > kLongestUnread) sift(gateway_address);
    looked_ = now;
}

base::Instant TimelyPort::next_look() const {
    return looked_ ? *looked_ + kBetweenLooks : base::Instant{};
}

void TimelyPort::sift(std::uint8_t gateway_address) {
    mactalk::RequestDecoder decoder;
    std::array<ports::ReceivedByte, 256> bytes;
    std::size_t count = bytes.size();
    while (count == bytes.size()) {
        count = port_.read(bytes);
        for (const ports::ReceivedByte& byte : std::span(bytes).first(count)) {
            if (byte.framing_error) decoder.abandon();
            const auto request = byte.framing_error ? std::nullopt : decoder.receive(byte.value);
            if (!request || purpose_of(*request, gateway_address) == Purpose::operates) continue;
            const auto message = mactalk::encode(*request);
            kept_.insert(kept_.end(), message.view().begin(), message.view().end());
        }
    }
}

std::size_t TimelyPort::read(std::span<ports::ReceivedByte> out) {
    if (kept_.empty()) return port_.read(out);
    const std::size_t count = std::min(out.size(), kept_.size());
    for (ports::ReceivedByte& byte : out.first(count)) {
        byte = {kept_.front(), false};
        kept_.pop_front();
    }
    return count;
}

}  // namespace nplc::boards
