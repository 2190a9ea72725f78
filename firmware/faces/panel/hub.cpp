#include "hub.h"

#include <fmt/format.h>

#include <algorithm>

namespace nplc::panel {
namespace {

constexpr int kProtocol = 1;
constexpr base::Milliseconds kBetweenSlow{100};
constexpr base::Milliseconds kBeat{400};
/// An axis whose loop hangs at the start must not block the others.
constexpr base::Milliseconds kLongestGreeting{1'000};

}  // namespace

bool Session::may_send(base::Instant now) {
    const double seconds =
        credited_ == base::Instant{} ? 0 : static_cast<double>((now - credited_).count()) / 1'000'000;
    credited_ = now;
    credit_ = std::min<double>(kMessages, credit_ + seconds * kMessages);
    if (credit_ < 1) return false;
    credit_ -= 1;
    return true;
}

Hub::Hub(const PanelOptions& options, const std::vector<PanelAxis>& axes, SymbolShelf* symbols,
         Simulation* simulation, ports::Clock& clock)
    : options_(options), symbols_(symbols), simulation_(simulation), clock_(clock), bell_([this] {
          if (server_ != nullptr) server_->ring();
      }) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
        feeds_.emplace_back(axes[i], i, symbols);
        axes[i].model->watch(bell_);
    }
}

void Hub::serve(WebServer& server) {
    server_ = &server;
}

void Hub::opened(ClientId client, const std::string& peer) {
    if (sessions_.empty()) looked_ = clock_.now();  // nothing ticks without clients
    Session& session = sessions_.emplace(client, Session(peer, feeds_.size())).first->second;
    session.opened = clock_.now();
    session.rights.read = options_.password.empty();
    for (AxisFeed& feed : feeds_) feed.model().want(session.opened);
    if (!session.rights.read) greet(client, session);
    tick();
}

/// The holder of a seat keeps its connection.
bool Hub::may_go(ClientId client) {
    const auto found = sessions_.find(client);
    if (found == sessions_.end()) return true;
    for (std::size_t i = 0; i < feeds_.size(); ++i) {
        const auto& desk = found->second.parts[i].desk;
        if (desk && feeds_[i].image().holder == desk->number()) return false;
    }
    return true;
}

void Hub::tick() {
    if (sessions_.empty()) return;
    bell_.arm();
    const base::Instant now = clock_.now();
    watch_time(now);
    for (AxisFeed& feed : feeds_) feed.look(now);
    // Sending may end a session.
    std::vector<ClientId> clients;
    for (const auto& [client, session] : sessions_) clients.push_back(client);
    for (const ClientId client : clients) {
        for (std::size_t i = 0; i < feeds_.size(); ++i) {
            if (const auto found = sessions_.find(client); found != sessions_.end())
                serve_desk(client, found->second, i, now);
        }
        if (const auto found = sessions_.find(client); found != sessions_.end())
            tell(client, found->second, now);
    }
}

/// After a gap the messages of all clients are read within the next ticks, in any order.
void Hub::watch_time(base::Instant now) {
    constexpr base::Milliseconds kTick{WebServer::kTickMilliseconds};
    constexpr base::Milliseconds kHalted{500};
    if (now - looked_ > kTick + kHalted) halted_until_ = now + 2 * kTick;
    looked_ = now;
}

void Hub::send(ClientId client, Session& session, std::string text) {
    session.last_told = clock_.now();
    server_->send(client, std::move(text));
}

std::string Hub::hello(ClientId client, const Session& session) const {
    Json axes = Json::array();
    if (session.rights.read) {
        for (const AxisFeed& feed : feeds_) axes.push_back(Json::parse(feed.info_text()));
    }
    Json stops = Json::array();  // a stop names its axis and needs no login
    for (const AxisFeed& feed : feeds_) stops.push_back(feed.name());
    return Json{
        {"t", "hello"},
        {"protocol", kProtocol},
        {"program", options_.program},
        {"client", client},
        {"simulator", simulation_ != nullptr},
        {"rights", {{"read", session.rights.read}, {"operate", session.rights.operate}}},
        {"limits",
         {{"message_bytes", options_.web.limits.message_bytes}, {"messages_per_second", Session::kMessages}}},
        {"axes", std::move(axes)},
        {"stops", std::move(stops)}}
        .dump();
}

