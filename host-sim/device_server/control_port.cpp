#include "sim/control_port.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "host/terminal.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kClients = 8;
constexpr std::size_t kLongestLine = 1000;
constexpr std::size_t kAtOnce = 4096;

}  // namespace

std::string ControlPort::open(const std::string& endpoint) {
    if (endpoint.empty()) return {};
    is_console_ = endpoint == "-";
    clients_.resize(is_console_ ? 1 : kClients);
    if (is_console_) return {};
    auto opened = hal_linux::ByteServer::open(endpoint, {.seats = kClients});
    server_ = std::move(opened.server);
    if (server_) clients_.resize(server_->seats());
    return opened.error;
}

std::string ControlPort::described() const {
    return server_ == nullptr ? std::string{} : fmt::format("control: {}\n", server_->name());
}

void ControlPort::serve(const CarryOut& carry_out) {
    if (is_console_) return read_console(carry_out);
    if (server_ == nullptr) return;
    static_cast<void>(server_->has_client());  // lets them in
    for (std::size_t seat = 0; seat < clients_.size(); ++seat) {
        if (const auto visit = server_->visit(seat); visit != clients_[seat].visit)
            clients_[seat] = {.visit = visit};
        std::array<std::uint8_t, kAtOnce> bytes{};
        const std::size_t count = server_->read_seat(seat, bytes);
        const std::string text(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
        take(seat, text, carry_out);
    }
}

/// Its end is no end of the program: `macsim --control - < bench.txt` serves on.
void ControlPort::read_console(const CarryOut& carry_out) {
    if (console_ended_ || !host::input_within(base::Milliseconds{0})) return;
    std::array<char, kAtOnce> bytes{};
    const std::size_t count = host::read_input(bytes);
    console_ended_ = count == 0;
    take(0, console_ended_ ? std::string_view("\n") : std::string_view(bytes.data(), count), carry_out);
}

void ControlPort::take(std::size_t seat, std::string_view bytes, const CarryOut& carry_out) {
    Client& client = clients_[seat];
    for (const char c : bytes) {
        if (c != '\n') {
            client.too_long = client.too_long || client.line.size() == kLongestLine;
            if (!client.too_long) client.line += c;
            continue;
        }
        const std::string_view line = trim(std::string_view(client.line).substr(0, client.line.find('#')));
        if (client.too_long)
            answer(seat, {false, fmt::format("a line has {} characters at the most", kLongestLine)});
        else if (!line.empty())
            answer(seat, carry_out(line));
        client.line.clear();
        client.too_long = false;
    }
}

void ControlPort::answer(std::size_t seat, const Answer& answer) {
    const std::string text = fmt::format(
        "{}{}\n", answer.done ? "" : "error: ", answer.done && answer.text.empty() ? "ok" : answer.text);
    if (!is_console_) {
        server_->write_seat(seat, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
        return;
    }
    fmt::print("{}", text);
    std::fflush(stdout);
}

}  // namespace nplc::sim
