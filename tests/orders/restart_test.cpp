// A table that is ordered for an axis that runs, on a gateway whose board is the test's own.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/bytes.h"
#include "deployment/deployment.h"
#include "faces/axis_loop.h"
#include "orders/crypto.h"
#include "orders/keys.h"
#include "port_bench.h"

namespace nplc::deployment {
namespace {

namespace gw = registers::gateway;
using gateway::Bytes;
using gateway::PortBench;
using orders::State;
using namespace std::chrono_literals;

/// Step 0 goes to step 1, which stays (STATE C0h and C1h, FAST_DIS); the other one to step 2.
const Bytes kFormer{{0xC0, 0, 0, 0x01, 0x80, 0, 0, 0}, {0xC1, 0, 0, 0x3E, 0x80, 1, 0, 0}};
const Bytes kOrdered{{0xC0, 0, 0, 0x02, 0x80, 0, 0, 0}, {0xC2, 0, 0, 0x3E, 0x80, 1, 0, 0}};

struct Folder {
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "orders_test_XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string path;
};

struct Bench {
    explicit Bench(Activation activation) {
        EXPECT_TRUE(port.upload_and_activate(kFormer));
        EXPECT_TRUE(port.command(gw::Command::run));
        std::filesystem::create_directories(folder.path + "/x");
        const orders::TrustedKey key{.name = "maker", .key = orders::public_key_of(seed)};
        std::ofstream(folder.path + "/maker.pub") << orders::write_public(key);
        settings.keys = settings.folder = folder.path;
        settings.activation = activation;
        deployment.emplace(settings, "plant/cell/x", model, bell,
                           [this](bool, const std::string& line) { told += line + '\n'; });
    }

    void step() {
        port.poll();
        loop.poll(*port.controller, port.board.now, port.board.now);
        deployment->tick(moment());
        std::this_thread::yield();  // the files are written by a thread of their own
    }
    Moment moment() const { return {.now = port.board.now, .milliseconds = 1'000}; }
    void run(base::Microseconds time) {
        for (const auto end = port.board.now + time; port.board.now < end;) step();
    }
    bool reaches(State state) {
        for (int steps = 0; steps < 1'000'000; ++steps) {
            step();
            const auto report = deployment->report();
            if (report && report->state == state) return true;
        }
        return false;
    }
    /// However long the thread that writes files takes.
    bool tells(std::string_view words) {
        for (int steps = 0; steps < 1'000'000 && told.find(words) == std::string::npos; ++steps) step();
        return told.find(words) != std::string::npos;
    }
    gw::RunState run_state() { return port.controller->sequence().run_state(); }
    bool stops_for_it() {
        for (int steps = 0; steps < 1'000'000 && run_state() == gw::RunState::running; ++steps) step();
        return run_state() == gw::RunState::stopped;
    }
    void order(std::uint64_t counter) {
        const std::span<const std::uint8_t> bytes(kOrdered);
        const orders::Order order{.target = "plant/cell/x",
                                  .counter = counter,
                                  .name = "two",
                                  .sha256 = orders::sha256(bytes),
                                  .bytes = static_cast<std::uint32_t>(bytes.size())};
        run(300ms);
        deployment->take_order(orders::write_order(order, seed), moment());
        EXPECT_TRUE(reaches(State::fetching)) << told;
        deployment->take_piece(order.sha256, 0, bytes);
    }

    PortBench port;
    faces::AxisModel model{"x"};
    faces::LoopSettings loop_settings{};
    faces::AxisLoop loop{model, loop_settings};
    faces::Bell bell{[] {}};
    std::unique_ptr<faces::CommandDesk::Client> panel = model.join(faces::Side::person, "panel", bell);
    Folder folder;
    orders::Seed seed = orders::new_seed();
    Settings settings{};
    std::string told;
    std::optional<Deployment> deployment;
};

TEST(OrderedRestart, RunsTheTableIfTheFormerOneRan) {
    Bench bench(Activation::restart);
    bench.order(1);
    ASSERT_TRUE(bench.stops_for_it());
    ASSERT_TRUE(bench.reaches(State::trial)) << bench.told;
    bench.run(1s);
    EXPECT_EQ(bench.run_state(), gw::RunState::running) << bench.told;
    EXPECT_EQ(bench.port.read(gw::STEP), 2U);
}

/// Over the user's port, from a face, or by the enable input, which comes back.
TEST(OrderedRestart, WhoStopsTheAxisMeanwhileKeepsItStopped) {
    for (const char* how : {"port", "face", "enable"}) {
        SCOPED_TRACE(how);
        Bench bench(Activation::restart);
        const std::string_view means = how;
        if (means == "enable") {
            ASSERT_TRUE(bench.port.command(gw::Command::stop));
            ASSERT_TRUE(bench.port.write(gw::register_of(gw::Setting::enable_input), 5));
            bench.port.board.in = 0x20;
            bench.run(50ms);
            ASSERT_TRUE(bench.port.command(gw::Command::run));
        }
        bench.order(1);
        ASSERT_TRUE(bench.stops_for_it());
        if (means == "port") {
            EXPECT_TRUE(bench.port.command(gw::Command::stop));
        } else if (means == "face") {
            ASSERT_TRUE(bench.panel->submit(faces::Command::of(gw::Command::stop, bench.port.board.now)));
        } else {
            bench.port.board.in = 0;
            bench.run(50ms);
            bench.port.board.in = 0x20;
        }
        ASSERT_TRUE(bench.reaches(State::trial)) << bench.told;
        bench.run(12s);
        EXPECT_EQ(bench.run_state(), gw::RunState::stopped);
        EXPECT_NE(bench.told.find("is not run again: another client has stopped it since"), std::string::npos)
            << bench.told;
    }
}

/// The motor does not come to rest in time; a later start would be unexpected.
TEST(OrderedRestart, WhatComesToNothingRunsNothingLater) {
    Bench bench(Activation::restart);
    bench.port.board.motor_registers[registers::V_IST] = 500;
    bench.order(1);
    ASSERT_TRUE(bench.stops_for_it());
    ASSERT_TRUE(bench.tells("is not run again")) << bench.told;
    bench.port.board.motor_registers[registers::V_IST] = 0;
    ASSERT_TRUE(bench.reaches(State::trial)) << bench.told;
    bench.run(12s);
    EXPECT_EQ(bench.run_state(), gw::RunState::stopped);
}

}  // namespace
}  // namespace nplc::deployment
