#include "hal_linux/byte_server.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "clients.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;

class ByteServerTest : public ::testing::Test {
  protected:
    ByteServerTest() {
        std::string folder = fs::temp_directory_path() / "byte_server_XXXXXX";
        folder_ = ::mkdtemp(folder.data());
    }
    ~ByteServerTest() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return folder_ / name; }

    static std::unique_ptr<ByteServer> open(const std::string& endpoint) {
        auto opened = ByteServer::open(endpoint);
        EXPECT_EQ(opened.error, "");
        return std::move(opened.server);
    }

    fs::path folder_;
};

void send_to(ByteServer& server, const std::string& text) {
    server.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string received(ByteServer& server) {
    std::array<std::uint8_t, 100> buffer{};
    if (!readable(server.descriptor())) return "nothing came";
    const std::size_t count = server.read(buffer);
    return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count)};
}

// 0Ah, 0Dh, 11h, 13h, 03h and 04h are what a terminal that is not raw would change or swallow.
const std::string kAllBytes("\x0A\x0D\x11\x13\x03\x04\x00\xFF\x7F text", 14);

void expect_exchange(ByteServer& server, int client) {
    write_to(client, kAllBytes);
    EXPECT_EQ(received(server), kAllBytes);
    EXPECT_TRUE(server.has_client());
    send_to(server, kAllBytes);
    EXPECT_EQ(read_from(client), kAllBytes);
}

TEST_F(ByteServerTest, PtyPassesEveryByte) {
    const auto server = open("pty:" + path("motor"));
    EXPECT_EQ(server->name(), "pty:" + path("motor"));
    EXPECT_TRUE(fs::is_symlink(path("motor")));
    const int client = ::open(path("motor").c_str(), O_RDWR | O_NOCTTY);
    ASSERT_GE(client, 0);
    expect_exchange(*server, client);
    ::close(client);
}

TEST_F(ByteServerTest, PtyForgetsWhatNobodyTook) {
    const auto server = open("pty:" + path("motor"));
    EXPECT_FALSE(server->has_client());
    send_to(*server, "old");
    for (int round = 0; round < 2; ++round) {
        const int client = ::open(path("motor").c_str(), O_RDWR | O_NOCTTY);
        EXPECT_TRUE(server->has_client());
        send_to(*server, "new");
        EXPECT_EQ(read_from(client), "new");
        ::close(client);
        EXPECT_FALSE(server->has_client());
        send_to(*server, "old");
    }
}

