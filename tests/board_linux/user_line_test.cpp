// A serial line as the connection of one client.
#include "user_line.h"

#include <gtest/gtest.h>

#include "instant_line.h"

namespace nplc::boards {
namespace {

using Bytes = std::vector<std::uint8_t>;

class UserLineTest : public testing::Test {
  protected:
    void arrive(std::size_t count, std::uint8_t value) {
        port.received.insert(port.received.end(), count, {value, false});
    }
    void arrive_damaged() { port.received.push_back({0x55, true}); }
    /// What one read of at most `most` bytes gives, and whether a damaged character ended it.
    std::pair<Bytes, bool> read(std::size_t most) {
        Bytes bytes(most);
        const auto got = line.read(client, bytes);
        bytes.resize(got.count);
        EXPECT_EQ(got.state, hal_linux::Connections::State::open);
        return {bytes, got.is_damaged};
    }

    gateway::InstantLine port;
    UserLine line{port, "/dev/ttyUSB0"};
    const hal_linux::Connections::Id client = line.accept().value();
};

TEST_F(UserLineTest, OneClientIsAlwaysThere) {
    EXPECT_EQ(line.accept(), std::nullopt);
    EXPECT_EQ(line.with_news(), std::vector{client});
    line.close(client);
    EXPECT_EQ(line.with_news(), std::vector{client});
    EXPECT_EQ(line.peer(client).kind, hal_linux::Connections::Peer::Kind::serial_line);
}

TEST_F(UserLineTest, ADamagedCharacterIsLeftOutAndTold) {
    arrive(2, 0x52);
    arrive_damaged();
    arrive(3, 0x11);
    EXPECT_EQ(read(100), std::pair(Bytes(2, 0x52), true));
    EXPECT_EQ(read(100), std::pair(Bytes(3, 0x11), false));
    EXPECT_EQ(read(100), std::pair(Bytes(), false));
}

TEST_F(UserLineTest, DamagedCharactersInARowAreToldOneByOne) {
    arrive_damaged();
    arrive_damaged();
    EXPECT_EQ(read(100), std::pair(Bytes(), true));
    EXPECT_EQ(read(100), std::pair(Bytes(), true));
    EXPECT_EQ(read(100), std::pair(Bytes(), false));
}

TEST_F(UserLineTest, NothingIsLostWhereMoreArrivedThanIsAskedFor) {
    arrive(700, 0xA5);
    std::size_t count = 0;
    for (int i = 0; i < 8; ++i) count += read(100).first.size();
    EXPECT_EQ(count, 700U);
}

TEST_F(UserLineTest, AFullTransmitterTakesWhatItCan) {
    port.room = 3;
    EXPECT_EQ(line.write(client, Bytes{1, 2, 3, 4, 5}), 3U);
    EXPECT_EQ(port.sent, (Bytes{1, 2, 3}));
}

}  // namespace
}  // namespace nplc::boards
