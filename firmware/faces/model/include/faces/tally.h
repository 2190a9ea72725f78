#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "gateway/gateway.h"

namespace nplc::faces {

/// Event counters since the process began. A plain value.
struct Tally {
    /// Upper bounds of scan times; a further class counts the longer ones.
    static constexpr std::array<std::uint32_t, 13> kBoundsMicroseconds{
        100, 250, 500, 1'000, 2'000, 3'000, 5'000, 10'000, 20'000, 50'000, 100'000, 500'000, 1'000'000};
    static constexpr std::size_t kEvents = 64;

    std::array<std::uint64_t, kBoundsMicroseconds.size() + 1> scans{};  ///< of each class
    std::uint64_t scan_microseconds = 0;                                ///< their sum
    std::array<std::uint32_t, kEvents> events{};  ///< by the code of the log (REGISTERS.md, Reasons)
};

/// The new entries of a gateway's log, each once, in order; overwritten ones are skipped.
class NewEvents {
  public:
    template <class Each>
    void look(const gateway::EventLog& log, const Each& each) {
        if (log.count() < told_) told_ = log.count();  // the log was cleared
        if (log.count() - told_ > gateway::EventLog::kSlots)
            told_ = log.count() - static_cast<std::uint32_t>(gateway::EventLog::kSlots);
        for (; told_ != log.count(); ++told_) each(log.slot(told_ % gateway::EventLog::kSlots));
    }
    /// There is a new log.
    void restart() { told_ = 0; }

  private:
    std::uint32_t told_ = 0;
};

/// Counts a gateway's events. Untimed scans (the first one, or after a sleep) are not counted.
class TallyKeeper {
  public:
    /// To be called after every poll of the gateway.
    void look(const gateway::Gateway& sequence) {
        if (sequence.scans() != scans_) {
            scans_ = sequence.scans();
            note_scan(sequence.scan_time());
        }
        events_.look(sequence.log(), [this](const gateway::EventLog::Entry& entry) {
            if (entry.event < Tally::kEvents) ++tally_.events[entry.event];
        });
    }
    void restart() {
        events_.restart();
        scans_ = 0;
    }
    const Tally& tally() const { return tally_; }

  private:
    void note_scan(base::Microseconds time) {
        if (time.count() <= 0) return;
        const auto& bounds = Tally::kBoundsMicroseconds;
        const auto bound = std::lower_bound(bounds.begin(), bounds.end(), time.count());
        ++tally_.scans[static_cast<std::size_t>(bound - bounds.begin())];
        tally_.scan_microseconds += static_cast<std::uint64_t>(time.count());
    }

    Tally tally_;
    NewEvents events_;
    std::uint32_t scans_ = 0;
};

}  // namespace nplc::faces
