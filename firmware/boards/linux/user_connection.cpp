#include "user_connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/endpoint.h"
#include "registers/gateway.h"
#include "seat/secret.h"
#include "user_line.h"

namespace nplc::boards {
namespace {

constexpr base::Milliseconds kBetweenWarnings{10'000};

}  // namespace

std::string UserConnection::open(const AxisConfig& config, std::uint32_t stored_baud, bool at_once,
                                 faces::Seat& operators) {
    if (!config.user_port.is_there()) return {};
    std::string error;
    if (!is_endpoint(config.user_port.text)) {
        server_.reset();
        error = open_serial_port(config, stored_baud);
        if (!error.empty()) {
            uart_.reset();
            return error;
        }
        server_.emplace().serve(std::make_unique<UserLine>(uart_->uart(), config.user_port.text), &operators,
                                {});
        return {};
    }
    if (server_) return {};
    error = open_server(config, at_once, operators);
    if (!error.empty()) server_.reset();
    return error;
}

/// If the password cannot be read the server is not started: it would be open to everyone.
std::string UserConnection::open_server(const AxisConfig& config, bool at_once, faces::Seat& operators) {
    faces::Secret password;
    if (config.password_file.is_there())
        password = faces::read_secret(config.password_file.text, registers::gateway::kMostPassword);
    if (!password.error.empty()) return "no user's port: " + password.error;
    is_terminal_ = host::Endpoint(config.user_port.text).kind == host::Endpoint::Kind::pty;
    return server_.emplace().open(
        config.user_port.text,
        {.mode = config.socket_mode, .group = config.socket_group.text, .at_once = at_once}, &operators,
        password.text);
}

/// Falls back to the configured baud rate so that the setting can be corrected.
std::string UserConnection::open_serial_port(const AxisConfig& config, std::uint32_t stored_baud) {
    const std::uint32_t configured = config.settings.get(store::Setting::user_baud);
    const std::string& path = config.user_port.text;
    std::string error = uart_.emplace().open({.path = path, .baud = stored_baud});
    if (error.empty() || stored_baud == configured) return error;
    if (!uart_->open({.path = path, .baud = configured}).empty()) return error;
    journal_.write(
        LogLevel::warning, JournalEvent::setting_unused,
        fmt::format("{}; the configuration's {} baud are used: set user_baud anew", error, configured));
    return {};
}

void UserConnection::start() {
    readable_ = true;
    server_due_ = {};
    if (server_) server_->restarted();
}

void UserConnection::watch_server(hal_linux::EventLoop& loop, std::uint32_t mark) {
    using Wakes = hal_linux::EventLoop::Wakes;
    if (server_ && !uart_)
        loop.watch(server_->descriptor(), mark, is_terminal_ ? Wakes::at_news : Wakes::while_readable);
}

void UserConnection::watch_serial_port(hal_linux::EventLoop& loop, std::uint32_t mark) {
    if (uart_) loop.watch(uart_->uart().descriptor(), mark);
}

void UserConnection::look(gateway::Controller& controller, const Listener::Addresses& addresses,
                          base::Instant now) {
    const bool has_news = std::exchange(readable_, false) || uart_;
    if (server_ && (has_news || server_due_ <= now)) server_->bring(controller, addresses, now);
}

void UserConnection::answer(gateway::Controller& controller, base::Instant now) {
    if (!server_) return;
    server_->take_back(controller, now);
    server_due_ = server_->next(now);
    tell_unwanted(now);
}

void UserConnection::tell_unwanted(base::Instant now) {
    if (now < tell_again_) return;
    const auto tell = [&](unsigned count, unsigned& told, const char* what) {
        if (count == told) return;
        journal_.write(LogLevel::warning, JournalEvent::client_refused,
                       fmt::format("{}: {}, {} times since the start", server_->name(), what, count));
        told = count;
        tell_again_ = now + kBetweenWarnings;
    };
    tell(server_->wrong_passwords(), told_wrong_passwords_, "a wrong password was given");
    tell(server_->turned_away(), told_turned_away_,
         "a client that began as a browser does (HTTP or TLS) was turned away");
}

bool UserConnection::look_for_serial_port(base::Instant now) {
    return uart_ && uart_->look(journal_, now);
}

base::Instant UserConnection::next_look() const {
    const base::Instant next = server_ ? server_due_ : base::kNever;
    return uart_ ? std::min(next, uart_->next_look()) : next;
}

}  // namespace nplc::boards
