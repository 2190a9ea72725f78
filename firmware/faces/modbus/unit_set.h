#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "modbus/session.h"

namespace nplc::modbus {

/// Shared by the servers of all lines: the axes as slaves, and a client at each command desk that stops a
/// machine whose master is silent. Used by a server's thread.
class UnitSet {
  public:
    /// If the image is older than this, a new one is requested before an answer.
    static constexpr base::Milliseconds kFresh{50};
    static constexpr base::Milliseconds kImageWait{100};
    /// Poll interval of masters and lines. Data that arrived between two polls are as old as this interval.
    static constexpr base::Milliseconds kTick{250};
    static constexpr base::Milliseconds kBetweenLooks{20};  ///< while a command is in progress

    /// `first`: unit of the first axis, where it has none of its own.
    UnitSet(const faces::Axes& axes, const Settings& settings, std::uint8_t first = 1)
        : axes_(axes), settings_(settings), first_(first) {}
    ~UnitSet();
    UnitSet(const UnitSet&) = delete;
    UnitSet& operator=(const UnitSet&) = delete;

    /// To be called once the server has its line; `bell` wakes its thread.
    void join(faces::Bell& bell);

    std::vector<std::unique_ptr<Unit>>& units() { return units_; }
    bool is_fresh(base::Instant now) const;
    void watch_masters(base::Instant now);
    /// Index of the axis that is this unit.
    std::optional<std::size_t> index_of(std::uint8_t unit) const;
    /// Sends a stop to one axis.
    void stop(std::size_t index, const faces::Command& command);
    /// Sends a stop to all axes.
    void stop_all(const faces::Command& command);
    bool has_master(std::uint64_t session) const;

  private:
    faces::Axes axes_;
    Settings settings_;
    std::uint8_t first_;
    faces::Bell* bell_ = nullptr;
    std::vector<std::unique_ptr<Unit>> units_;
    std::vector<std::unique_ptr<faces::CommandDesk::Client>> guards_;
};

}  // namespace nplc::modbus
