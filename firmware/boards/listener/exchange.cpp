#include "listener/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/bytes.h"
#include "registers/gateway.h"

namespace nplc::boards {

namespace mactalk = protocol::mactalk;
using hal_linux::Connections;
using registers::gateway::OperatorWay;

namespace {

/// A sample message ends after this silence: its answer has 8 or 16 bytes.
constexpr base::Microseconds kSilenceAfterSamples{20'000};
constexpr std::size_t kMostNewcomers = 64;  ///< accepted per poll
constexpr int kMostAtOnce = 64;             ///< messages answered per poll

/// All clients of one user are one operator; each client on TCP, a terminal or a serial line is an operator
/// of its own.
faces::Sitter sitter_of(const Connections::Peer& peer, const std::string& port) {
    faces::Sitter who;
    who.peer = peer.number;
    switch (peer.kind) {
        case Connections::Peer::Kind::user:
            who.way = OperatorWay::unix_socket;
            who.user = fmt::format("uid {}", peer.number);
            who.name = fmt::format("{} at {}", who.user, port);
            return who;
        case Connections::Peer::Kind::address:
            who.way = OperatorWay::tcp;
            who.name = fmt::format("{}.{}.{}.{}:{} at {}", peer.number >> 24, peer.number >> 16 & 0xFF,
                                   peer.number >> 8 & 0xFF, peer.number & 0xFF, peer.port, port);
            return who;
        case Connections::Peer::Kind::terminal:
        case Connections::Peer::Kind::serial_line:
            break;
    }
    const bool is_serial = peer.kind == Connections::Peer::Kind::serial_line;
    who.way = is_serial ? OperatorWay::serial_line : OperatorWay::terminal;
    who.name = "client of " + port;
    return who;
}

}  // namespace

/// Reads a new client's first message before the next one is accepted, which may take its place.
void Exchange::look(base::Instant now) {
    for (std::size_t i = 0; i < kMostNewcomers; ++i) {
        auto newcomer = connections_.accept();
        if (!newcomer && connections_.lacks_room()) {
            listener_.make_room(now);
            close_dropped();
            newcomer = connections_.accept();
        }
        if (!newcomer) break;
        listener_.connected(*newcomer, sitter_of(connections_.peer(*newcomer), connections_.name()), now);
        hear(*newcomer, now);
        close_dropped();
    }
    for (const Connections::Id client : connections_.with_news()) hear(client, now);
    listener_.looked(now);
}

void Exchange::hear(Connections::Id client, base::Instant now) {
    std::array<std::uint8_t, 4096> bytes;
    const std::size_t wanted = std::min(bytes.size(), listener_.readable(client, now));
    connections_.listen_to(client, wanted != 0);
    if (wanted == 0) return;
    Connections::Got got;
    std::size_t count = 0;
    do {
        got = connections_.read(client, std::span(bytes).first(wanted - count));
        count += got.count + (got.is_damaged ? 1U : 0U);
        listener_.received(client, std::span(bytes).first(got.count), !got.is_damaged && count < wanted, now);
        if (got.is_damaged) listener_.damaged(client);
    } while (got.is_damaged && count < wanted);
    if (got.state == Connections::State::hears) listener_.left(client);
    if (got.state == Connections::State::gone) listener_.gone(client, now);
}

void Exchange::bring(gateway::Controller& controller, base::Instant now, base::Instant controllers_now) {
    look(now);
    gateway::UserPort& port = controller.user_port();
    for (int i = 0; i < kMostAtOnce; ++i) {
        const Frame* const frame = listener_.next(clock_ == nullptr ? now : clock_->now());
        if (frame == nullptr) return;
        expect(frame->message);
        port.submit(frame->message, frame->data, controllers_now);
        if (port.is_serving()) return;
        collect(controller, now, controllers_now);
    }
}

void Exchange::expect(const mactalk::Request& message) {
    expected_ = mactalk::answer_to(message.kind);
    const bool is_block = message.kind == mactalk::Kind::read_block;
    const std::size_t bytes = is_block ? mactalk::kBlockBytes : mactalk::kReadBytes;
    reply_.expect(expected_, expected_ == mactalk::Answer::registers ? bytes : 0);
    is_whole_ = expected_ == mactalk::Answer::none;
    last_sample_.reset();
}

void Exchange::take_back(gateway::Controller& controller, base::Instant now, base::Instant controllers_now) {
    controller.user_port().serve(controllers_now);
    if (listener_.awaits_answer()) collect(controller, now, controllers_now);
    send_unsent(now);
}

void Exchange::collect(gateway::Controller& controller, base::Instant now, base::Instant controllers_now) {
    gateway::UserPort& port = controller.user_port();
    const auto bytes = port.take_reply();
    listener_.answer(bytes, now);
    if (!bytes.empty() && expected_ == mactalk::Answer::samples) last_sample_ = now;
    for (const std::uint8_t byte : bytes) {
        if (expected_ != mactalk::Answer::samples && reply_.receive(byte)) is_whole_ = true;
    }
    if (!has_ended(port, now)) return;
    std::array<std::uint8_t, 4> result{};
    controller.registers().read(registers::gateway::RESULT, result, controllers_now);
    listener_.ended(base::load_u32(result.data()));
}

bool Exchange::has_ended(const gateway::UserPort& port, base::Instant now) {
    return is_whole_ || !port.is_serving() || (last_sample_ && now - *last_sample_ >= kSilenceAfterSamples);
}

void Exchange::send_unsent(base::Instant now) {
    for (const Listener::Id client : listener_.with_unsent()) {
        const auto taken = connections_.write(client, listener_.unsent(client));
        if (taken)
            listener_.sent(client, *taken, now);
        else
            listener_.gone(client, now);
        connections_.wait_to_write(client, !listener_.unsent(client).empty());
    }
    close_dropped();
}

void Exchange::close_dropped() {
    for (const Listener::Id dropped : listener_.take_dropped()) connections_.close(dropped);
}

base::Instant Exchange::next(base::Instant now) const {
    base::Instant next = listener_.next_look(now);
    if (last_sample_ && listener_.awaits_answer())
        next = std::min(next, *last_sample_ + kSilenceAfterSamples);
    return next;
}

}  // namespace nplc::boards
