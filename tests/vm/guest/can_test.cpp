#include "hal_linux/socket_can.h"
#include "outside.h"

// can0 and can1 are two controllers (SJA1000) on one bus, vcan0 is a virtual interface. The other party is
// can-utils. The virtual controllers count no errors, so none goes off the bus by itself: cansend says that
// it did, with an error frame as a driver would make it.
namespace nplc::board_tests {
namespace {

using hal_linux::SocketCan;
using ports::CanFaults;
using ports::CanFilter;
using ports::CanFrame;
using ports::CanState;

constexpr const char* kBusOff = "20000040#0000000000000000";
constexpr const char* kRestarted = "20000100#0000000000000000";

std::string ip(const std::string& words) {
    return output_of("/usr/bin/ip " + words);
}
void send(const std::string& interface, const std::string& frame) {
    run("cansend " + interface + " " + frame);
}

CanFrame data(std::uint32_t id, std::vector<std::uint8_t> bytes) {
    CanFrame frame{.id = id, .length = static_cast<std::uint8_t>(bytes.size())};
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    return frame;
}
CanFrame extended(CanFrame frame) {
    frame.extended = true;
    return frame;
}
CanFrame remote(std::uint32_t id, std::uint8_t length) {
    return {.id = id, .remote = true, .length = length};
}

struct Written {
    CanFrame frame;
    std::string words;  ///< of can-utils
};
const std::vector<Written> kFrames = {
    {data(0x123, {0xDE, 0xAD, 0xBE, 0xEF}), "123#DEADBEEF"},
    {data(0x000, {}), "000#"},
    {data(0x7FF, {0, 1, 2, 3, 4, 5, 6, 7}), "7FF#0001020304050607"},
    {extended(data(0x1FFFFFFF, {0xFF})), "1FFFFFFF#FF"},
    {extended(data(0x00000123, {1, 2})), "00000123#0102"},
    {remote(0x123, 0), "123#R"},
    {extended(remote(0x0ABCDEF0, 0)), "0ABCDEF0#R"},
};

/// Frames that come within a time that is long enough, until there are `count`.
std::vector<CanFrame> received(SocketCan& can, std::size_t count) {
    std::vector<CanFrame> all;
    CanFrame frame;
    while (all.size() < count) {
        if (can.read(frame))
            all.push_back(frame);
        else if (!readable(can.descriptor(), kSoon))
            break;
    }
    return all;
}
void settle(SocketCan& can) {
    CanFrame frame;
    while (can.read(frame)) continue;
}
/// Nothing else is waited for here than the state.
CanState state_after(SocketCan& can, CanState wanted) {
    CanFrame frame;
    while (can.state() != wanted && readable(can.descriptor(), kSoon)) can.read(frame);
    return can.state();
}

class Can : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        for (const std::string name : {"can0", "can1"})
            EXPECT_EQ(
                ip("link set " + name + " type can bitrate 125000 && /usr/bin/ip link set " + name + " up"),
                "");
        EXPECT_EQ(ip("link add vcan0 type vcan && /usr/bin/ip link set vcan0 up"), "");
    }
    static std::unique_ptr<SocketCan> opened(const std::string& interface) {
        auto answer = SocketCan::open({.interface = interface});
        EXPECT_EQ(answer.error, "");
        return std::move(answer.can);
    }
};

TEST_F(Can, WhatCanUtilsSendsIsReceived) {
    const auto can = opened("can0");
    ASSERT_EQ(can->state(), CanState::active);
    for (const Written& one : kFrames) {
        send("can1", one.words);
        EXPECT_EQ(received(*can, 1), std::vector{one.frame}) << one.words;
    }
    EXPECT_EQ(can->faults(), CanFaults{});
}

TEST_F(Can, WhatIsSentIsSeenByCandump) {
    const auto can = opened("can0");
    FILE* dump = ::popen("candump -L -n 7 -T 60000 can1", "r");
    while (output_of("grep -c '^ *can1 ' /proc/net/can/rcvlist_all") == "0\n") continue;
    for (const Written& one : kFrames) {
        while (!can->write(one.frame)) continue;
    }
    for (const Written& one : kFrames) {
        std::array<char, 128> line{};
        ASSERT_NE(std::fgets(line.data(), line.size(), dump), nullptr) << one.words;
        EXPECT_NE(std::string(line.data()).find("can1 " + one.words), std::string::npos) << line.data();
    }
    ::pclose(dump);
    settle(*can);
    CanFrame none;
    EXPECT_FALSE(can->read(none)) << "the own frames do not come back";
}

TEST_F(Can, WhatIsNoFrameIsNotSent) {
    const auto can = opened("can0");
    EXPECT_FALSE(can->write({.id = 0x800}));
    EXPECT_FALSE(can->write({.id = 0x20000000, .extended = true}));
    EXPECT_FALSE(can->write({.id = 1, .length = 9}));
}

