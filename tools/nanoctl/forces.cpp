#include "nanoctl/forces.h"

#include <fmt/format.h>

#include <algorithm>

#include "nanoctl/operating.h"
#include "nanoctl/status.h"

namespace nplc::nanoctl {
namespace {

bool holds(std::uint32_t now, std::uint32_t kept) {
    const auto forced = gw::Force::of_register(now);
    const auto wanted = gw::Force::of_register(kept);
    return (forced.mask & wanted.mask) == wanted.mask && wanted.over(forced.levels) == forced.levels;
}

/// A write that ends forces is logged as a force; only a safe command and the timeout are logged as an end.
std::string who_ended(GatewayClient& gateway) {
    const auto entries = read_log(gateway);
    const auto is_of_force = [](const LogEntry& entry) {
        const auto event = static_cast<gw::Event>(entry.event);
        return event == gw::Event::forced || event == gw::Event::forces_ended;
    };
    const auto last = std::find_if(entries.rbegin(), entries.rend(), is_of_force);
    if (last != entries.rend() && static_cast<gw::Event>(last->event) == gw::Event::forces_ended) {
        constexpr std::uint16_t kBySilence = 1;
        return last->detail == kBySilence ? "by the gateway: they were not renewed in time"
                                          : "by a safe command";
    }
    const Operator who = read_operator(gateway);
    if (who.way == gw::OperatorWay::nobody || who.is_you) return "elsewhere";
    return "by " + in_words(who);
}

}  // namespace

bool Forces::hold(const Forces& kept) const {
    return holds(in, kept.in) && holds(out, kept.out);
}

Forces read_forces(GatewayClient& gateway) {
    const Block block = gateway.read_block(gw::COMMAND);
    return {block[gw::FORCE_IN - gw::COMMAND], block[gw::FORCE_OUT - gw::COMMAND]};
}

std::optional<std::string> renew_forces(GatewayClient& gateway, const Forces& kept) {
    const Forces now = read_forces(gateway);
    if (now.hold(kept)) {
        gateway.write(gw::FORCE_LEFT, 0);
        return std::nullopt;
    }
    const bool are_ended = (now.in | now.out) >> 8 == 0;
    return fmt::format("the forces were {} {}", are_ended ? "ended" : "changed", who_ended(gateway));
}

}  // namespace nplc::nanoctl