void Hub::greet(ClientId client, Session& session) {
    session.is_greeted = session.rights.read;
    send(client, session, hello(client, session));
}

/// A client that has not read its data gets the next update later, with the state at that time.
void Hub::tell(ClientId client, Session& session, base::Instant now) {
    if (!session.rights.read || server_->waiting(client) != 0) return;
    if (!session.is_greeted) {
        const bool all = std::all_of(feeds_.begin(), feeds_.end(), [&](const AxisFeed& feed) {
            return feed.image().number != 0 && feed.age(now) < kLongestGreeting.count();
        });
        if (!all && now - session.opened < kLongestGreeting) return;
        greet(client, session);
    }
    for (std::size_t i = 0; i < feeds_.size(); ++i) tell_axis(client, session, i, now);
    if (simulation_ != nullptr) tell_simulation(client, session, now);
    if (now - session.last_told >= kBeat) tell_ages(client, session, now);
}

void Hub::tell_axis(ClientId client, Session& session, std::size_t index, base::Instant now) {
    AxisFeed& feed = feeds_[index];
    AxisPart& part = session.parts[index];
    if (feed.image().number == 0) return;
    if (part.program != feed.program_number()) {
        part.program = feed.program_number();
        send(client, session, feed.program_text());
    }
    if (part.set_points_told != feed.set_points_number()) {
        part.set_points_told = feed.set_points_number();
        send(client, session, feed.set_points().text(feed.name()));
    }
    if (part.why != feed.why_number()) {
        part.why = feed.why_number();
        send(client, session, feed.why_text());
    }
    tell_seat(client, part, feed);
    if (part.event != feed.last_event()) {
        send(client, session, feed.events_text(part.event));
        part.event = feed.last_event();
    }
    const bool slow_too = now - part.told_slow >= kBetweenSlow;
    if (part.image && part.image->number == feed.image().number) return;
    std::string text = feed.image_text(part.image.get(), slow_too, now);
    if (text.empty()) return;
    send(client, session, std::move(text));
    part.told_slow = now;
    if (!part.image) part.image = std::make_unique<faces::AxisImage>();
    *part.image = feed.image();
}

void Hub::tell_seat(ClientId client, AxisPart& part, AxisFeed& feed) {
    const faces::AxisImage& image = feed.image();
    const bool is_mine = part.desk && image.holder != 0 && image.holder == part.desk->number();
    const Json message = {{"t", "seat"},
                          {"axis", feed.model().name()},
                          {"holder", image.holder == 0 ? "" : std::string(image.holder_name.data())},
                          {"mine", is_mine}};
    std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text == part.seat) return;
    part.seat = text;
    server_->send(client, std::move(text));
}

void Hub::tell_simulation(ClientId client, Session& session, base::Instant now) {
    const Simulation::State state = simulation_->state();
    const std::string rest =
        fmt::format("\"paused\":{},\"speed\":{},\"recorded\":{},\"cut\":{},\"blocked\":{}", state.is_paused,
                    state.speed, state.recorded, state.is_cut, state.is_blocked);
    if (rest == session.simulation && now - session.told_time < kBeat) return;
    session.simulation = rest;
    session.told_time = now;
    send(client, session, fmt::format("{{\"t\":\"sim\",\"ms\":{},{}}}", state.milliseconds, rest));
}

void Hub::tell_ages(ClientId client, Session& session, base::Instant now) {
    Json ages = Json::object();
    for (AxisFeed& feed : feeds_) ages[feed.model().name()] = feed.age(now);
    send(client, session, Json{{"t", "beat"}, {"ages", std::move(ages)}}.dump());
}

}  // namespace nplc::panel
