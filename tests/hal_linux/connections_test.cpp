#include "hal_linux/connections.h"

#include <gtest/gtest.h>

#include <fcntl.h>

#include <algorithm>
#include <filesystem>

#include "clients.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;
using State = Connections::State;

class ConnectionsTest : public ::testing::Test {
  protected:
    ConnectionsTest() {
        std::string folder = fs::temp_directory_path() / "connections_XXXXXX";
        folder_ = ::mkdtemp(folder.data());
    }
    ~ConnectionsTest() override { fs::remove_all(folder_); }

    std::string path() const { return folder_ / "socket"; }

    static std::unique_ptr<Connections> open(const std::string& endpoint) {
        auto opened = Connections::open(endpoint, {});
        EXPECT_EQ(opened.error, "");
        return std::move(opened.connections);
    }
    static Connections::Id let_in(Connections& connections) {
        EXPECT_TRUE(readable(connections.descriptor()));
        const auto id = connections.accept();
        EXPECT_TRUE(id);
        return id.value_or(0);
    }
    static std::pair<std::string, State> heard(Connections& connections, Connections::Id id) {
        std::array<std::uint8_t, 100> buffer{};
        const auto got = connections.read(id, buffer);
        return {{buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(got.count)}, got.state};
    }
    static bool has_news(Connections& connections, Connections::Id id) {
        const auto news = connections.with_news();
        return std::find(news.begin(), news.end(), id) != news.end();
    }

    fs::path folder_;
};

const std::vector<std::uint8_t> kAnswer{'x'};

TEST_F(ConnectionsTest, EachClientHasItsOwn) {
    const auto connections = open("unix:" + path());
    EXPECT_FALSE(connections->accept());
    const int first = connect_unix(path());
    const int second = connect_unix(path());
    const auto one = let_in(*connections);
    const auto two = let_in(*connections);
    EXPECT_NE(one, two);
    write_to(second, "two");
    ASSERT_TRUE(readable(connections->descriptor()));
    EXPECT_FALSE(has_news(*connections, one));
    EXPECT_TRUE(has_news(*connections, two));
    EXPECT_EQ(heard(*connections, one), std::pair(std::string(), State::open));
    EXPECT_EQ(heard(*connections, two), std::pair(std::string("two"), State::open));
    EXPECT_EQ(connections->write(two, kAnswer), 1U);
    EXPECT_EQ(read_from(second), "x");
    for (const int client : {first, second}) ::close(client);
}

TEST_F(ConnectionsTest, WhatAClientSentIsReadThoughItHasGone) {
    const auto connections = open("unix:" + path());
    const int client = connect_unix(path());
    const auto id = let_in(*connections);
    write_to(client, "last");
    ::close(client);
    EXPECT_EQ(heard(*connections, id).first, "last");
    EXPECT_EQ(heard(*connections, id), std::pair(std::string(), State::gone));
    EXPECT_EQ(heard(*connections, id).second, State::gone) << "and its Id is nobody's";
    EXPECT_EQ(connections->write(id, kAnswer), std::nullopt);
}

TEST_F(ConnectionsTest, WhetherAClientIsThereIsSeenBeforeAllItSentIsRead) {
    for (const char* kind : {"unix:", "pty:"}) {
        const auto connections = open(kind + path());
        const bool is_terminal = std::string(kind) == "pty:";
        const int client = is_terminal ? ::open(path().c_str(), O_RDWR | O_NOCTTY) : connect_unix(path());
        ASSERT_GE(client, 0);
        write_to(client, "run");
        const auto id = let_in(*connections);
        EXPECT_TRUE(connections->is_open(id));
        EXPECT_EQ(heard(*connections, id), std::pair(std::string("run"), State::open));
        write_to(client, "run");
        ::close(client);
        EXPECT_FALSE(connections->is_open(id));
        EXPECT_EQ(heard(*connections, id), std::pair(std::string("run"), State::hears));
        EXPECT_FALSE(connections->is_open(id));
        EXPECT_FALSE(connections->is_open(id + 1));
    }
}

