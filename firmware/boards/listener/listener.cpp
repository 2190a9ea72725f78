#include "listener/listener.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/bytes.h"
#include "listener/results.h"
#include "registers/gateway.h"

namespace nplc::boards {

namespace gw = registers::gateway;
namespace mactalk = protocol::mactalk;

namespace {

constexpr base::Microseconds kBriefly{150'000};
constexpr base::Microseconds kStopFollowed{2'000'000};

/// A hold may remain without effect: stop and safe take precedence over it.
bool is_hold(const Frame& frame) {
    return frame.message.reg == gw::COMMAND &&
           frame.message.value == static_cast<std::uint32_t>(gw::Command::hold);
}

bool can_ask(const Client& client) {
    return !client.frames.empty() && client.unsent.size() < Client::kMuchUnsent;
}

}  // namespace

Listener::Listener(Options options) : options_(std::move(options)) {}

Listener::~Listener() {
    while (!clients_.empty()) forget(clients_.begin());
}

/// The answer for a disconnected client is not waited for long.
void Listener::gone(Id client, base::Instant now) {
    const auto found = clients_.find(client);
    if (found == clients_.end()) return;
    if (asked_ && asked_->askers.size() == 1 && asked_->askers.front() == client)
        asked_->until = std::min(asked_->until, now + kBriefly);
    forget(found);
}

void Listener::forget(Clients::iterator client) {
    if (options_.operators != nullptr) options_.operators->leave(client->second.sitter.number);
    clients_.erase(client);
}

void Listener::drop(Clients::iterator client) {
    dropped_.push_back(client->first);
    forget(client);
}

void Listener::left(Id client) {
    const auto found = clients_.find(client);
    if (found == clients_.end()) return;
    found->second.has_left = true;
    if (options_.operators != nullptr) options_.operators->leave(found->second.sitter.number);
}

void Listener::looked(base::Instant now) {
    looked_ = now;
    for (auto it = clients_.begin(); it != clients_.end();) {
        const auto client = it++;
        if (is_done_with(client->second)) drop(client);
    }
}

bool Listener::is_done_with(const Client& client) const {
    if (!client.has_left || client.has_more || !client.frames.empty() || !client.unsent.empty() ||
        waits_for_stop(client.id))
        return false;
    return !asked_ ||
           std::find(asked_->askers.begin(), asked_->askers.end(), client.id) == asked_->askers.end();
}

base::Instant Listener::next_look(base::Instant now) const {
    if (!looked_ || (!asked_ && !stops_.empty())) return now;
    base::Instant next = *looked_ + kBetweenLooks;
    for (const auto& [id, client] : clients_) {
        if (!asked_ && can_ask(client)) return now;
        if (asked_ && !client.frames.empty()) next = std::min(next, asked_->until);
        if (client.has_more) next = std::min(next, *looked_ + kAllowed);
    }
    return next;
}

std::span<const std::uint8_t> Listener::unsent(Id client) const {
    const auto found = clients_.find(client);
    return found == clients_.end() ? std::span<const std::uint8_t>() : std::span(found->second.unsent);
}

void Listener::sent(Id client, std::size_t bytes, base::Instant now) {
    const auto found = clients_.find(client);
    if (found == clients_.end()) return;
    std::vector<std::uint8_t>& unsent = found->second.unsent;
    unsent.erase(unsent.begin(), unsent.begin() + static_cast<std::ptrdiff_t>(bytes));
    if (unsent.empty())
        found->second.unsent_since.reset();
    else if (bytes != 0)
        found->second.unsent_since = now;
}

std::vector<Listener::Id> Listener::with_unsent() const {
    std::vector<Id> all;
    for (const auto& [id, client] : clients_) {
        if (!client.unsent.empty()) all.push_back(id);
    }
    return all;
}

void Listener::queue(Id client, std::span<const std::uint8_t> bytes, base::Instant now) {
    const auto found = clients_.find(client);
    if (found == clients_.end() || bytes.empty()) return;
    Client& who = found->second;
    if (who.unsent.size() + bytes.size() > Client::kMostUnsent) return;
    who.unsent.insert(who.unsent.end(), bytes.begin(), bytes.end());
    if (!who.unsent_since) who.unsent_since = now;
}

/// While an answer is pending only the same client may continue, and only once; others wait until the
/// timeout. A client that has sent a stop comes first, to ask for its outcome.
Client* Listener::next_client(base::Instant now) {
    if (asked_ && now < asked_->until) {
        const auto asker = clients_.find(asked_->askers.front());
        const bool goes_on = !asked_->again && asked_->frame.purpose != Purpose::stops &&
                             asker != clients_.end() && can_ask(asker->second);
        return goes_on ? &asker->second : nullptr;
    }
    Client* first = nullptr;
    auto it = clients_.upper_bound(last_);
    for (std::size_t i = 0; i < clients_.size(); ++i, ++it) {
        if (it == clients_.end()) it = clients_.begin();
        if (!can_ask(it->second)) continue;
        if (it->second.stopped && now - *it->second.stopped < kStopFollowed) return &it->second;
        if (first == nullptr) first = &it->second;
    }
    return first;
}

const Frame* Listener::next(base::Instant now) {
    if (!stops_.empty() && (!asked_ || asked_->frame.purpose != Purpose::stops || now >= asked_->until)) {
        const Frame* stop = begin_stop();
        asked_->until = now + kLongestAnswer;
        return stop;
    }
    while (Client* const client = next_client(now)) {
        Frame frame = std::move(client->frames.front());
        client->frames.pop_front();
        const bool again = asked_ && !asked_->askers.empty() && asked_->askers.front() == client->id;
        last_ = client->id;
        if (is_dealt_with(*client, frame, now)) continue;
        asked_ = Asked{std::move(frame), {client->id}, again, now + kLongestAnswer};
        return &asked_->frame;
    }
    return nullptr;
}

const Frame* Listener::begin_stop() {
    auto first =
        std::find_if(stops_.begin(), stops_.end(), [](const Asked& stop) { return !is_hold(stop.frame); });
    if (first == stops_.end()) first = stops_.begin();
    Asked stop = std::move(*first);
    stops_.erase(first);
    const bool is_kept = asked_ && is_for_set_points(asked_->frame.message, addresses_.gateway);
    if (asked_ && !is_kept) {
        if (const auto asker = clients_.find(asked_->askers.front()); asker != clients_.end())
            take_too_late(asker->second, asked_->frame);
    }
    for (auto& [id, client] : clients_) {
        const bool asks = std::find(stop.askers.begin(), stop.askers.end(), id) != stop.askers.end();
        if (asks) continue;
        std::erase_if(client.frames,
                      [&, &who = client](const Frame& frame) { return take_too_late(who, frame); });
    }
    asked_ = std::move(stop);
    return &asked_->frame;
}

/// False: the message is not affected by a stop or delay.
bool Listener::take_too_late(Client& client, const Frame& frame) {
    if (frame.purpose != Purpose::operates) return false;
    client.result = result_word(gw::Result::too_late, frame.message.reg);
    return true;
}

void Listener::answer(std::span<const std::uint8_t> bytes, base::Instant now) {
    if (!asked_) return;
    for (const Id asker : asked_->askers) queue(asker, bytes, now);
}

void Listener::ended(std::uint32_t result) {
    if (!asked_) return;
    const mactalk::Request& message = asked_->frame.message;
    const bool is_own = message.kind == mactalk::Kind::write && message.address == addresses_.gateway;
    for (const Id asker : asked_->askers) {
        if (const auto client = clients_.find(asker); is_own && client != clients_.end())
            client->second.result = result;
    }
    asked_.reset();
}

void Listener::restarted() {
    asked_.reset();
    for (auto& [id, client] : clients_) client.result.reset();
}

/// RESULT of a message that is refused whoever is the operator; empty: not refused.
std::optional<std::uint32_t> Listener::refusal_for_anybody(const Client& client, const Frame& frame,
                                                           base::Instant now) const {
    const std::uint8_t reg = frame.message.reg;
    if (frame.needs_seat && !options_.password.empty() && !client.has_password)
        return result_word(gw::Result::no_password, reg);
    const bool has_left = client.has_left || (is_there_ && !is_there_(client.id));
    if (now - frame.since > kLongestUnread || has_left) return result_word(gw::Result::too_late, reg);
    return std::nullopt;
}

std::optional<std::uint32_t> Listener::refusal(const Client& client, const Frame& frame, base::Instant now) {
    if (const auto refused = refusal_for_anybody(client, frame, now)) return refused;
    if (!frame.needs_seat || options_.operators == nullptr) return std::nullopt;
    const auto verdict = options_.operators->take(client.sitter, now);
    if (verdict == faces::Seat::Verdict::granted) return std::nullopt;
    return result_word(gw::Result::seat_taken, frame.message.reg, faces::detail_of(verdict));
}

/// True: the message was answered or refused here and is not for the gateway.
bool Listener::is_dealt_with(Client& client, const Frame& frame, base::Instant now) {
    const mactalk::Request& message = frame.message;
    if (is_about_operating(client, frame, now)) return true;
    if (frame.purpose == Purpose::operates) {
        client.result = refusal(client, frame, now);
        if (client.result) return true;
    } else if (client.result && message.kind == mactalk::Kind::read && message.reg == gw::RESULT &&
               message.address == addresses_.gateway) {
        tell(client, gw::RESULT, *client.result, now);
        return true;
    }
    return !is_for_somebody(message.address);
}

void Listener::tell(Client& client, std::uint8_t reg, std::uint32_t value, base::Instant now) {
    std::array<std::uint8_t, mactalk::kReadBytes> bytes{};
    base::store_u32(bytes.data(), value);
    queue(client.id, mactalk::encode_registers(reg, bytes).view(), now);
}

bool Listener::is_for_somebody(std::uint8_t address) const {
    return address == addresses_.gateway || address == addresses_.motor || address == mactalk::kEveryone;
}

}  // namespace nplc::boards