TEST_F(ByteServerTest, PtyDoesNotBlockWhenItsClientDoesNotRead) {
    const auto server = open("pty:" + path("motor"));
    const int client = ::open(path("motor").c_str(), O_RDWR | O_NOCTTY);
    for (int i = 0; i < 10'000; ++i) send_to(*server, "0123456789");
    EXPECT_FALSE(read_from(client).empty());
    ::close(client);
}

TEST_F(ByteServerTest, PtyReplacesALinkAndNothingElse) {
    fs::create_symlink("/dev/pts/no_such", path("motor"));
    auto server = open("pty:" + path("motor"));
    server.reset();
    EXPECT_FALSE(fs::is_symlink(path("motor")));
    std::ofstream(path("file")) << "precious";
    const auto refused = ByteServer::open("pty:" + path("file"));
    EXPECT_EQ(refused.server, nullptr);
    EXPECT_NE(refused.error.find(path("file")), std::string::npos) << refused.error;
    EXPECT_EQ(fs::file_size(path("file")), 8U);
    EXPECT_NE(ByteServer::open("pty:" + path("no/such/folder")).error, "");
}

/// What the name refused for; it stays as it is.
std::string refusal(const std::string& endpoint) {
    const auto opened = ByteServer::open(endpoint);
    EXPECT_EQ(opened.server, nullptr) << endpoint;
    EXPECT_EQ(opened.error.find(endpoint), 0U) << opened.error;
    return opened.error;
}

TEST_F(ByteServerTest, ANameIsServedOnce) {
    for (const char* kind : {"pty:", "unix:"}) {
        const std::string endpoint = kind + path("motor");
        auto first = open(endpoint);
        const auto before = fs::symlink_status(path("motor")).type();
        EXPECT_NE(refusal(endpoint).find("already serves there"), std::string::npos);
        EXPECT_NE(refusal(kind + path("../" + folder_.filename().string() + "/motor")), "");
        EXPECT_EQ(fs::symlink_status(path("motor")).type(), before);
        first.reset();
        EXPECT_TRUE(fs::is_empty(folder_)) << kind;
    }
}

TEST_F(ByteServerTest, TheEndOfAServerLeavesWhatSomebodyElsePutInItsPlace) {
    auto pty = open("pty:" + path("motor"));
    fs::remove(path("motor"));
    fs::create_symlink("/dev/pts/other", path("motor"));
    pty.reset();
    EXPECT_EQ(fs::read_symlink(path("motor")), "/dev/pts/other");
    auto socket = open("unix:" + path("socket"));
    fs::remove(path("socket"));
    std::ofstream(path("socket")) << "precious";
    socket.reset();
    EXPECT_EQ(fs::file_size(path("socket")), 8U);
}

/// The number of a terminal is given to the next one that is opened: whose it is now does not matter.
TEST_F(ByteServerTest, TheLinkOfAKilledProgramIsReplacedThoughItsNumberIsInUseAgain) {
    const auto other = open("pty:" + path("other"));
    fs::copy_symlink(path("other"), path("motor"));
    std::ofstream(path(".motor.lock")).close();
    const auto server = open("pty:" + path("motor"));
    EXPECT_NE(fs::read_symlink(path("motor")), fs::read_symlink(path("other")));
    const int client = ::open(path("motor").c_str(), O_RDWR | O_NOCTTY);
    expect_exchange(*server, client);
    ::close(client);
}

TEST_F(ByteServerTest, ALinkToAnythingElseIsLeftAlone) {
    std::ofstream(path("file")) << "precious";
    fs::create_symlink(path("file"), path("motor"));
    EXPECT_NE(refusal("pty:" + path("motor")).find("a link of this name, to " + path("file")),
              std::string::npos);
    EXPECT_TRUE(fs::is_symlink(path("motor")));
    refusal("unix:" + path("motor"));
    refusal("unix:" + path("file"));
    EXPECT_EQ(fs::file_size(path("file")), 8U);
}

TEST_F(ByteServerTest, WhatStandsWhereTheLockShouldIsLeftAlone) {
    const std::string lock = path(".motor.lock");
    std::ofstream(path("file")) << "precious";
    const std::function<void()> prepared[] = {
        [&] { fs::create_symlink(path("file"), lock); },
        [&] { fs::create_symlink(path("nothing"), lock); },
        [&] { fs::create_directory(lock); },
        [&] { ASSERT_EQ(::mkfifo(lock.c_str(), 0600), 0); },
        [&] { fs::copy_file(path("file"), lock); },
    };
    for (const auto& prepare : prepared) {
        prepare();
        const auto type = fs::symlink_status(lock).type();
        for (const char* kind : {"pty:", "unix:"})
            EXPECT_NE(refusal(kind + path("motor")).find(lock), std::string::npos);
        EXPECT_EQ(fs::symlink_status(lock).type(), type);
        fs::remove(lock);
    }
    EXPECT_FALSE(fs::exists(path("nothing")));
    EXPECT_EQ(fs::file_size(path("file")), 8U);
}

TEST_F(ByteServerTest, UnixSocketPassesEveryByteAndGoesAway) {
    auto server = open("unix:" + path("socket"));
    const int client = connect_unix(path("socket"));
    expect_exchange(*server, client);
    ::close(client);
    EXPECT_EQ(received(*server), "");
    EXPECT_FALSE(server->has_client());
    send_to(*server, "lost");
    const int second = connect_unix(path("socket"));
    expect_exchange(*server, second);
    ::close(second);
    server.reset();
    EXPECT_FALSE(fs::exists(path("socket")));
}

TEST_F(ByteServerTest, ASecondClientIsTurnedAway) {
    const auto server = open("unix:" + path("socket"));
    const int first = connect_unix(path("socket"));
    expect_exchange(*server, first);
    const int second = connect_unix(path("socket"));
    EXPECT_TRUE(server->has_client());
    EXPECT_EQ(read_from(second), "");
    expect_exchange(*server, first);
    ::close(first);
    ::close(second);
}

TEST_F(ByteServerTest, AClientThatHungUpMakesRoomAtOnce) {
    const auto server = open("unix:" + path("socket"));
    const int first = connect_unix(path("socket"));
    EXPECT_TRUE(server->has_client());
    ::close(first);
    const int second = connect_unix(path("socket"));
    expect_exchange(*server, second);
    ::close(second);
}

TEST_F(ByteServerTest, TheNextClientWaitsForTheLastWordsOfOneThatHungUp) {
    const auto server = open("unix:" + path("socket"));
    const int first = connect_unix(path("socket"));
    EXPECT_TRUE(server->has_client());
    write_to(first, "last words");
    ::close(first);
    const int second = connect_unix(path("socket"));
    write_to(second, "hello");
    EXPECT_TRUE(server->has_client());
    EXPECT_EQ(received(*server), "last words");
    EXPECT_TRUE(server->has_client());
    EXPECT_EQ(received(*server), "hello");
    ::close(second);
}

TEST_F(ByteServerTest, AClientThatLeftItsAnswerUnreadMakesRoomToo) {
    const auto server = open("unix:" + path("socket"));
    const int first = connect_unix(path("socket"));
    send_to(*server, "never read");
    ::close(first);
    const int second = connect_unix(path("socket"));
    expect_exchange(*server, second);
    ::close(second);
}

TEST_F(ByteServerTest, AStaleSocketIsReplacedALiveOneIsNot) {
    {
        const int dead = ::socket(AF_UNIX, SOCK_STREAM, 0);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path("socket").copy(address.sun_path, sizeof address.sun_path - 1);
        ASSERT_EQ(::bind(dead, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        ::close(dead);
    }
    const auto server = open("unix:" + path("socket"));
    EXPECT_NE(ByteServer::open("unix:" + path("socket")).error, "");
    const int client = connect_unix(path("socket"));
    expect_exchange(*server, client);
    ::close(client);
}

TEST_F(ByteServerTest, TcpPassesEveryByteAndTellsItsPort) {
    const auto server = open("tcp:127.0.0.1:0");
    EXPECT_NE(server->name(), "tcp:127.0.0.1:0");
    const int client = connect_tcp(server->name());
    expect_exchange(*server, client);
    ::close(client);
    EXPECT_NE(ByteServer::open(server->name()).error, "") << "the port is taken";
}

TEST_F(ByteServerTest, WhatIsNoEndpointIsNamed) {
    for (const char* wrong :
         {"", "pty", "pty:", "serial:/dev/x", "tcp:127.0.0.1", "tcp:127.0.0.1:", "tcp:1.2.3:5",
          "tcp:127.0.0.1:65536", "tcp:127.0.0.1:12x", "tcp:host:80", "tcp:0.0.0.0:9000", "/dev/ttyS0"}) {
        const auto opened = ByteServer::open(wrong);
        EXPECT_EQ(opened.server, nullptr) << wrong;
        EXPECT_NE(opened.error.find(wrong), std::string::npos) << opened.error;
        EXPECT_EQ(opened.error.find('\n'), std::string::npos) << opened.error;
    }
    EXPECT_NE(ByteServer::open("unix:" + std::string(200, 'x')).error, "");
}

TEST_F(ByteServerTest, ASocketIsItsOwnersAndItsGroupsUnlessItsSettingsSayElse) {
    const ::mode_t before = ::umask(0);
    const auto mode_of = [&] { return fs::status(path("socket")).permissions(); };
    {
        const auto server = open("unix:" + path("socket"));
        EXPECT_EQ(mode_of(), fs::perms(0660));
    }
    ::umask(077);
    {
        const auto opened = ByteServer::open("unix:" + path("socket"), {.mode = 0666});
        EXPECT_EQ(mode_of(), fs::perms(0666));
    }
    ::umask(before);
    const auto nobody = ByteServer::open("unix:" + path("socket"), {.group = "no such group"});
    EXPECT_EQ(nobody.server, nullptr);
    EXPECT_NE(nobody.error.find("no such group"), std::string::npos) << nobody.error;
    EXPECT_FALSE(fs::exists(path("socket")));
}

TEST_F(ByteServerTest, NothingOfARequestOfABrowserIsReadFromTcp) {
    const auto server = open("tcp:127.0.0.1:0");
    const std::string message("\x50\x50\x50\x80\x7F\x10\xEF\xAA\xAA", 9);
    for (const std::string& opening :
         {std::string("POST / HTTP/1.1\r\n\r\n"), std::string("PPP / HTTP/1.1\r\n\r\n"),
          std::string("OPTIONS * HTTP/1.1\r\n\r\n"), std::string("\x16\x03\x01\x02\x00", 5)}) {
        const int client = connect_tcp(server->name());
        EXPECT_TRUE(server->has_client());
        write_to(client, opening + message);
        EXPECT_EQ(received(*server), "") << opening;
        EXPECT_FALSE(server->has_client());
        ::close(client);
    }
}

TEST_F(ByteServerTest, WhatADeviceIsSentFirstIsReadFromTcp) {
    const auto server = open("tcp:127.0.0.1:0");
    for (const std::string& opening :
         {std::string("\x50\x50\x50 \xDF\x10\xEF\xAA\xAA"), std::string("\xE0\x60"),
          std::string("\x02 0140200"), std::string("RRRRRR\x80\x7F\x30\xCF"), std::string("RRRRRR \xDF"),
          std::string("\x16\x80\x7F"), std::string("\x16\x03\x52")}) {
        const int client = connect_tcp(server->name());
        EXPECT_TRUE(server->has_client());
        write_to(client, opening);
        EXPECT_EQ(received(*server), opening);
        ::close(client);
        EXPECT_EQ(received(*server), "");
    }
}

}  // namespace
}  // namespace nplc::hal_linux