TEST_F(ConnectionsTest, WhoHasOnlyEndedSendingStillHears) {
    const auto connections = open("unix:" + path());
    const int client = connect_unix(path());
    const auto id = let_in(*connections);
    ::shutdown(client, SHUT_WR);
    EXPECT_EQ(heard(*connections, id), std::pair(std::string(), State::hears));
    EXPECT_EQ(connections->write(id, kAnswer), 1U);
    EXPECT_EQ(read_from(client), "x");
    connections->close(id);
    EXPECT_EQ(read_from(client), "");
    ::close(client);
}

TEST_F(ConnectionsTest, WhoIsNotListenedToWakesNobody) {
    const auto connections = open("unix:" + path());
    const int client = connect_unix(path());
    const auto id = let_in(*connections);
    connections->listen_to(id, false);
    write_to(client, "flood");
    pollfd state{.fd = connections->descriptor(), .events = POLLIN, .revents = 0};
    EXPECT_EQ(::poll(&state, 1, 0), 0);
    EXPECT_TRUE(has_news(*connections, id)) << "it is looked at each time";
    connections->listen_to(id, true);
    EXPECT_TRUE(readable(connections->descriptor()));
    EXPECT_EQ(heard(*connections, id).first, "flood");
    ::close(client);
}

TEST_F(ConnectionsTest, WhoTakesNothingIsWaitedFor) {
    const auto connections = open("unix:" + path());
    const int client = connect_unix(path());
    const auto id = let_in(*connections);
    const std::vector<std::uint8_t> much(65'536, 'x');
    std::size_t taken = 0;
    for (std::optional<std::size_t> more = 1; more.value_or(0) != 0; taken += *more)
        more = connections->write(id, much);
    EXPECT_EQ(connections->write(id, kAnswer), 0U);
    connections->wait_to_write(id, true);
    pollfd state{.fd = connections->descriptor(), .events = POLLIN, .revents = 0};
    EXPECT_EQ(::poll(&state, 1, 0), 0);
    std::array<char, 65'536> buffer{};
    for (std::size_t read = 0; read < taken;) {
        const ssize_t count = ::read(client, buffer.data(), buffer.size());
        ASSERT_GT(count, 0);
        read += static_cast<std::size_t>(count);
    }
    EXPECT_TRUE(readable(connections->descriptor()));
    EXPECT_EQ(connections->write(id, kAnswer), 1U);
    ::close(client);
}

TEST_F(ConnectionsTest, PeersAreKnownAsFarAsTheSystemTells) {
    using Kind = Connections::Peer::Kind;
    const auto connections = open("unix:" + path());
    const int local = connect_unix(path());
    const auto user = connections->peer(let_in(*connections));
    EXPECT_EQ(user.kind, Kind::user);
    EXPECT_EQ(user.number, ::getuid());
    const auto tcp = open("tcp:127.0.0.1:0");
    const int remote = connect_tcp(tcp->name());
    const auto address = tcp->peer(let_in(*tcp));
    EXPECT_EQ(address.kind, Kind::address);
    EXPECT_EQ(address.number, 0x7F000001U);
    EXPECT_NE(address.port, 0);
    for (const int client : {local, remote}) ::close(client);
}

TEST_F(ConnectionsTest, ABrowserIsTurnedAwayFromTcp) {
    const auto connections = open("tcp:127.0.0.1:0");
    const int client = connect_tcp(connections->name());
    const auto id = let_in(*connections);
    write_to(client, "POST / HTTP/1.1\r\n\r\n");
    ASSERT_TRUE(readable(connections->descriptor()));
    EXPECT_EQ(heard(*connections, id), std::pair(std::string(), State::gone));
    EXPECT_EQ(connections->turned_away(), 1U);
    ::close(client);
}

}  // namespace
}  // namespace nplc::hal_linux
