#pragma once

#include <algorithm>
#include <cstdint>

#include "base/time.h"
#include "faces/drop_watch.h"
#include "faces/tally.h"
#include "force_messages.h"
#include "gateway/controller.h"
#include "journal.h"
#include "link_messages.h"
#include "motor/motor.h"
#include "motor_part.h"
#include "seat/seat.h"
#include "stop_messages.h"

namespace nplc::boards {

/// Reports new events of an axis's log, its drive and its motor link to the journal, once each.
class AxisReporter {
  public:
    explicit AxisReporter(AxisJournal& journal) : journal_(journal) {}

    /// To be called with a new log.
    void start(base::Instant now);
    /// False: no store. Then the stored data count as out of reach, which is reported elsewhere, not as
    /// damaged.
    void set_store(bool is_there) { has_store_ = is_there; }
    /// `holder`: the present operator; null: none.
    void report(gateway::Controller& controller, MotorPart& motor, const faces::Sitter* holder,
                base::Instant now);
    /// Latest time of the next report().
    base::Instant next_report() const {
        return std::min({tell_silence_at_, link_messages_.next(), stop_messages_.next()});
    }

  private:
    void report_events(gateway::Controller& controller, const faces::Sitter* holder);
    void report_drops(gateway::Controller& controller);
    void report_stop(gateway::Controller& controller, const faces::Sitter* holder, base::Instant now);
    void report_link(MotorPart& motor, base::Instant now);

    AxisJournal& journal_;
    base::Instant tell_silence_at_ = base::kNever;
    faces::NewEvents events_;
    faces::DropWatch drops_;
    motor::Link told_link_ = motor::Link::down;
    LinkMessages link_messages_;
    ForceMessages force_messages_;
    StopMessages stop_messages_;
    bool stop_is_logged_ = false;  ///< its confirmation, since the last report
    bool has_store_ = true;
};

}  // namespace nplc::boards
