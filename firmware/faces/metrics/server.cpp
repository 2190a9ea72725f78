#include "metrics/server.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "hal_linux/quiet_thread.h"
#include "hal_linux/steady_clock.h"
#include "hal_linux/tcp_listener.h"
#include "hal_linux/wakeup.h"
#include "http_client.h"
#include "metrics/exposition.h"

namespace nplc::metrics {
namespace {

constexpr std::size_t kMostClients = 16;
/// Longest scrape interval for keeping values up to date.
constexpr base::Milliseconds kInterest{60'000};
constexpr base::Milliseconds kBetweenWants = faces::AxisModel::kInterest / 2;
/// If the image is older than this, a new one is requested before the answer.
constexpr base::Milliseconds kFresh{100};
constexpr base::Milliseconds kImageWait{200};
constexpr base::Milliseconds kLook{5};

/// In the form of the other faces, or without "tcp:".
std::string place_of(const std::string& listen) {
    return listen.starts_with("tcp:") ? listen : "tcp:" + listen;
}

}  // namespace

std::string Server::mistake_in(const std::string& listen) {
    if (hal_linux::TcpListener::mistake_in(place_of(listen)).empty()) return {};
    return "is no address with a port; write such as \"127.0.0.1:9464\" or \"[::]:9464\"";
}

/// The thread's main loop.
class Server::Loop {
  public:
    Loop(Options options, const faces::Axes& axes) : options_(std::move(options)), axes_(axes) {}
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    std::string listen() { return listener_.open(place_of(options_.listen)); }
    const std::string& name() const { return listener_.name(); }
    void run();
    void end() {
        ends_ = true;
        wakeup_.ring();
    }

  private:
    void wait();
    void want(base::Instant now);
    void serve(base::Instant now);
    void answer(base::Instant now);
    void accept_one();
    bool is_fresh(base::Instant now) const;

    Options options_;
    faces::Axes axes_;
    hal_linux::SteadyClock clock_;
    hal_linux::Wakeup wakeup_;
    hal_linux::TcpListener listener_;
    std::vector<std::unique_ptr<HttpClient>> clients_;
    std::vector<pollfd> polled_;
    base::Instant scraped_ = base::Instant{} - kInterest;
    base::Instant image_asked_{};
    bool asks_image_ = false;
    std::atomic<bool> ends_{false};
};

void Server::Loop::wait() {
    polled_.clear();
    polled_.push_back({.fd = wakeup_.descriptor(), .events = POLLIN, .revents = 0});
    polled_.push_back({.fd = listener_.descriptor(), .events = POLLIN, .revents = 0});
    const base::Instant now = clock_.now();
    base::Instant until = base::kNever;
    for (const auto& client : clients_) {
        polled_.push_back({.fd = client->descriptor(), .events = client->events(), .revents = 0});
        until = std::min(until, client->ends() + kLook);
    }
    if (asks_image_) until = now + kLook;
    if (now < scraped_ + kInterest) until = std::min(until, now + kBetweenWants);
    const auto left = std::chrono::duration_cast<base::Milliseconds>(until - now).count();
    ::poll(polled_.data(), polled_.size(),
           until == base::kNever ? -1 : static_cast<int>(std::max<std::int64_t>(left, 0)));
}

void Server::Loop::run() {
    while (!ends_) {
        wait();
        if ((polled_[0].revents & POLLIN) != 0) wakeup_.drain();
        const base::Instant now = clock_.now();
        serve(now);
        answer(now);
        if (now < scraped_ + kInterest) want(now);
        std::erase_if(clients_, [](const auto& client) { return client->is_gone(); });
        if ((polled_[1].revents & POLLIN) != 0) accept_one();
    }
}

void Server::Loop::want(base::Instant now) {
    for (faces::AxisModel* axis : axes_) axis->want(now);
}

void Server::Loop::serve(base::Instant now) {
    for (std::size_t i = 0; i < clients_.size(); ++i)
        clients_[i]->serve(i + 2 < polled_.size() ? polled_[i + 2].revents : short{0}, now);
}

bool Server::Loop::is_fresh(base::Instant now) const {
    return std::all_of(axes_.begin(), axes_.end(),
                       [now](faces::AxisModel* axis) { return now - axis->image(now).taken <= kFresh; });
}

/// One text for all waiting clients.
void Server::Loop::answer(base::Instant now) {
    const bool is_wanted = std::any_of(clients_.begin(), clients_.end(),
                                       [](const auto& client) { return client->wants_metrics(); });
    const bool was_asked = std::exchange(asks_image_, false);
    if (!is_wanted) return;
    scraped_ = now;
    if (!was_asked) image_asked_ = now;
    asks_image_ = !is_fresh(now) && now - image_asked_ < kImageWait;
    if (asks_image_) return;
    const std::string text = exposition(axes_, options_.program, now);
    for (const auto& client : clients_) {
        if (client->wants_metrics()) client->answer(text);
    }
}

/// A client beyond the limit replaces the oldest one.
void Server::Loop::accept_one() {
    const int descriptor = listener_.accept().descriptor;
    if (descriptor < 0) return;
    if (clients_.size() >= kMostClients) clients_.erase(clients_.begin());
    clients_.push_back(std::make_unique<HttpClient>(descriptor, clock_.now()));
}

Server::Server() = default;

Server::Opened Server::open(const Options& options, const faces::Axes& axes) {
    std::unique_ptr<Server> server(new Server);
    server->loop_ = std::make_unique<Loop>(options, axes);
    if (std::string error = server->loop_->listen(); !error.empty()) return {nullptr, error};
    server->url_ = "http://" + server->loop_->name().substr(4) + "/metrics";
    server->thread_ = hal_linux::start_quiet_thread([loop = server->loop_.get()] { loop->run(); });
    return {std::move(server), {}};
}

Server::~Server() {
    if (!thread_.joinable()) return;
    loop_->end();
    thread_.join();
}

}  // namespace nplc::metrics
