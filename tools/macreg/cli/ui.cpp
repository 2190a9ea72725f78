#include "macreg/ui.h"

#include <fmt/format.h>

#include <stdexcept>

#include "cli/session.h"
#include "registers/gateway.h"

namespace nplc::macreg::cli {
namespace {

constexpr std::uint8_t kGateway = registers::gateway::kDefaultAddress;

host::ByteClient::Opened reopen(const Common& common) {
    try {
        return {command_line::open_with_password(common, kGateway), {}};
    } catch (const mactalk_client::Ended& error) {
        return {nullptr, error.what()};
    }
}

void ui(Common& common) {
    if (common.json) throw UserError("ui has no --json; see get, set and watch");
    UiOptions options;
    {
        // Finds the motors; the screen then opens the port itself
        Session session(common);
        options.address = session.motor().address();
        options.model = session.motor().model();
        options.model_name = session.model_name();
    }
    constexpr unsigned kAttempts = 2;  // a waiting user presses the key again
    options.line = {
        .baud = common.baud, .patience = base::Milliseconds{common.patience_ms}, .attempts = kAttempts};
    options.title = fmt::format("macreg {} {} at {}", options.model_name, options.address, common.port);
    options.reopen = [&] { return reopen(common); };
    try {
        run_ui(command_line::open_with_password(common, kGateway), options);
    } catch (const mactalk_client::LineError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw UserError(error.what());
    }
}

}  // namespace

void add_ui(arguments::App& app, Common& common) {
    add_command(app, common, "ui", "The full screen: parameters, bits, samples, the line's bytes", ui);
}

}  // namespace nplc::macreg::cli
