// A crowd of clients that flood, with the firmware behind the listener: a stop takes effect within a second.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <functional>
#include <map>
#include <random>

#include "listener/exchange.h"
#include "listener_bench.h"
#include "sim/world.h"
#include "tables.h"

namespace nplc::boards {
namespace {

using hal_linux::Connections;

/// Sockets in virtual time: who connects waits in a queue, what is sent waits in a buffer as the kernel's.
class VirtualSockets final : public Connections {
  public:
    static constexpr std::size_t kBuffer = 16'384;

    struct Socket {
        Bytes sent{};
        Bytes heard{};
        bool reads = true;
        bool closed_there = false;  ///< by its client
        bool closes_when_read = false;
        bool closed_here = false;
    };

    Id connect() {
        waiting_.push_back(++last_);
        sockets_[last_];
        return last_;
    }
    Socket& operator[](Id id) { return sockets_.at(id); }
    void send(Id id, const Bytes& bytes) {
        Bytes& buffer = sockets_.at(id).sent;
        if (buffer.size() + bytes.size() <= kBuffer) buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    }
    void forget(Id id) { sockets_.erase(id); }
    std::function<void(Id)> when_read{};
    std::size_t taken() { return std::exchange(taken_, 0); }

    const std::string& name() const override { return name_; }
    int descriptor() const override { return -1; }
    std::optional<Id> accept() override {
        if (waiting_.empty()) return std::nullopt;
        const Id id = waiting_.front();
        waiting_.pop_front();
        accepted_.push_back(id);
        return id;
    }
    Peer peer(Id) const override { return {}; }
    std::vector<Id> with_news() override {
        std::vector<Id> news;
        for (const Id id : accepted_) {
            const Socket& socket = sockets_.at(id);
            if (!socket.sent.empty() || socket.closed_there) news.push_back(id);
        }
        return news;
    }
    Got read(Id id, std::span<std::uint8_t> out) override {
        Socket& socket = sockets_.at(id);
        const std::size_t count = std::min(out.size(), socket.sent.size());
        std::copy_n(socket.sent.begin(), count, out.begin());
        socket.sent.erase(socket.sent.begin(), socket.sent.begin() + static_cast<std::ptrdiff_t>(count));
        taken_ += count;
        if (when_read) when_read(id);
        if (!socket.closed_there) {
            socket.closed_there = socket.closes_when_read && count != 0;
            return {count, State::open};
        }
        if (count == 0) close(id);
        return {count, count == 0 ? State::gone : State::hears};
    }
    bool is_open(Id id) const override {
        const auto socket = sockets_.find(id);
        return socket != sockets_.end() && !socket->second.closed_there;
    }
    std::optional<std::size_t> write(Id id, std::span<const std::uint8_t> bytes) override {
        Socket& socket = sockets_.at(id);
        if (!socket.reads && socket.heard.size() > 4096) return 0;
        socket.heard.insert(socket.heard.end(), bytes.begin(), bytes.end());
        return bytes.size();
    }
    void listen_to(Id, bool) override {}
    void wait_to_write(Id, bool) override {}
    void close(Id id) override {
        sockets_.at(id).closed_here = true;
        std::erase(accepted_, id);
    }

  private:
    std::map<Id, Socket> sockets_;
    std::deque<Id> waiting_;
    std::vector<Id> accepted_;
    Id last_ = 0;
    std::size_t taken_ = 0;
    std::string name_ = "virtual";
};

/// What a client of the crowd does, all the time.
enum class Manner : std::uint8_t { noise, reads, refused_writes, holds, runs, deaf, comes_and_goes };
constexpr unsigned kManners = 7;

Bytes flood_of(Manner manner, std::mt19937_64& random) {
    Bytes once;
    switch (manner) {
        case Manner::noise:
            for (int i = 0; i < 500; ++i) once.push_back(static_cast<std::uint8_t>(random()));
            return once;
        case Manner::holds:
        case Manner::comes_and_goes:
            return order(kHold);
        case Manner::runs:
            once = order(kRun);
            break;
        case Manner::refused_writes:
            once = write_of(16);
            break;
        case Manner::reads:
        case Manner::deaf:
            once = read_of(16);
            break;
    }
    Bytes all;
    for (int i = 0; i < 40; ++i) all = all + once;
    return all;
}

struct Crowd {
    Crowd(std::uint64_t seed, std::size_t places)
        : random(seed),
          world(sim::turning_table(), options(seed)),
          listener({.name = "virtual", .places = places}) {
        listener.set_addresses({world.gateway_address(), world.motor_address()});
    }

    static sim::WorldOptions options(std::uint64_t seed) {
        sim::WorldOptions options;
        options.seed = seed;
        options.user_submits = true;
        return options;
    }
    void join(Manner manner) {
        const Connections::Id id = sockets.connect();
        sockets[id].reads = manner != Manner::deaf;
        members[id] = manner;
    }
    /// Whose connection was closed comes again; all send what they can.
    void flood() {
        std::vector<Manner> again;
        for (auto it = members.begin(); it != members.end();) {
            const auto [id, manner] = *it;
            sockets.send(id, flood_of(manner, random));
            if (manner == Manner::comes_and_goes) sockets[id].closed_there = true;
            if (!sockets[id].closed_here) {
                ++it;
                continue;
            }
            again.push_back(manner);
            sockets.forget(id);
            it = members.erase(it);
        }
        for (const Manner manner : again) join(manner);
    }
    /// One pass of the loop, which takes the longer the more there is to be read.
    void pass() {
        exchange.bring(world.controller(), world.instant(), world.instant());
        const sim::Time end = world.now() + 250us + 20ns * static_cast<std::int64_t>(sockets.taken());
        while (world.now() < end) world.step(end);
        exchange.take_back(world.controller(), world.instant(), world.instant());
    }
    void go_on(base::Microseconds time) {
        const base::Instant end = world.instant() + time;
        while (world.instant() < end) {
            flood();
            pass();
        }
    }
    gateway::RunState state() const { return world.gateway().run_state(); }

