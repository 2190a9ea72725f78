// What hosts of Sparkplug B may send, on a gateway whose board is the test's own.
#include "edge_node.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "attempts.h"
#include "faces/axis_loop.h"
#include "set_points_bench.h"

namespace nplc::mqtt {
namespace {

namespace gw = registers::gateway;
using namespace std::chrono_literals;
using gateway::SetPointBench;

struct Host {
    explicit Host(const Options& options = all()) : node(options, {&model}, bell) {
        EXPECT_TRUE(port.upload_and_activate(SetPointBench::content()));
        node.begin_session();
        node.connected();
        run(3s);
    }
    static Options all() {
        Options options;
        options.commands = {gw::Command::run, gw::Command::stop};
        options.set_points = {"*"};
        return options;
    }

    base::Instant now() const { return port.board.now; }
    bool runs() const { return port.gateway->run_state() != gw::RunState::stopped; }
    std::uint64_t milliseconds() const {
        return 1'700'000'000'000 + static_cast<std::uint64_t>(now().time_since_epoch().count()) / 1'000;
    }
    Moment moment() const { return {.now = now(), .milliseconds = milliseconds()}; }
    void run(base::Microseconds time) {
        for (const auto end = now() + time; now() < end;) {
            for (const auto look = now() + 50ms; now() < look;) {
                port.poll();
                loop.poll(*port.controller, now(), now());
            }
            node.tick(moment(), [this](const std::string& topic, const std::string& payload) {
                sent.emplace_back(topic, *decode(payload));
                return true;
            });
        }
    }
    Metric metric(const std::string& name, Value value, base::Milliseconds ahead = 0ms) const {
        Metric one;
        one.name = name;
        one.timestamp = milliseconds() + static_cast<std::uint64_t>(ahead.count());
        one.type = std::holds_alternative<bool>(value) ? DataType::boolean : DataType::real64;
        if (std::holds_alternative<std::string>(value)) one.type = DataType::text;
        one.value = std::move(value);
        return one;
    }
    void send(const std::string& topic, const std::vector<Metric>& metrics) {
        const std::string payload = encode({.timestamp = milliseconds(), .metrics = metrics});
        node.receive({.topic = topic, .payload = payload, .arrived = now()}, moment());
        run(100ms);
    }
    void send(const std::string& topic, const Metric& one) { send(topic, std::vector{one}); }
    void command(const Metric& one) { command(std::vector{one}); }
    void command(const std::vector<Metric>& metrics) { send("spBv1.0/nanoplc/DCMD/nanoplc/x", metrics); }
    std::size_t count(const std::string& kind) const {
        return static_cast<std::size_t>(std::count_if(sent.begin(), sent.end(), [&](const auto& message) {
            return message.first.find("/" + kind + "/") != std::string::npos;
        }));
    }
    bool has_said(const std::string& part) const {
        return std::any_of(sent.begin(), sent.end(), [&](const auto& message) {
            return std::any_of(message.second.metrics.begin(), message.second.metrics.end(),
                               [&](const Metric& one) {
                                   const auto* text = std::get_if<std::string>(&one.value);
                                   return text != nullptr && text->find(part) != std::string::npos;
                               });
        });
    }

    /// Metric Command/last of the last message that has it, by its alias.
    std::string last_command() const {
        std::optional<std::uint64_t> alias;
        std::string last;
        for (const auto& [topic, payload] : sent) {
            for (const Metric& one : payload.metrics) {
                if (one.name == "Command/last") alias = one.alias;
                const auto* text = std::get_if<std::string>(&one.value);
                if (alias && one.alias == alias && text != nullptr) last = *text;
            }
        }
        return last;
    }

