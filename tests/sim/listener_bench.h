#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "listener/listener.h"

namespace nplc::boards {

namespace mactalk = protocol::mactalk;
using mactalk::Kind;
using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kGateway = 128;
constexpr std::uint8_t kMotor = 1;

template <class Encoded>
Bytes bytes(const Encoded& encoded) {
    return {encoded.view().begin(), encoded.view().end()};
}

inline Bytes read_of(std::uint8_t reg) {
    return bytes(mactalk::encode({.kind = Kind::read, .address = kGateway, .reg = reg}));
}
inline Bytes write_of(std::uint8_t reg) {
    return bytes(
        mactalk::encode({.kind = Kind::write, .address = kGateway, .reg = reg, .length = 4, .value = 1}));
}
inline Bytes reply_of(std::uint8_t reg, std::array<std::uint8_t, 4> data = {}) {
    return bytes(mactalk::encode_registers(reg, data));
}
/// COMMAND is 48; run 1, stop 2, safe 3, hold 6 (firmware/gateway/REGISTERS.md).
inline Bytes order(std::uint32_t command) {
    return bytes(mactalk::encode(
        {.kind = Kind::write, .address = kGateway, .reg = 48, .length = 4, .value = command}));
}
constexpr std::uint32_t kRun = 1;
constexpr std::uint32_t kStop = 2;
constexpr std::uint32_t kSafe = 3;
constexpr std::uint32_t kHold = 6;
inline const Bytes kAccept = bytes(mactalk::encode_accept());
/// RESULT, 31: too_late, 19, of the register in bits 15..8.
inline Bytes too_late(std::uint8_t reg) {
    return reply_of(31, {19, reg, 0, 0});
}

inline Bytes operator+(Bytes first, const Bytes& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// As it came.
inline Bytes bytes_of(const Frame& frame) {
    if (frame.message.length > 4)
        return bytes(mactalk::encode_long_write(frame.message.address, frame.message.reg, frame.data));
    return bytes(mactalk::encode(frame.message));
}

/// A listener with two clients.
struct ListenerTest : testing::Test {
    explicit ListenerTest(Listener::Options options = {.name = "clients"}) : listener(std::move(options)) {
        listener.set_addresses({kGateway, kMotor});
        listener.connected(client(0), {}, now);
        listener.connected(client(1), {}, now);
        listener.looked(now);
    }

    static Listener::Id client(std::size_t which) { return which < 2 ? which + 1 : which; }
    void give(Listener::Id who, const Bytes& sent) {
        listener.received(who < 2 ? client(who) : who, sent, true, now);
    }
    /// One of the two, between two looks at all.
    void send(std::size_t which, const Bytes& sent) {
        listener.received(client(which), sent, true, now);
        listener.looked(now);
    }
    /// What the gateway is handed; nothing.
    Bytes handed() {
        const Frame* const frame = listener.next(now);
        return frame == nullptr ? Bytes() : bytes_of(*frame);
    }
    void answer(const Bytes& answer, std::uint32_t result = 0) {
        listener.answer(answer, now);
        listener.ended(result);
    }
    void refuse(std::uint32_t why, std::uint32_t reg) { listener.ended(why | reg << 8); }
    Bytes heard(std::size_t which) {
        const auto unsent = listener.unsent(client(which));
        const Bytes all(unsent.begin(), unsent.end());
        listener.sent(client(which), all.size(), now);
        return all;
    }

    base::Instant now{};
    Listener listener;
};

}  // namespace nplc::boards