TEST_F(Can, FiltersLetInWhatTheyName) {
    const auto can = opened("can0");
    const auto got = [&](const std::vector<CanFilter>& filters) {
        EXPECT_TRUE(can->filter(filters));
        for (const char* words : {"123#01", "124#02", "12F#03", "00000123#04", "123#R", "7FF#"})
            send("can1", words);
        // The last one is always let in, so all have come.
        std::vector<CanFrame> all;
        CanFrame frame;
        while (frame.id != 0x7FF) {
            const auto next = received(*can, 1);
            if (next.empty()) break;
            frame = next[0];
            all.push_back(frame);
        }
        if (!all.empty()) all.pop_back();
        return all;
    };
    const CanFilter last{.id = 0x7FF, .mask = 0x7FF};
    EXPECT_EQ(got({{.id = 0x123, .mask = 0x7FF}, last}), (std::vector{data(0x123, {1}), remote(0x123, 0)}));
    EXPECT_EQ(got({{.id = 0x120, .mask = 0x7F8}, last}),
              (std::vector{data(0x123, {1}), data(0x124, {2}), remote(0x123, 0)}));
    EXPECT_EQ(got({{.id = 0x123, .mask = 0x1FFFFFFF, .extended = true}, last}),
              (std::vector{extended(data(0x123, {4}))}));
    EXPECT_EQ(got({{.id = 0x123, .mask = 0x7FF}, {.id = 0x120, .mask = 0x7F0}, last}),
              (std::vector{data(0x123, {1}), data(0x124, {2}), data(0x12F, {3}), remote(0x123, 0)}))
        << "once, though two let it in";
    EXPECT_FALSE(can->filter(std::vector<CanFilter>(513))) << "SocketCAN has 512";
    EXPECT_TRUE(can->filter({}));
    send("can1", "123#01");
    send("can1", "7FF#");
    const auto other = opened("can0");
    send("can1", "001#");
    EXPECT_EQ(received(*other, 1), std::vector{data(1, {})});
    CanFrame none;
    EXPECT_FALSE(can->read(none)) << "no filter, no frames";
}

TEST_F(Can, ErrorFramesAreCountedAndTellTheState) {
    const auto can = opened("vcan0");
    const auto told = [&](const std::string& frame) {
        send("vcan0", frame);
        send("vcan0", "001#");
        EXPECT_EQ(received(*can, 1).size(), 1U) << "an error frame is none of the bus";
        return can->state();
    };
    EXPECT_EQ(told("20000004#0008000000000000"), CanState::warning) << "transmitter: 96";
    EXPECT_EQ(told("20000004#0010000000000000"), CanState::passive) << "receiver: 128";
    EXPECT_EQ(told("20000004#0040000000000000"), CanState::active);
    EXPECT_EQ(can->faults(), CanFaults{});
    told("20000020#0000000000000000");
    told("20000088#0000040000000000");
    EXPECT_EQ(can->faults(), (CanFaults{.bus_errors = 2})) << "no acknowledgement; a stuff error";
    told("20000004#0001000000000000");
    EXPECT_EQ(can->faults(), (CanFaults{.bus_errors = 2, .overruns = 1}));
    EXPECT_EQ(told(kBusOff), CanState::bus_off);
    EXPECT_FALSE(can->write(data(1, {})));
    EXPECT_EQ(told(kRestarted), CanState::active);
    EXPECT_EQ(can->faults(), (CanFaults{.bus_errors = 2, .overruns = 1, .bus_offs = 1}));
    EXPECT_TRUE(can->write(data(1, {})));
}

TEST_F(Can, ARestartIsAskedOfTheDriver) {
    const auto can = opened("can0");
    EXPECT_FALSE(can->restart());
    EXPECT_EQ(can->restart_problem(), "can0 is not off the bus");
    send("can0", kBusOff);
    EXPECT_EQ(state_after(*can, CanState::bus_off), CanState::bus_off);
    EXPECT_EQ(as_nobody([&] { return can->restart() ? "restarted" : can->restart_problem(); }),
              "can0: a restart from here needs CAP_NET_ADMIN; with restart-ms the kernel does it");
    EXPECT_FALSE(can->restart());
    EXPECT_EQ(can->restart_problem(), "can0 is not off the bus") << "which the driver knows better";
    EXPECT_EQ(can->state(), CanState::active);
}

TEST_F(Can, ARestartByTheKernelIsLeftToIt) {
    EXPECT_EQ(ip("link set can0 down && /usr/bin/ip link set can0 type can restart-ms 100 && "
                 "/usr/bin/ip link set can0 up"),
              "");
    const auto can = opened("can0");
    send("can0", kBusOff);
    EXPECT_EQ(state_after(*can, CanState::bus_off), CanState::bus_off);
    EXPECT_FALSE(can->restart());
    EXPECT_EQ(can->restart_problem(), "can0: the kernel restarts it by itself (restart-ms), or it is down");
}

