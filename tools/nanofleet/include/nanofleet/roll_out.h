#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "nanofleet/roster.h"
#include "orders/keys.h"

namespace nplc::nanofleet {

/// The state of one gateway in a roll-out.
struct Outcome {
    enum class Kind : std::uint8_t {
        waits,    ///< pending in a later stage
        ordered,  ///< in progress
        done,     ///< it runs the table, confirmed
        failed,
        silent,  ///< no recent report; nothing was ordered
    };
    std::string target;
    Kind kind = Kind::waits;
    std::string text{};
    std::uint64_t counter = 0;     ///< of the order
    std::uint64_t ordered_at = 0;  ///< ms since 1970
    std::uint64_t ended_at = 0;
};
std::string_view name_of(Outcome::Kind kind);

/// Rolls one table out to many gateways: to one, then to a tenth, then to all; it stops when too many fail.
/// Independent of the broker: it gets the time and the received messages, and returns what is to be
/// published. A roll-out that is started again continues where it ended, since orders are retained at the
/// broker.
class RollOut {
  public:
    struct Plan {
        std::vector<std::string> targets{};
        std::vector<std::uint8_t> artifact{};
        std::string name{};  ///< of the table
        orders::SecretKey key{};
        double most_failures = 5;          ///< per cent of the gateways that got an order
        std::uint64_t patience = 600'000;  ///< ms from the order to its end
        std::uint64_t oldest = 300'000;    ///< ms: a gateway without a report for so long is silent
        bool again = false;                ///< gateways that failed with this table get another order
    };
    using Publish = std::function<void(const std::string& topic, const std::string& payload)>;

    explicit RollOut(Plan plan);

    /// The pieces of the table.
    void publish_pieces(const Publish& publish) const;
    /// To be called often. `now`: ms since 1970.
    void look(const Roster& roster, std::uint64_t now, const Publish& publish);

    bool is_over() const { return is_over_; }
    /// Too many have failed: the remaining ones get no order.
    bool was_stopped() const { return was_stopped_; }
    const std::vector<Outcome>& outcomes() const { return outcomes_; }
    std::size_t count(Outcome::Kind kind) const;
    std::size_t stage() const { return stage_; }  ///< 0 to 2
    const std::string& sha256() const { return wanted_; }

  private:
    std::size_t end_of_stage() const;
    void begin(Outcome& outcome, const Heard& heard, std::uint64_t now, const Publish& publish);
    void follow(Outcome& outcome, const Heard& heard, std::uint64_t now) const;
    void order(Outcome& outcome, const Heard& heard, std::uint64_t now, const Publish& publish);
    bool too_many_failed() const;

    Plan plan_;
    std::string wanted_;
    std::vector<Outcome> outcomes_;
    std::vector<std::string> orders_;  ///< their texts' SHA-256
    std::size_t stage_ = 0;
    bool is_over_ = false;
    bool was_stopped_ = false;
};

}  // namespace nplc::nanofleet
