// The client on real pseudo-terminals and sockets, a virtual motor behind them.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "hal_linux/byte_server.h"
#include "mactalk_client/master.h"
#include "sim/mac_motor.h"

namespace nplc::mactalk_client {
namespace {

namespace fs = std::filesystem;

/// Serves one motor with address 8 until it is destroyed.
class Server {
  public:
    explicit Server(const std::string& endpoint) : server_(hal_linux::ByteServer::open(endpoint).server) {
        thread_ = std::thread([this] { serve(); });
    }
    ~Server() {
        ended_ = true;
        thread_.join();
    }
    std::string name() const { return server_->name(); }

  private:
    void serve() {
        sim::MacMotor motor(registers::Model::mac140, {.address = 8});
        std::array<std::uint8_t, 256> bytes{};
        while (!ended_) {
            pollfd state{.fd = server_->descriptor(), .events = POLLIN, .revents = 0};
            ::poll(&state, 1, 1);
            const std::size_t count = server_->read(bytes);
            std::vector<std::uint8_t> answer;
            for (std::size_t i = 0; i < count; ++i) {
                motor.receive_mactalk(bytes[i], false);
                while (const auto byte = motor.transmit_mactalk()) answer.push_back(*byte);
            }
            if (!answer.empty()) server_->write(answer);
        }
    }

    std::unique_ptr<hal_linux::ByteServer> server_;
    std::atomic<bool> ended_{false};
    std::thread thread_;
};

struct Endpoint : testing::Test {
    Endpoint() {
        std::string folder = fs::temp_directory_path() / "mactalk_client_XXXXXX";
        folder_ = ::mkdtemp(folder.data());
    }
    ~Endpoint() override { fs::remove_all(folder_); }
    std::string path(const std::string& name) const { return folder_ / name; }

    static void expect_exchange(const std::string& endpoint) {
        const host::ByteClient::Opened opened = host::ByteClient::open(endpoint, 115'200);
        ASSERT_EQ(opened.error, "");
        Master master(*opened.client, {.patience = std::chrono::seconds{5}});
        // 0A 0D 11 13: what a terminal that is not raw would change.
        for (const std::uint32_t value : {600U, 0x0D0AU, 0x1113U, 0x0304U}) {
            master.write(8, 5, value, Width::word);
            EXPECT_EQ(master.read(8, 5) & 0xFFFF, value);
        }
        EXPECT_EQ(master.read_block(8, 5)[1], 0x03);
        EXPECT_EQ(master.counters().timeouts, 0U);
    }

    fs::path folder_;
};

TEST_F(Endpoint, PtyByItsNameAndByItsPath) {
    const Server server("pty:" + path("tty"));
    expect_exchange("pty:" + path("tty"));
    expect_exchange(path("tty"));
}

TEST_F(Endpoint, UnixSocket) {
    const Server server("unix:" + path("socket"));
    expect_exchange("unix:" + path("socket"));
}

TEST_F(Endpoint, TcpSocket) {
    const Server server("tcp:127.0.0.1:0");
    expect_exchange(server.name());
}

TEST_F(Endpoint, ASecondClientIsToldWhoHoldsThePort) {
    const Server server("pty:" + path("tty"));
    const host::ByteClient::Opened first = host::ByteClient::open(path("tty"), 19'200);
    ASSERT_EQ(first.error, "");
    const pid_t child = ::fork();
    if (child == 0) {
        const host::ByteClient::Opened second = host::ByteClient::open(path("tty"), 19'200);
        const std::string who = "(process " + std::to_string(::getppid()) + ") holds this port";
        ::_exit(second.client == nullptr && second.error.find(who) != std::string::npos ? 0 : 1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

TEST_F(Endpoint, AConnectionThatIsClosedIsSaid) {
    const Server server("unix:" + path("socket"));
    const host::ByteClient::Opened first = host::ByteClient::open("unix:" + path("socket"), 19'200);
    Master(*first.client, {.patience = std::chrono::seconds{5}}).read(8, 5);
    const host::ByteClient::Opened second = host::ByteClient::open("unix:" + path("socket"), 19'200);
    Master turned_away(*second.client, {.patience = std::chrono::seconds{5}});
    try {
        turned_away.read(8, 5);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_EQ(error.kind(), LineError::Kind::port_gone) << error.what();
        EXPECT_NE(std::string(error.what()).find("before anything came"), std::string::npos) << error.what();
    }
}

TEST_F(Endpoint, AServerThatEndsIsNotTakenForABusyOne) {
    auto server = std::make_unique<Server>("unix:" + path("socket"));
    const host::ByteClient::Opened opened = host::ByteClient::open("unix:" + path("socket"), 19'200);
    Master master(*opened.client, {.patience = std::chrono::seconds{5}});
    master.read(8, 5);
    server.reset();
    try {
        master.read(8, 5);
        FAIL();
    } catch (const LineError& error) {
        EXPECT_NE(std::string(error.what()).find("has its program ended?"), std::string::npos)
            << error.what();
    }
}

TEST_F(Endpoint, WhatCannotBeOpenedIsNamedWithWhatToDo) {
    const auto expect_error = [](const std::string& endpoint, std::uint32_t baud, const std::string& words,
                                 bool never = true) {
        const host::ByteClient::Opened opened = host::ByteClient::open(endpoint, baud);
        EXPECT_EQ(opened.never, never) << endpoint;
        EXPECT_EQ(opened.client, nullptr) << endpoint;
        EXPECT_NE(opened.error.find(words), std::string::npos) << opened.error;
        EXPECT_EQ(opened.error.find('\n'), std::string::npos) << opened.error;
    };
    expect_error(path("no_such"), 19'200, "there is no such port", false);
    expect_error("unix:" + path("no_such"), 19'200, "is the program running?", false);
    expect_error("tcp:127.0.0.1:1", 19'200, "nobody listens there", false);
    for (const char* wrong : {"tcp:127.0.0.1", "tcp::80", "tcp:127.0.0.1:99999", "tcp:127.0.0.1:65536",
                              "tcp:127.0.0.1:0", "tcp:127.0.0.1:-1", "tcp:127.0.0.1:80x",
                              "tcp:localhost:http", "tcp:192.0.2.1:80", "tcp:example.org:80"})
        expect_error(wrong, 19'200, "write tcp:127.0.0.1:PORT (this machine only), PORT 1..65535");
    expect_error("unix:" + std::string(200, 'x'), 19'200, "too long");
    expect_error("/dev/null", 19'200, "not a serial line", false);
    expect_error(path("tty"), 19'201, "no serial line has 19201 baud");
    for (const char* wrong : {"", "ttyUSB0", "pty:", "tcp:", "serial:/dev/x"})
        expect_error(wrong, 19'200, "write a serial line's path");
}

}  // namespace
}  // namespace nplc::mactalk_client
