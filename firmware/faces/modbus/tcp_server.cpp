#include "modbus/tcp_server.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>

#include "hal_linux/quiet_thread.h"
#include "hal_linux/steady_clock.h"
#include "hal_linux/tcp_listener.h"
#include "tcp_client.h"
#include "unit_set.h"

namespace nplc::modbus {
/// The thread's main loop.
class TcpServer::Loop {
  public:
    Loop(const Options& options, const faces::Axes& axes) : options_(options), set_(axes, options.settings) {}
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    /// Empty, or an error.
    std::string listen() {
        std::string error = listener_.open(options_.listen);
        if (error.empty()) set_.join(bell_);
        return error;
    }
    const std::string& name() const { return listener_.name(); }
    void run();
    void end() {
        ends_ = true;
        wakeup_.ring();
    }

  private:
    void wait();
    void accept_one();
    void make_room();

    Options options_;
    hal_linux::SteadyClock clock_;
    hal_linux::Wakeup wakeup_;
    faces::Bell bell_{[this] { wakeup_.ring(); }};
    UnitSet set_;
    std::vector<std::unique_ptr<TcpClient>> clients_;
    std::vector<pollfd> polled_;
    base::Instant nobody_at_ = clock_.now();  ///< last time when no client was connecting
    hal_linux::TcpListener listener_;
    std::atomic<bool> ends_{false};
};

void TcpServer::Loop::wait() {
    polled_.clear();
    polled_.push_back({.fd = wakeup_.descriptor(), .events = POLLIN, .revents = 0});
    polled_.push_back({.fd = listener_.descriptor(), .events = POLLIN, .revents = 0});
    const base::Instant now = clock_.now();
    base::Instant until = now + UnitSet::kTick;
    for (const auto& client : clients_) {
        polled_.push_back({.fd = client->descriptor(), .events = client->events(), .revents = 0});
        until = std::min(until, client->due(now));
    }
    const auto wait = std::max(until - now, base::Microseconds(0));
    timespec time{};
    time.tv_sec = static_cast<time_t>(wait.count() / 1'000'000);
    time.tv_nsec = static_cast<long>(wait.count() % 1'000'000 * 1'000);
    ::ppoll(polled_.data(), polled_.size(), &time, nullptr);
}

void TcpServer::Loop::run() {
    while (!ends_) {
        wait();
        if ((polled_[0].revents & POLLIN) != 0) wakeup_.drain();
        bell_.arm();
        const base::Instant now = clock_.now();
        for (std::size_t i = 0; i < clients_.size(); ++i) {
            const auto events = i + 2 < polled_.size() ? polled_[i + 2].revents : short{0};
            clients_[i]->serve(events, now);
        }
        std::erase_if(clients_, [](const auto& client) { return client->is_gone(); });
        set_.watch_masters(now);
        if ((polled_[1].revents & POLLIN) != 0)
            accept_one();
        else
            nobody_at_ = now;
    }
}

void TcpServer::Loop::make_room() {
    if (clients_.size() < options_.clients) return;
    const auto is_better = [](const auto& a, const auto& b) { return a->heard() < b->heard(); };
    std::vector<std::unique_ptr<TcpClient>*> others;
    for (auto& client : clients_) {
        if (!set_.has_master(client->number())) others.push_back(&client);
    }
    if (others.empty()) return;
    auto* silent =
        *std::min_element(others.begin(), others.end(), [&](auto* a, auto* b) { return is_better(*a, *b); });
    clients_.erase(clients_.begin() + (silent - clients_.data()));
}

void TcpServer::Loop::accept_one() {
    const auto [descriptor, peer] = listener_.accept();
    if (descriptor < 0) return;
    make_room();
    if (clients_.size() >= options_.clients) {
        ::close(descriptor);
        return;
    }
    clients_.push_back(std::make_unique<TcpClient>(descriptor, set_, "Modbus " + peer, bell_,
                                                   Moment{.now = clock_.now(), .arrived = nobody_at_}));
}

TcpServer::TcpServer() = default;

TcpServer::Opened TcpServer::open(const Options& options, const faces::Axes& axes) {
    std::unique_ptr<TcpServer> server(new TcpServer);
    server->loop_ = std::make_unique<Loop>(options, axes);
    if (std::string error = server->loop_->listen(); !error.empty()) return {nullptr, error};
    server->name_ = server->loop_->name();
    server->thread_ = hal_linux::start_quiet_thread([loop = server->loop_.get()] { loop->run(); });
    return {std::move(server), {}};
}

TcpServer::~TcpServer() {
    if (!thread_.joinable()) return;
    loop_->end();
    thread_.join();
}

}  // namespace nplc::modbus