TEST_F(Can, AnInterfaceMayGoDownAndComeUpAgain) {
    const auto can = opened("can0");
    ASSERT_EQ(can->state(), CanState::active);
    const int descriptor = can->descriptor();
    EXPECT_EQ(ip("link set can0 down"), "");
    EXPECT_EQ(state_after(*can, CanState::down), CanState::down);
    EXPECT_FALSE(can->gone());
    EXPECT_FALSE(can->write(data(1, {})));
    settle(*can);
    EXPECT_FALSE(readable(can->descriptor())) << "who waits is not woken for ever";
    EXPECT_EQ(ip("link set can0 up"), "");
    EXPECT_EQ(state_after(*can, CanState::active), CanState::active);
    send("can1", "123#01");
    EXPECT_EQ(received(*can, 1), std::vector{data(0x123, {1})});
    EXPECT_TRUE(can->write(data(1, {})));
    EXPECT_EQ(can->descriptor(), descriptor);
}

TEST_F(Can, AnInterfaceMayBeOpenedBeforeItIsUp) {
    EXPECT_EQ(ip("link set vcan0 down"), "");
    const auto can = opened("vcan0");
    EXPECT_EQ(can->state(), CanState::down);
    EXPECT_EQ(ip("link set vcan0 up"), "");
    EXPECT_EQ(state_after(*can, CanState::active), CanState::active);
    send("vcan0", "123#");
    EXPECT_EQ(received(*can, 1), std::vector{data(0x123, {})});
}

TEST_F(Can, AnInterfaceThatIsGoneIsFoundAgainWithItsFilters) {
    const auto can = opened("vcan0");
    const int descriptor = can->descriptor();
    EXPECT_TRUE(can->filter(std::vector{CanFilter{.id = 0x123, .mask = 0x7FF}}));
    EXPECT_EQ(ip("link del vcan0"), "");
    EXPECT_EQ(state_after(*can, CanState::down), CanState::down);
    settle(*can);
    EXPECT_TRUE(can->gone());
    EXPECT_FALSE(readable(can->descriptor()));
    EXPECT_FALSE(can->write(data(1, {})));
    EXPECT_EQ(can->reopen(),
              "there is no interface 'vcan0'; `ip -o link | grep link/can` lists those for CAN");
    EXPECT_EQ(ip("link add vcan0 type vcan"), "");
    EXPECT_TRUE(readable(can->descriptor(), kSoon)) << "the change wakes who waits";
    EXPECT_EQ(can->reopen(), "");
    EXPECT_EQ(can->state(), CanState::down);
    EXPECT_EQ(ip("link set vcan0 up"), "");
    EXPECT_EQ(state_after(*can, CanState::active), CanState::active);
    send("vcan0", "124#");
    send("vcan0", "123#");
    EXPECT_EQ(received(*can, 1), std::vector{data(0x123, {})});
    EXPECT_EQ(can->descriptor(), descriptor);
}

TEST_F(Can, WhatIsNotReadInTimeIsLostAndCounted) {
    const auto can = opened("vcan0");
    run("cangen vcan0 -g 0 -I 100 -L 8 -D 0102030405060708 -n 3000");
    std::size_t count = 0;
    CanFrame frame;
    while (can->read(frame)) ++count;
    EXPECT_LT(count, 3000U);
    EXPECT_GT(count, 0U);
    send("vcan0", "001#");
    EXPECT_EQ(received(*can, 1), std::vector{data(1, {})});
    EXPECT_EQ(can->faults().overruns, 3000 - count) << "the next frame tells how many";
}

TEST_F(Can, SaysWhatIsWrong) {
    const auto error = [](const std::string& interface, std::uint32_t bitrate) {
        return SocketCan::open({.interface = interface, .bitrate = bitrate}).error;
    };
    EXPECT_EQ(error("can0", 125'000), "");
    EXPECT_EQ(error("vcan0", 125'000), "") << "a virtual one has no bit rate";
    EXPECT_EQ(error("can0", 250'000),
              "can0 is set to 125000 bit/s, not to 250000; as root: ip link set can0 down && ip link set "
              "can0 type can "
              "bitrate 250000 restart-ms 100 && ip link set can0 up");
    EXPECT_EQ(error("can9", 125'000),
              "there is no interface 'can9'; `ip -o link | grep link/can` lists those for CAN");
    run("rmmod kvaser_pci && modprobe kvaser_pci");
    EXPECT_EQ(error("can0", 125'000),
              "can0 has no bit rate yet; as root: ip link set can0 down && ip link set can0 type can bitrate "
              "125000 "
              "restart-ms 100 && ip link set can0 up");
}

}  // namespace
}  // namespace nplc::board_tests
