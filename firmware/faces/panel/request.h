#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "faces/command.h"
#include "registers/mac.h"

namespace nplc::panel {

/// A message of a client, as far as it can be read without knowing the machine.
struct Request {
    std::optional<std::uint64_t> id{};  ///< nothing: it cannot even be answered by number
    std::string what{};                 ///< member "do"
    nlohmann::json body{};
    std::string error{};  ///< one line if it is no request

    static Request read(std::string_view text);

    std::string text(const char* name) const;  ///< empty if it is not there or no text
    std::optional<std::int64_t> whole(const char* name) const;
    std::optional<double> number(const char* name) const;
    bool flag(const char* name) const;
};

/// What a request asks of an axis, or why it is none.
struct Asked {
    std::optional<faces::Command> command{};
    std::string error{};
};
/// `do`: command, write, motor_read, motor_write, seat, leave.
Asked command_of(const Request& request, registers::Model model, base::Instant now);

}  // namespace nplc::panel
