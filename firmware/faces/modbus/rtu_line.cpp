#include "rtu_line.h"

#include <array>
#include <utility>

#include "hal_linux/byte_server.h"
#include "hal_linux/uart.h"

namespace nplc::modbus {
namespace {

class UartLine final : public RtuLine {
  public:
    explicit UartLine(std::unique_ptr<hal_linux::Uart> uart) : uart_(std::move(uart)) {}
    int descriptor() override { return uart_->descriptor(); }
    std::size_t read(std::span<ports::ReceivedByte> out) override { return uart_->read(out); }
    std::size_t write(std::span<const std::uint8_t> bytes) override { return uart_->write(bytes); }
    void look() override {
        if (uart_->gone()) static_cast<void>(uart_->reopen());
    }

  private:
    std::unique_ptr<hal_linux::Uart> uart_;
};

class PtyLine final : public RtuLine {
  public:
    explicit PtyLine(std::unique_ptr<hal_linux::ByteServer> server) : server_(std::move(server)) {}
    int descriptor() override { return server_->has_client() ? server_->descriptor() : -1; }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        std::array<std::uint8_t, 256> bytes{};
        const std::size_t count = server_->read(std::span(bytes).first(std::min(bytes.size(), out.size())));
        for (std::size_t i = 0; i < count; ++i) out[i] = {bytes[i], false};
        return count;
    }
    std::size_t write(std::span<const std::uint8_t> bytes) override {
        server_->write(bytes);
        return bytes.size();
    }
    void look() override {}

  private:
    std::unique_ptr<hal_linux::ByteServer> server_;
};

}  // namespace

RtuLine::Opened RtuLine::open(const RtuServer::Options& options) {
    if (options.port.starts_with("pty:")) {
        auto opened = hal_linux::ByteServer::open(options.port, {.at_once = true});
        if (!opened.server) return {nullptr, opened.error};
        return {std::make_unique<PtyLine>(std::move(opened.server)), {}};
    }
    auto opened = hal_linux::Uart::open({.path = options.port,
                                         .baud = options.baud,
                                         .rs485 = options.rs485,
                                         .parity = options.parity,
                                         .two_stop_bits = options.parity == hal_linux::Parity::none});
    if (!opened.uart) return {nullptr, opened.error};
    return {std::make_unique<UartLine>(std::move(opened.uart)), {}};
}

}  // namespace nplc::modbus
