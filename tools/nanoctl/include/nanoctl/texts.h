#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "nanoctl/status.h"

/// Texts about a gateway, for the user.
namespace nplc::nanoctl {

/// The addition to a message about a held sequence that cannot continue; else empty.
std::string_view held_remark(const Status& status);
/// The addition to a message about a stop, safe or hold that was carried out.
std::string stop_remark(const Status& status);
/// Of a stop that the motor has not confirmed for so long; 0: for an unknown time.
std::string unconfirmed_text(std::uint32_t milliseconds);
/// Of a table of so many bytes: "25 terms and the end term".
std::string terms_text(std::size_t bytes);
/// "1 min 02.345 s", "2.345 s".
std::string time_text(std::uint32_t milliseconds);

}  // namespace nplc::nanoctl
