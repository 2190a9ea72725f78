#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nanofleet/broker.h"
#include "nanofleet/fleet.h"
#include "orders/order.h"
#include "orders/report.h"

namespace nplc::nanofleet {

/// The retained messages of one gateway.
struct Heard {
    std::optional<orders::Report> report{};
    std::string order{};  ///< the text at its topic
};

/// The retained messages of a fleet.
class Roster {
  public:
    void take(std::string_view topic, std::string_view payload);
    const Heard& of(const std::string& target) const;
    /// Reports and orders of these gateways.
    static std::vector<std::string> topics(const std::vector<std::string>& targets);

  private:
    std::map<std::string, Heard> heard_;
};

/// A gateway compared with its wanted state.
struct Standing {
    enum class Kind : std::uint8_t {
        as_wanted,
        under_way,  ///< an order for the wanted table is in progress
        differs,
        silent,  ///< no report, or a stale one
    };
    Kind kind = Kind::silent;
    std::string text{};         ///< the reason
    std::uint64_t contact = 0;  ///< of its last report, ms since 1970; 0: never
};
std::string_view name_of(Standing::Kind kind);

/// `wanted`: SHA-256. A report older than `oldest` ms at `now` counts as none.
Standing judge(const Heard& heard, std::string_view wanted, std::uint64_t now, std::uint64_t oldest);

}  // namespace nplc::nanofleet
