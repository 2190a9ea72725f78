#include <windows.h>

#include <algorithm>
#include <memory>

#include "clients.h"
#include "handle.h"
#include "host/clock.h"
#include "text.h"

namespace nplc::hal_windows {
namespace {

constexpr DWORD kWriteWaitMs = 1000;

class ComClient final : public host::ByteClient {
  public:
    ComClient(Handle handle, const std::string& name, const DCB& before)
        : handle_(std::move(handle)), name_(name), before_(before) {
        set_patience(base::Microseconds{0});
    }
    ~ComClient() override { ::SetCommState(handle_.get(), &before_); }

    const std::string& name() const override { return name_; }

    bool write(std::span<const std::uint8_t> bytes) override {
        while (!bytes.empty()) {
            DWORD taken = 0;
            const bool written =
                ::WriteFile(handle_.get(), bytes.data(), static_cast<DWORD>(bytes.size()), &taken, nullptr);
            if (!written || taken == 0) return false;
            bytes = bytes.subspan(taken);
        }
        return true;
    }

    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        if (!set_patience(wait)) return std::nullopt;
        DWORD got = 0;
        if (!::ReadFile(handle_.get(), out.data(), static_cast<DWORD>(out.size()), &got, nullptr))
            return std::nullopt;
        return got;
    }

    base::Instant now() const override { return host::steady_now(); }

  private:
    /// A read ends with the first byte or after `wait`, in whole milliseconds.
    bool set_patience(base::Microseconds wait) {
        const std::int64_t wanted = wait.count() <= 0 ? 0 : (wait.count() + 999) / 1000;
        const auto milliseconds = static_cast<DWORD>(std::min<std::int64_t>(wanted, 60'000));
        if (patience_ == milliseconds) return true;
        COMMTIMEOUTS limits{};
        limits.ReadIntervalTimeout = MAXDWORD;
        limits.ReadTotalTimeoutMultiplier = milliseconds > 0 ? MAXDWORD : 0;
        limits.ReadTotalTimeoutConstant = milliseconds;
        limits.WriteTotalTimeoutConstant = kWriteWaitMs;
        if (!::SetCommTimeouts(handle_.get(), &limits)) return false;
        patience_ = milliseconds;
        return true;
    }

    Handle handle_;
    std::string name_;
    DCB before_;
    DWORD patience_ = MAXDWORD;  ///< not set yet
};

std::string cannot_open(const std::string& port, DWORD reason) {
    switch (reason) {
        case ERROR_ACCESS_DENIED:
        case ERROR_SHARING_VIOLATION:
            return port + ": another program holds this port; end it first";
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
            return port + ": there is no such port; is the device connected? The device manager lists them";
        default:
            return port + ": cannot be opened: " + error_text(reason);
    }
}

/// 8 data bits, no parity, 1 stop bit, no handshake; the control lines that supply some adapters are on.
DCB raw_mode(DCB mode, std::uint32_t baud) {
    mode.BaudRate = baud;
    mode.ByteSize = 8;
    mode.Parity = NOPARITY;
    mode.StopBits = ONESTOPBIT;
    mode.fBinary = TRUE;
    mode.fParity = FALSE;
    mode.fOutxCtsFlow = FALSE;
    mode.fOutxDsrFlow = FALSE;
    mode.fDsrSensitivity = FALSE;
    mode.fDtrControl = DTR_CONTROL_ENABLE;
    mode.fRtsControl = RTS_CONTROL_ENABLE;
    mode.fOutX = FALSE;
    mode.fInX = FALSE;
    mode.fErrorChar = FALSE;
    mode.fNull = FALSE;
    mode.fAbortOnError = FALSE;
    return mode;
}

}  // namespace

host::ByteClient::Opened open_com_client(const std::string& port, std::uint32_t baud) {
    Handle handle(::CreateFileW(wide("\\\\.\\" + port).c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr,
                                OPEN_EXISTING, 0, nullptr));
    if (!handle) return {nullptr, cannot_open(port, ::GetLastError())};
    DCB before{};
    before.DCBlength = sizeof before;
    if (!::GetCommState(handle.get(), &before)) return {nullptr, port + ": this is not a serial line"};
    DCB mode = raw_mode(before, baud);
    if (!::SetCommState(handle.get(), &mode))
        return {
            nullptr,
            port + ": cannot be set to " + std::to_string(baud) + " baud: " + error_text(::GetLastError()),
            true};
    ::PurgeComm(handle.get(), PURGE_RXCLEAR | PURGE_TXCLEAR);
    return {std::make_unique<ComClient>(std::move(handle), port, before), {}};
}

}  // namespace nplc::hal_windows
