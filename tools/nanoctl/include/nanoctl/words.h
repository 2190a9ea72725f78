#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "nanoctl/status.h"
#include "registers/gateway.h"

/// What the gateway's numbers are called.
namespace nplc::nanoctl {

std::string_view name_of(registers::gateway::Command command);
std::string_view name_of(registers::gateway::RunState state);
/// SAFE_REASON, and the events of the log.
std::string_view name_of_event(std::uint8_t event);
/// The detail of event 32.
std::string_view name_of_motor_fault(std::uint16_t number);
/// What is to be added of a held sequence that cannot go on; else empty.
std::string_view held_remark(const Status& status);
/// "down", "starting", "not acknowledged", "up".
std::string_view name_of_link(std::uint32_t link);
/// Of a table of so many bytes: "25 terms and the end term".
std::string terms_text(std::size_t bytes);
/// "1 min 02.345 s", "2.345 s".
std::string time_text(std::uint32_t milliseconds);

}  // namespace nplc::nanoctl
