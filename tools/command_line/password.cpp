#include <fmt/format.h>

#include <vector>

#include "command_line/files.h"
#include "command_line/program.h"
#include "mactalk_client/master.h"
#include "registers/gateway.h"

namespace nplc::command_line {
namespace {

namespace gw = registers::gateway;
using mactalk_client::LineError;

constexpr unsigned kAttempts = 3;

/// As PASSWORD takes it.
std::vector<std::uint8_t> password_of(const std::string& file) {
    const std::string whole = read_text(file);
    std::string line = whole.substr(0, whole.find('\n'));
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.size() > gw::kMostPassword)
        throw UserError(
            fmt::format("--password-file {}: its first line must be a password of {} characters at the most",
                        file, gw::kMostPassword));
    line.resize(std::max(gw::kLeastPassword, (line.size() + 3) / 4 * 4), '\0');
    return {line.begin(), line.end()};
}

/// A motor without a gateway, and a gateway whose port asks for none, have nothing to give it to.
bool is_wanted(mactalk_client::Master& master, std::uint8_t gateway) {
    try {
        return master.read(gateway, gw::PASSWORD_STATE) ==
               static_cast<std::uint32_t>(gw::PasswordState::wanted);
    } catch (const LineError& error) {
        if (error.kind() != LineError::Kind::no_answer) throw;
        return false;
    }
}

void give(std::span<const std::uint8_t> password, const Common& common, std::uint8_t gateway,
          host::ByteClient& wire) {
    if (password.empty()) return;
    mactalk_client::Master master(
        wire,
        {.baud = common.baud, .patience = base::Milliseconds{common.patience_ms}, .attempts = kAttempts});
    for (unsigned i = 0; i < kAttempts && is_wanted(master, gateway); ++i) {
        if (master.try_write_long(gateway, gw::PASSWORD, password)) break;
        const auto result = static_cast<gw::Result>(master.read(gateway, gw::RESULT) & 0xFF);
        if (result == gw::Result::no_password)
            throw Failure(kRefused, fmt::format("{}: the password of {} is not this port's", wire.name(),
                                                common.password_file));
    }
}

}  // namespace

std::unique_ptr<host::ByteClient> open_with_password(const Common& common, std::uint8_t gateway,
                                                     host::ByteClient::Holding holding) {
    std::vector<std::uint8_t> password;
    if (!common.password_file.empty()) password = password_of(common.password_file);
    auto wire = open_port(common, holding);
    give(password, common, gateway, *wire);
    return wire;
}

void give_password(const Common& common, std::uint8_t gateway, host::ByteClient& wire) {
    if (!common.password_file.empty()) give(password_of(common.password_file), common, gateway, wire);
}
}  // namespace nplc::command_line
