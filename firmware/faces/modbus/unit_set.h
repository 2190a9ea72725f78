#pragma once

#include <memory>
#include <vector>

#include "modbus/session.h"

namespace nplc::modbus {

/// What the servers of all lines have: the axes as slaves, and one of ours at each desk that stops a machine
/// whose master has gone silent. Belongs to a server's thread.
class UnitSet {
  public:
    /// An image older than this is asked for anew before an answer, and waited for.
    static constexpr base::Milliseconds kFresh{50};
    static constexpr base::Milliseconds kImageWait{100};
    /// Between two looks at masters and lines. What came between two is as old as the time between.
    static constexpr base::Milliseconds kTick{250};

    UnitSet(const faces::Axes& axes, const Settings& settings) : axes_(axes), settings_(settings) {}
    ~UnitSet();
    UnitSet(const UnitSet&) = delete;
    UnitSet& operator=(const UnitSet&) = delete;

    /// Once the server has its line; `bell` wakes its thread.
    void join(faces::Bell& bell);

    std::vector<std::unique_ptr<Unit>>& units() { return units_; }
    bool is_fresh(base::Instant now) const;
    void watch_masters(base::Instant now);
    /// To all axes, for everybody: a stop.
    void stop_all(const faces::Command& command);
    bool has_master(std::uint64_t session) const;

  private:
    faces::Axes axes_;
    Settings settings_;
    faces::Bell* bell_ = nullptr;
    std::vector<std::unique_ptr<Unit>> units_;
    std::vector<std::unique_ptr<faces::CommandDesk::Client>> guards_;
};

}  // namespace nplc::modbus