    std::mt19937_64 random;
    sim::World world;
    VirtualSockets sockets;
    Listener listener;
    Exchange exchange{sockets, listener};
    std::map<Connections::Id, Manner> members;
};

/// Until a stopper, who comes while they flood, has heard that the gateway has taken its stop.
base::Microseconds time_of_stop(std::uint64_t seed, std::size_t places) {
    Crowd crowd(seed, places);
    crowd.go_on(300ms);
    EXPECT_EQ(crowd.state(), gateway::RunState::running);
    for (std::size_t i = 0; i < 200; ++i) {
        Manner manner = static_cast<Manner>(crowd.random() % kManners);
        if (seed % 4 != 0 && (manner == Manner::holds || manner == Manner::comes_and_goes))
            manner = Manner::noise;  // those stop it, too
        crowd.join(manner);
    }
    crowd.go_on(base::Microseconds(50'000 + crowd.random() % 400'000));
    const base::Instant begun = crowd.world.instant();
    const Connections::Id stopper = crowd.sockets.connect();
    crowd.sockets.send(stopper, order(kStop));
    while (crowd.world.instant() - begun < 10s && crowd.sockets[stopper].heard.size() < kAccept.size()) {
        crowd.flood();
        crowd.pass();
    }
    EXPECT_EQ(crowd.sockets[stopper].heard, kAccept);
    return crowd.world.instant() - begun;
}

TEST(ListenerFlood, AStopTakesEffectWithinASecondBeside200Clients) {
    base::Microseconds worst{};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const base::Microseconds time = time_of_stop(seed, seed % 2 == 0 ? Listener::kMostClients : 32);
        EXPECT_LT(time, 1s) << "seed " << seed;
        worst = std::max(worst, time);
    }
    std::printf("the slowest of all stops took %.1f ms\n", static_cast<double>(worst.count()) / 1000);
}

/// It had not begun when its client closed the connection.
TEST(Departed, ARunIsNotCarriedOutOfAClientThatClosesAsItIsRead) {
    for (const bool closes : {false, true}) {
        Crowd crowd(1, Listener::kMostClients);
        crowd.go_on(100ms);
        crowd.world.controller().sequence().stop(crowd.world.instant());
        crowd.go_on(200ms);
        ASSERT_EQ(crowd.state(), gateway::RunState::stopped);
        const Connections::Id starter = crowd.sockets.connect();
        crowd.sockets[starter].closes_when_read = closes;
        crowd.sockets.send(starter, order(kRun));
        crowd.go_on(100ms);
        EXPECT_EQ(crowd.state() == gateway::RunState::stopped, closes);
    }
}

/// Between the time that the loop took and the look at its clients.
TEST(Halted, ARunThatWaitedMeanwhileIsNotCarriedOutThoughTheLoopsTimeIsOld) {
    struct WallClock final : ports::Clock {
        base::Instant now() override { return time; }
        base::Instant time{};
    };
    for (const base::Microseconds halt : {500ms, 1'500ms}) {
        Crowd crowd(1, Listener::kMostClients);
        crowd.go_on(100ms);
        crowd.world.controller().sequence().stop(crowd.world.instant());
        crowd.go_on(200ms);
        WallClock clock;
        clock.time = crowd.world.instant();
        Exchange exchange(crowd.sockets, crowd.listener, &clock);
        const Connections::Id starter = crowd.sockets.connect();
        crowd.sockets.when_read = [&](Connections::Id) { clock.time += halt; };
        crowd.sockets.send(starter, order(kRun));
        exchange.bring(crowd.world.controller(), crowd.world.instant(), crowd.world.instant());
        crowd.sockets.when_read = {};
        crowd.go_on(100ms);
        EXPECT_EQ(crowd.state() == gateway::RunState::stopped, halt > Listener::kLongestUnread);
    }
}

TEST(Departed, AStopIs) {
    Crowd crowd(1, Listener::kMostClients);
    crowd.go_on(300ms);
    ASSERT_EQ(crowd.state(), gateway::RunState::running);
    const Connections::Id stopper = crowd.sockets.connect();
    crowd.sockets[stopper].closes_when_read = true;
    crowd.sockets.send(stopper, order(kStop));
    crowd.go_on(100ms);
    EXPECT_EQ(crowd.state(), gateway::RunState::stopped);
}

/// 300 of them kept a stopped gateway busy for 18 s.
TEST(ListenerFlood, HoldsOfAStoppedGatewayKeepNobodyOut) {
    Crowd crowd(1, Listener::kMostClients);
    crowd.go_on(100ms);
    crowd.world.controller().sequence().stop(crowd.world.instant());
    crowd.go_on(200ms);
    for (int i = 0; i < 300; ++i) {
        const Connections::Id id = crowd.sockets.connect();
        crowd.sockets.send(id, order(kHold));
        crowd.sockets[id].closed_there = i % 2 == 0;
    }
    crowd.go_on(5ms);
    const Connections::Id starter = crowd.sockets.connect();
    crowd.sockets.send(starter, order(kRun));
    crowd.go_on(20ms);
    EXPECT_EQ(crowd.sockets[starter].heard, kAccept);
}

}  // namespace
}  // namespace nplc::boards
