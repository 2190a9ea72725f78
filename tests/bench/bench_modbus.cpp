// From a request to its answer over TCP: two Modbus servers in turn, a block of requests each, so that what
// else the machine does hits both. `serve` is libmodbus's own bare server, which has a table of numbers and
// nothing else.
#include <arpa/inet.h>
#include <modbus/modbus.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRounds = 200;
constexpr int kBlock = 100;
constexpr std::uint16_t kWords = 45;

int serve(const char* port) {
    modbus_t* const context = modbus_new_tcp("127.0.0.1", std::atoi(port));
    modbus_mapping_t* const map = modbus_mapping_new(16, 16, 64, 64);
    int listener = modbus_tcp_listen(context, 1);
    if (map == nullptr || listener < 0) return 1;
    std::puts("ready");
    std::fflush(stdout);
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
    while (modbus_tcp_accept(context, &listener) >= 0) {
        for (;;) {
            const int size = modbus_receive(context, query.data());
            if (size < 0) break;
            if (size > 0) modbus_reply(context, query.data(), size, map);
        }
        modbus_close(context);
    }
    return 0;
}

class Client {
  public:
    explicit Client(const char* port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(std::atoi(port)));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        const int on = 1;
        ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        is_open_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
    }
    ~Client() { ::close(socket_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    bool is_open() const { return is_open_; }
    /// Input registers 0..44, as a PLC reads the status; false: no answer, or a refusal.
    bool ask() {
        constexpr std::array<std::uint8_t, 12> kRequest{0, 1, 0, 0, 0, 6, 1, 4, 0, 0, 0, kWords};
        constexpr std::size_t kAnswer = 9 + 2 * kWords;
        const auto begun = Clock::now();
        if (::send(socket_, kRequest.data(), kRequest.size(), 0) != static_cast<ssize_t>(kRequest.size()))
            return false;
        std::array<std::uint8_t, 260> answer{};
        std::size_t have = 0;
        while (have < kAnswer) {
            const ssize_t got = ::recv(socket_, &answer[have], answer.size() - have, 0);
            if (got <= 0 || (have == 0 && got >= 8 && answer[7] != 4)) return false;
            have += static_cast<std::size_t>(got);
        }
        times_.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begun).count());
        return true;
    }
    double at(double part) {
        std::sort(times_.begin(), times_.end());
        return times_[static_cast<std::size_t>(part * static_cast<double>(times_.size() - 1))];
    }
    void forget() { times_.clear(); }

  private:
    int socket_;
    bool is_open_ = false;
    std::vector<double> times_;
};

int measure(const char* ours, const char* bare) {
    Client one(ours);
    Client two(bare);
    if (!one.is_open() || !two.is_open()) return 1;
    for (int i = 0; i < kBlock; ++i) {
        if (!one.ask() || !two.ask()) return 1;
    }
    one.forget();
    two.forget();
    for (int round = 0; round < kRounds; ++round) {
        for (Client* client : {&one, &two}) {
            for (int i = 0; i < kBlock; ++i) {
                if (!client->ask()) return 1;
            }
        }
    }
    constexpr double kMedian = 0.5;
    constexpr double k99 = 0.99;
    std::printf("%-22s median %6.1f us, 99th percentile %6.1f us\n", "nanoplc", one.at(kMedian), one.at(k99));
    std::printf("%-22s median %6.1f us, 99th percentile %6.1f us\n", "libmodbus's bare server",
                two.at(kMedian), two.at(k99));
    std::printf("ratio of medians %.2f, of 99th percentiles %.2f\n", one.at(kMedian) / two.at(kMedian),
                one.at(k99) / two.at(k99));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string_view(argv[1]) == "serve") return serve(argv[2]);
    if (argc == 4 && std::string_view(argv[1]) == "measure") return measure(argv[2], argv[3]);
    std::fputs("usage: bench_modbus serve PORT | measure PORT PORT\n", stderr);
    return 2;
}
