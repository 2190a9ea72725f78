#include "panel/panel.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <sys/random.h>

#include "files.h"
#include "hal_linux/steady_clock.h"
#include "hub.h"
#include "origin.h"

namespace nplc::panel {
namespace {

constexpr std::size_t kStackBytes = std::size_t{256} * 1024;

std::string refusal(const PanelOptions& options) {
    if (is_loopback(options.web.address)) return {};
    if (options.password.empty() || options.token.empty())
        return fmt::format(
            "the panel at {} could be reached from other machines: configure a password and a token first, "
            "or "
            "listen at 127.0.0.1 and put a TLS proxy before it",
            options.web.address);
    return {};
}

}  // namespace

std::string make_token() {
    constexpr std::string_view kCharacters =
        "abcdefghijkmnpqrstuvwxyz23456789";  // 32 characters that are not confused
    std::array<unsigned char, 24> chance{};
    if (::getrandom(chance.data(), chance.size(), 0) != static_cast<ssize_t>(chance.size())) return {};
    std::string token;
    for (const unsigned char byte : chance) token += kCharacters[byte % kCharacters.size()];
    return token;
}

struct Panel::Parts {
    Parts(const PanelOptions& wanted, const std::vector<PanelAxis>& axes, SymbolShelf* symbols,
          Simulation* simulation)
        : options(wanted), hub(options, axes, symbols, simulation, clock) {}

    static void* run(void* parts) {
        static_cast<Parts*>(parts)->server->run();
        return nullptr;
    }

    PanelOptions options;
    hal_linux::SteadyClock clock;
    Hub hub;
    std::unique_ptr<WebServer> server;
    pthread_t thread{};
    bool runs = false;
};

Panel::Panel(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Panel::~Panel() {
    if (!parts_->runs) return;
    parts_->server->stop();
    ::pthread_join(parts_->thread, nullptr);
}

Panel::Opened Panel::open(const PanelOptions& options, const std::vector<PanelAxis>& axes,
                          SymbolShelf* symbols, Simulation* simulation) {
    if (std::string error = refusal(options); !error.empty()) return {nullptr, std::move(error)};
    PanelOptions complete = options;
    if (complete.token.empty()) complete.token = make_token();
    if (complete.token.empty()) return {nullptr, "the system gives no random numbers for a token"};
    auto parts = std::make_unique<Parts>(complete, axes, symbols, simulation);
    auto opened = WebServer::open(complete.web, page_files(), parts->hub);
    if (!opened.server) return {nullptr, std::move(opened.error)};
    parts->server = std::move(opened.server);
    parts->hub.serve(*parts->server);
    return {std::unique_ptr<Panel>(new Panel(std::move(parts))), {}};
}

/// An ordinary thread, whatever priority the loop has. Signals are handled by the main thread.
void Panel::start() {
    pthread_attr_t attributes;
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, kStackBytes);
    ::pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
    ::pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
    const sched_param normal{};
    ::pthread_attr_setschedparam(&attributes, &normal);
    sigset_t all;
    sigset_t before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    parts_->runs = ::pthread_create(&parts_->thread, &attributes, &Parts::run, parts_.get()) == 0;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ::pthread_attr_destroy(&attributes);
}

std::string Panel::url() const {
    const std::string& address = parts_->options.web.address;
    const bool is_v6 = address.find(':') != std::string::npos;
    return fmt::format("http://{}{}{}:{}/", is_v6 ? "[" : "", address, is_v6 ? "]" : "",
                       parts_->server->port());
}

const std::string& Panel::token() const {
    return parts_->options.token;
}

}  // namespace nplc::panel
