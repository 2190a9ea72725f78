#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "faces/command.h"
#include "registers/mac.h"

namespace nplc::panel {

/// A client's message, parsed without knowledge of the machine.
struct Request {
    std::optional<std::uint64_t> id{};  ///< empty: it cannot be answered by number
    std::string what{};                 ///< member "do"
    nlohmann::json body{};
    std::string error{};  ///< one line if it is invalid

    static Request read(std::string_view text);

    std::string text(const char* name) const;  ///< empty if missing or not a text
    std::optional<std::int64_t> whole(const char* name) const;
    std::optional<double> number(const char* name) const;
    bool flag(const char* name) const;
};

/// The command of a request, or an error.
struct Asked {
    std::optional<faces::Command> command{};
    std::string error{};
};
/// `do`: command, write, motor_read, motor_write, seat, leave.
Asked command_of(const Request& request, registers::Model model, base::Instant now);

}  // namespace nplc::panel
