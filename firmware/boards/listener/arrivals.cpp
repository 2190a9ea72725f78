// Clients of a listener: connecting, removal to make room, and received messages.
#include <algorithm>
#include <tuple>
#include <utility>

#include "listener/listener.h"
#include "listener/results.h"
#include "registers/gateway.h"
#include "seat/secret.h"

namespace nplc::boards {

namespace gw = registers::gateway;
namespace mactalk = protocol::mactalk;

namespace {

constexpr std::size_t kMostWaiting = 16;        ///< pending messages of one client
constexpr std::size_t kMostBeforeFirst = 1024;  ///< bytes before the first valid message
constexpr base::Microseconds kLongestUnsent{1'000'000};

}  // namespace

void Listener::connected(Id client, faces::Sitter who, base::Instant now) {
    if (clients_.size() >= options_.places) make_room(now);
    Client& newcomer = clients_[client];
    newcomer.id = client;
    newcomer.sitter = std::move(who);
    newcomer.sitter.number = faces::Seat::new_number();
    newcomer.came = now;
}

void Listener::make_room(base::Instant now) {
    const auto key = [&](const Clients::value_type& entry) {
        return std::tuple(rank(entry.second, now), entry.second.heard, entry.first);
    };
    const auto first = std::min_element(clients_.begin(), clients_.end(),
                                        [&](const auto& a, const auto& b) { return key(a) < key(b); });
    if (first != clients_.end()) drop(first);
}

/// The client with the lowest rank is removed first.
int Listener::rank(const Client& client, base::Instant now) const {
    if (waits_for_stop(client.id)) return 4;
    const bool is_deaf = client.unsent_since && now - *client.unsent_since >= kLongestUnsent;
    if (client.allowance.floods(now) || is_deaf) return 0;
    const bool is_new = now - client.came < kFirstMessage && client.before_first < kMostBeforeFirst;
    if (client.heard == 0) return is_new ? 3 : 1;
    return 2;
}

bool Listener::waits_for_stop(Id client) const {
    const auto asks = [client](const Asked& stop) {
        return std::find(stop.askers.begin(), stop.askers.end(), client) != stop.askers.end();
    };
    return std::any_of(stops_.begin(), stops_.end(), asks) ||
           (asked_ && asked_->frame.purpose == Purpose::stops && asks(*asked_));
}

std::size_t Listener::readable(Id client, base::Instant now) const {
    const auto found = clients_.find(client);
    return found == clients_.end() ? 0 : found->second.allowance.left(now);
}

void Listener::received(Id client, std::span<const std::uint8_t> bytes, bool is_all, base::Instant now) {
    const auto found = clients_.find(client);
    if (found == clients_.end()) return;
    Client& who = found->second;
    if (!who.has_more) who.drained = looked_.value_or(now);
    who.has_more = !is_all;
    who.decoder.take_long_writes(addresses_.gateway);
    if (who.heard == 0) who.before_first += bytes.size();
    for (const std::uint8_t byte : bytes) take_byte(who, byte, now);
    if (!bytes.empty()) who.allowance.take(bytes.size(), now);
}

void Listener::damaged(Id client) {
    if (const auto found = clients_.find(client); found != clients_.end()) found->second.decoder.abandon();
}

void Listener::take_byte(Client& client, std::uint8_t byte, base::Instant now) {
    const auto message = client.decoder.receive(byte);
    if (!message) return;
    client.heard = ++messages_;
    if (!options_.password.empty() && is_about_password(client, *message, now)) return;
    Frame frame{
        *message, purpose_of(*message, addresses_), needs_seat(*message, addresses_), client.drained, {}};
    if (message->kind == mactalk::Kind::write) {
        const auto data = client.decoder.data();
        frame.data.assign(data.begin(), data.end());
    }
    take_frame(client, std::move(frame), now);
}

void Listener::take_frame(Client& client, Frame frame, base::Instant now) {
    std::erase_if(client.frames, [](const Frame& waiting) { return waiting.purpose == Purpose::reads; });
    if (frame.purpose == Purpose::stops) {
        client.stopped = now;
        return take_stop(client, std::move(frame));
    }
    if (client.frames.size() < kMostWaiting) client.frames.push_back(std::move(frame));
}

/// Drops the client's earlier messages. Clients that request the same stop share it.
void Listener::take_stop(Client& client, Frame frame) {
    client.frames.clear();
    client.result.reset();
    const auto same = std::find_if(stops_.begin(), stops_.end(), [&](const Asked& stop) {
        return stop.frame.message.address == frame.message.address &&
               stop.frame.message.reg == frame.message.reg && stop.frame.message.value == frame.message.value;
    });
    if (same == stops_.end()) {
        stops_.push_back({std::move(frame), {client.id}});
        return;
    }
    std::vector<Id>& askers = same->askers;
    std::erase_if(askers, [this](Id asker) { return !clients_.contains(asker); });
    if (std::find(askers.begin(), askers.end(), client.id) == askers.end()) askers.push_back(client.id);
}

/// True: the message is about the password and has been answered or refused.
bool Listener::is_about_password(Client& client, const mactalk::Request& message, base::Instant now) {
    using enum gw::PasswordState;
    if (message.address != addresses_.gateway) return false;
    if (message.kind == mactalk::Kind::read && message.reg == gw::PASSWORD_STATE) {
        const std::uint8_t state[4]{static_cast<std::uint8_t>(client.has_password ? given : wanted)};
        queue(client.id, mactalk::encode_registers(gw::PASSWORD_STATE, state).view(), now);
        return true;
    }
    if (message.kind != mactalk::Kind::write || message.reg != gw::PASSWORD) return false;
    take_password(client, now);
    return true;
}

void Listener::take_password(Client& client, base::Instant now) {
    const auto given = client.decoder.data();
    std::string text(given.begin(), given.end());
    text.erase(std::min(text.find_last_not_of('\0') + 1, text.size()));
    client.has_password = faces::same_secret(text, options_.password);
    client.result.reset();
    if (client.has_password) return queue(client.id, mactalk::encode_accept().view(), now);
    client.result = result_word(gw::Result::no_password, gw::PASSWORD);
    ++wrong_passwords_;
}

}  // namespace nplc::boards
