// A Modbus client on a socket whose master sends a stop behind a request that takes long.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "faces/axis_loop.h"
#include "set_points_bench.h"
#include "tcp_client.h"

namespace nplc::modbus {
namespace {

namespace gw = registers::gateway;
using namespace std::chrono_literals;
using gateway::SetPointBench;
using Bytes = std::vector<std::uint8_t>;

struct Line : testing::Test {
    Line() {
        EXPECT_TRUE(port.upload_and_activate(SetPointBench::content()));
        set.join(bell);
        EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()), 0);
        client.emplace(ends[0], set, "Modbus 10.0.0.1", bell, Moment{.now = now(), .arrived = now()});
        run(20ms);
    }
    ~Line() override { ::close(ends[1]); }

    base::Instant now() const { return port.board.now; }
    bool runs() const { return port.gateway->run_state() != gw::RunState::stopped; }
    /// As the server's thread does it, every millisecond.
    void run(base::Microseconds time) {
        for (const auto end = now() + time; now() < end;) {
            for (int i = 0; i < 4; ++i) {
                port.poll();
                loop.poll(*port.controller, now(), now());
            }
            pollfd polled{.fd = ends[0], .events = client->events(), .revents = 0};
            ::poll(&polled, 1, 0);
            client->serve(polled.revents, now());
        }
    }
    void send(std::uint8_t transaction, const Bytes& pdu) {
        Bytes frame{0, transaction, 0, 0, 0, static_cast<std::uint8_t>(pdu.size() + 1), 1};
        frame.insert(frame.end(), pdu.begin(), pdu.end());
        ASSERT_EQ(::send(ends[1], frame.data(), frame.size(), 0), static_cast<ssize_t>(frame.size()));
    }
    /// Transactions that have been answered, in their order.
    std::vector<unsigned> answered() {
        std::array<std::uint8_t, 4'096> bytes{};
        const ssize_t count = ::recv(ends[1], bytes.data(), bytes.size(), 0);
        std::vector<unsigned> all;
        for (std::size_t at = 0; count > 0 && at + 6 < static_cast<std::size_t>(count);
             at += 6U + bytes[at + 5])
            all.push_back(bytes[at + 1]);
        return all;
    }

    SetPointBench port;
    faces::AxisModel model{"x"};
    faces::AxisLoop loop{model, {}};
    faces::Bell bell{[] {}};
    UnitSet set{{&model}, Settings{}};
    std::array<int, 2> ends{};
    std::optional<TcpClient> client;
};

TEST_F(Line, AStopOvertakesWhatTheStorageHoldsUp) {
    send(1, {16, 0, 0, 0, 2, 4, 0, 0, 0, 0});
    send(2, {16, 0, 0, 0, 2, 4, 0, 1, 0, 1});  // run
    run(100ms);
    ASSERT_TRUE(runs());
    EXPECT_EQ(answered(), (std::vector<unsigned>{1, 2}));
    port.flash.work_for(20'000);
    send(3, {16, 0, 0, 0, 8, 16, 0, 34, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0x84});
    run(100ms);
    EXPECT_TRUE(answered().empty());
    send(4, {4, 0, 0, 0, 1});
    send(5, {5, 0, kStop, 0xFF, 0});
    run(500ms);
    EXPECT_FALSE(runs());
    EXPECT_EQ(answered(), (std::vector<unsigned>{3, 4, 5}));
    EXPECT_FALSE(client->is_gone());
}

}  // namespace
}  // namespace nplc::modbus
