#pragma once

#include <functional>
#include <memory>
#include <string>

#include "mactalk_client/master.h"
#include "registers/mac.h"

namespace nplc::macreg {

struct UiOptions {
    std::uint8_t address = 255;
    registers::Model model = registers::Model::mac140;
    std::string model_name{};  ///< for a user: MAC50-141 if the exact model is unknown
    mactalk_client::MasterOptions line{};
    std::string title{};
    /// Reopens the port after it was lost.
    std::function<host::ByteClient::Opened()> reopen{};
};

/// The full screen, until the user quits it or a signal ends it. The loss of the motor is shown, and the
/// connection retried. Throws std::runtime_error if there is no terminal.
void run_ui(std::unique_ptr<host::ByteClient> wire, const UiOptions& options);

}  // namespace nplc::macreg
