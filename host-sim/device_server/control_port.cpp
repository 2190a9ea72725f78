#include "sim/control_port.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "host/terminal.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kClients = 8;
constexpr std::size_t kLongestLine = 1000;
constexpr std::size_t kAtOnce = 4096;
constexpr hal_linux::Connections::Id kConsole = 0;  ///< no connection has this number
using State = hal_linux::Connections::State;

}  // namespace

std::string ControlPort::open(const std::string& endpoint) {
    if (endpoint.empty()) return {};
    is_console_ = endpoint == "-";
    if (is_console_) return {};
    auto opened = hal_linux::Connections::open(endpoint, {});
    connections_ = std::move(opened.connections);
    return opened.error;
}

std::string ControlPort::described() const {
    return connections_ == nullptr ? std::string{} : fmt::format("control: {}\n", connections_->name());
}

void ControlPort::serve(const CarryOut& carry_out) {
    if (is_console_) return read_console(carry_out);
    if (connections_ == nullptr) return;
    let_in();
    for (const Id id : connections_->with_news()) {
        std::array<std::uint8_t, kAtOnce> bytes{};
        const auto got = connections_->read(id, bytes);
        const std::string text(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(got.count));
        take(id, text, carry_out);
        const bool has_ended = got.state == State::gone || (got.state == State::hears && got.count == 0);
        if (!has_ended && !clients_[id].has_gone) continue;
        connections_->close(id);
        clients_.erase(id);
    }
}

void ControlPort::let_in() {
    while (const auto id = connections_->accept()) {
        clients_[*id].heard = ++lines_;
        if (clients_.size() <= kClients) continue;
        const auto oldest =
            std::min_element(clients_.begin(), clients_.end(),
                             [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; });
        connections_->close(oldest->first);
        clients_.erase(oldest);
    }
}

/// The end of the input does not end the program: `macsim --control - < bench.txt` keeps serving.
void ControlPort::read_console(const CarryOut& carry_out) {
    if (console_ended_ || !host::input_within(base::Milliseconds{0})) return;
    std::array<char, kAtOnce> bytes{};
    const std::size_t count = host::read_input(bytes);
    console_ended_ = count == 0;
    take(kConsole, console_ended_ ? std::string_view("\n") : std::string_view(bytes.data(), count),
         carry_out);
}

void ControlPort::take(Id id, std::string_view bytes, const CarryOut& carry_out) {
    Client& client = clients_[id];
    for (const char c : bytes) {
        if (c != '\n') {
            client.too_long = client.too_long || client.line.size() == kLongestLine;
            if (!client.too_long) client.line += c;
            continue;
        }
        const std::string_view line = trim(std::string_view(client.line).substr(0, client.line.find('#')));
        if (client.too_long)
            answer(id, {false, fmt::format("a line has {} characters at the most", kLongestLine)});
        else if (!line.empty())
            answer(id, carry_out(line));
        client.heard = ++lines_;
        client.line.clear();
        client.too_long = false;
    }
}

void ControlPort::answer(Id id, const Answer& answer) {
    const std::string text = fmt::format(
        "{}{}\n", answer.done ? "" : "error: ", answer.done && answer.text.empty() ? "ok" : answer.text);
    if (!is_console_) {
        const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
        clients_[id].has_gone = !connections_->write(id, bytes);
        return;
    }
    fmt::print("{}", text);
    std::fflush(stdout);
}

}  // namespace nplc::sim