    SetPointBench port;
    faces::AxisModel model{"x"};
    faces::AxisLoop loop{model, {}};
    faces::Bell bell{[] {}};
    EdgeNode node;
    std::vector<std::pair<std::string, Payload>> sent;
};

/// The other one's clock is ahead; both are younger than a second.
TEST(EdgeNode, AStopIsTakenAfterACommandOfAHostWhoseClockIsAhead) {
    Host host;
    host.command(host.metric("Command/run", true, 800ms));
    ASSERT_TRUE(host.runs());
    host.command(host.metric("Command/stop", true));
    EXPECT_FALSE(host.runs());
    host.command(host.metric("Command/run", true));
    EXPECT_FALSE(host.runs()) << "it is older than the last one";
}

/// Hosts gather what is written into one message.
TEST(EdgeNode, AStopIsTakenWhateverElseItsMessageHas) {
    Host host;
    const auto others = [&] {
        return std::vector<std::vector<Metric>>{{host.metric("Command/run", true)},
                                                {host.metric("Set Points/Speed", 60.0)},
                                                {host.metric("Command/bogus", true)},
                                                {host.metric("Command/run", false)}};
    };
    for (std::size_t i = 0; i < others().size(); ++i) {
        for (const bool is_first : {false, true}) {
            host.run(2ms);
            host.command(host.metric("Command/run", true));
            ASSERT_TRUE(host.runs()) << i;
            std::vector<Metric> message = others()[i];
            message.insert(is_first ? message.begin() : message.end(), host.metric("Command/stop", true));
            host.command(message);
            EXPECT_FALSE(host.runs()) << i << is_first;
        }
    }
}

// A digit each: 9 values up to 9 s, then one every 10 s.
TEST(EdgeNode, TellsForHowLongAStopIsNotConfirmedEverMoreSeldom) {
    Host host;
    std::optional<std::uint64_t> alias;
    for (const auto& [topic, payload] : host.sent) {
        for (const Metric& one : payload.metrics) {
            if (one.name == "stop_unconfirmed_time") alias = one.alias;
        }
    }
    ASSERT_TRUE(alias);
    host.sent.clear();
    host.port.board.stop_takes = 35s;
    host.command(host.metric("Command/stop", true));
    host.run(38s);
    std::vector<std::int64_t> told;
    for (const auto& [topic, payload] : host.sent) {
        for (const Metric& one : payload.metrics) {
            if (one.alias == alias) told.push_back(std::get<std::int64_t>(one.value));
        }
    }
    EXPECT_EQ(told, (std::vector<std::int64_t>{1000, 2000, 3000, 4000, 5000, 6000, 7000, 8000, 9000, 10'000,
                                               20'000, 30'000, 0}));
}

TEST(EdgeNode, OfTwoCommandsThatAreNoStopNoneIsTaken) {
    Options options = Host::all();
    options.commands.push_back(gw::Command::step);
    Host host(options);
    host.command({host.metric("Command/run", true), host.metric("Command/step", true)});
    EXPECT_FALSE(host.runs());
    EXPECT_TRUE(host.has_said("more than one command in one message; nothing was done"));
}

TEST(EdgeNode, AnOldStopIsNotTaken) {
    Host host;
    host.command(host.metric("Command/run", true));
    host.command(host.metric("Command/stop", true, -1'100ms));
    EXPECT_TRUE(host.runs());
}

/// Of a message that comes now, with a timestamp that far from the gateway's clock.
TEST(EdgeNode, WhyACommandIsNotCarriedOutIsSaid) {
    const auto said_of = [](base::Milliseconds ahead, const std::string& part) {
        Host host;
        host.command(host.metric("Command/run", true, ahead));
        EXPECT_FALSE(host.runs());
        EXPECT_FALSE(host.has_said("waited longer than 1 s to be read"));
        return host.has_said(part);
    };
    EXPECT_TRUE(said_of(
        -2h, "the timestamp is 7200.000 s behind the gateway's clock, and command_age allows 1000 ms"));
    EXPECT_TRUE(said_of(1'250ms, "the timestamp is 1.250 s ahead of the gateway's clock"));
    Host host;
    Metric none = host.metric("Command/run", true);
    none.timestamp = 0;
    host.command(none);
    EXPECT_TRUE(host.has_said("the message has no timestamp"));
    Host of_retained;
    const std::string payload = encode(
        {.timestamp = of_retained.milliseconds(), .metrics = {of_retained.metric("Command/run", true)}});
    of_retained.node.receive({.topic = "spBv1.0/nanoplc/DCMD/nanoplc/x",
                              .payload = payload,
                              .is_retained = true,
                              .arrived = of_retained.now()},
                             of_retained.moment());
    of_retained.run(100ms);
    EXPECT_TRUE(of_retained.has_said("the message is retained"));
    Host of_repeated;
    const Metric run = of_repeated.metric("Command/run", true);
    of_repeated.command(run);
    of_repeated.command(run);
    EXPECT_TRUE(of_repeated.has_said("not later than that of the last command"));
}

TEST(EdgeNode, ACommandHasOneNameTakenOrRefused) {
    for (const bool is_allowed : {true, false}) {
        Options options = Host::all();
        if (!is_allowed) options.commands = {gw::Command::stop};
        Host host(options);
        host.command(host.metric("Command/run", true));
        EXPECT_EQ(host.runs(), is_allowed);
        EXPECT_EQ(host.last_command(), "run") << is_allowed;
    }
}

TEST(EdgeNode, ANodeOrGroupMayBeCalledState) {
    Options options = Host::all();
    options.group = "UPSTATE";
    options.node = "STATE";
    Host host(options);
    host.send("spBv1.0/UPSTATE/DCMD/STATE/x", host.metric("Command/run", true));
    EXPECT_TRUE(host.runs());
    host.send("spBv1.0/UPSTATE/DCMD/STATE/x", host.metric("Command/stop", true));
    EXPECT_FALSE(host.runs());
}

TEST(EdgeNode, OnlyThePrimaryHostsStateCounts) {
    Options options = Host::all();
    options.primary_host = "scada";
    Host host(options);
    const auto state = [&](const std::string& topic, bool online) {
        const std::string payload =
            std::string(R"({"online": )") + (online ? "true" : "false") + R"(, "timestamp": 5})";
        host.node.receive({.topic = topic, .payload = payload, .arrived = host.now()}, host.moment());
        host.run(100ms);
    };
    state("spBv1.0/STATE/other", true);
    EXPECT_EQ(host.count("NBIRTH"), 0U);
    state("spBv1.0/STATE/scada", true);
    EXPECT_EQ(host.count("NBIRTH"), 1U);
    state("spBv1.0/STATE/scada/more", false);
    EXPECT_FALSE(host.node.wants_to_leave());
    state("spBv1.0/STATE/scada", false);
    EXPECT_TRUE(host.node.wants_to_leave());
}

/// Each birth has all values, so a host that asks without a pause gets one a second.
TEST(EdgeNode, RebirthsThatAreAskedForAreOneASecond) {
    Host host;
    const std::size_t before = host.count("NBIRTH");
    for (int i = 0; i < 40; ++i)
        host.send("spBv1.0/nanoplc/NCMD/nanoplc", host.metric("Node Control/Rebirth", true));
    EXPECT_GE(host.count("NBIRTH") - before, 4U);  // 40 times 100 ms
    EXPECT_LE(host.count("NBIRTH") - before, 5U);
    host.run(1s);
    const std::size_t after = host.count("NBIRTH");
    host.run(2s);
    host.send("spBv1.0/nanoplc/NCMD/nanoplc", host.metric("Node Control/Rebirth", true));
    EXPECT_EQ(host.count("NBIRTH"), after + 1) << "one alone is answered at once";
}

TEST(EdgeNode, WhatIsNoCommandIsSaid) {
    Host host;
    host.command(host.metric("Command/run", std::string("true")));
    EXPECT_TRUE(host.has_said("neither a command with the value true, nor a set-point"));
    EXPECT_FALSE(host.runs());
    Host of_alias;
    Metric one = of_alias.metric("", 5.0);
    one.alias = 99'999;
    of_alias.command(one);
    EXPECT_TRUE(of_alias.has_said("alias 99999"));
    Host taken_back;
    taken_back.command(taken_back.metric("Command/run", false));
    EXPECT_FALSE(taken_back.has_said("neither a command"));
}

TEST(EdgeNode, WhatTheConfigurationDoesNotNameIsSaid) {
    Options options;
    options.set_points = {"Speed"};
    Host host(options);
    host.command(host.metric("Command/run", true));
    EXPECT_TRUE(host.has_said("none of the `commands`"));
    host.command(host.metric("Set Points/Length", 70'000.0));
    EXPECT_TRUE(host.has_said("none of the `set_points`"));
    host.command(host.metric("Set Points/Recipe", 1.0));
    EXPECT_TRUE(host.has_said("`recipes` of [mqtt]"));
    EXPECT_EQ(host.port.wanted(), gateway::kDefaults);
}

/// Each is thrown out by the other one's next attempt.
TEST(Attempts, TwoClientsOfOneNameTryEverMoreSeldomAndSaySo) {
    Attempts attempts("nanoplc-hall-cell");
    base::Instant now{};
    std::vector<std::string> told;
    std::vector<base::Microseconds> pauses;
    for (int i = 0; i < 8; ++i) {
        if (attempts.made(now)) told.emplace_back("connected");
        now += 2s;
        EXPECT_FALSE(attempts.lasts(now));
        if (std::string text = attempts.lost(now, "lost"); !text.empty()) told.push_back(text);
        const base::Instant begun = now;
        while (!attempts.is_due(now)) now += 100ms;
        pauses.push_back(now - begun);
    }
    EXPECT_EQ(pauses, (std::vector<base::Microseconds>{1s, 2s, 4s, 8s, 16s, 30s, 30s, 30s}));
    EXPECT_EQ(told,
              (std::vector<std::string>{
                  "connected", "lost", "connected", "lost", "connected",
                  "lost; again and again: is there another client nanoplc-hall-cell? `group` and `node` "
                  "must be its own"}));
    EXPECT_FALSE(attempts.made(now));
    EXPECT_TRUE(attempts.lasts(now + 61s));
    EXPECT_FALSE(attempts.lasts(now + 62s)) << "once";
    EXPECT_EQ(attempts.lost(now + 63s, "lost"), "lost");
    EXPECT_TRUE(attempts.is_due(now + 64s));
}

/// A command, and be it a stop, must not wait half a minute for a broker that was halted or restarted.
TEST(Attempts, ABrokerThatIsAwayIsAskedEveryFewSeconds) {
    const auto pauses = [](bool is_refused) {
        Attempts attempts("n");
        base::Instant now{};
        std::vector<base::Microseconds> all;
        for (int i = 0; i < 7; ++i) {
            static_cast<void>(attempts.lost(now, "why", is_refused));
            const base::Instant begun = now;
            while (!attempts.is_due(now)) now += 100ms;
            all.push_back(now - begun);
        }
        return all;
    };
    EXPECT_EQ(pauses(false), (std::vector<base::Microseconds>{1s, 2s, 4s, 4s, 4s, 4s, 4s}));
    EXPECT_EQ(pauses(true), (std::vector<base::Microseconds>{1s, 2s, 4s, 8s, 16s, 30s, 30s}));
}

TEST(Attempts, ABrokerThatIsAwayIsToldOnceForEachReason) {
    Attempts attempts("n");
    EXPECT_EQ(attempts.lost(base::Instant{}, "refused"), "refused");
    EXPECT_EQ(attempts.lost(base::Instant{1s}, "refused"), "");
    EXPECT_EQ(attempts.lost(base::Instant{3s}, "no route"), "no route");
    EXPECT_TRUE(attempts.made(base::Instant{10s}));
    attempts.left(base::Instant{11s});
    EXPECT_FALSE(attempts.is_due(base::Instant{11'900ms}));
    EXPECT_TRUE(attempts.is_due(base::Instant{12s}));
    EXPECT_EQ(attempts.lost(base::Instant{12s}, "no route"), "no route");
}

}  // namespace
}  // namespace nplc::mqtt
