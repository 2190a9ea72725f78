#pragma once

#include <cstdint>

#include "base/time.h"
#include "faces/tally.h"
#include "gateway/controller.h"
#include "journal.h"
#include "motor/motor.h"
#include "motor_part.h"
#include "seat/seat.h"

namespace nplc::boards {

/// Reports to the journal, once each, what an axis's log, its drive and its link to the motor have new.
class AxisReporter {
  public:
    explicit AxisReporter(AxisJournal& journal) : journal_(journal) {}

    /// With a new log.
    void start(base::Instant now);
    /// `holder`: who operates; null: nobody.
    void report(gateway::Controller& controller, MotorPart& motor, const faces::Sitter* holder,
                base::Instant now);
    /// When report() is wanted at the latest.
    base::Instant next_report() const { return tell_silence_at_; }

  private:
    void report_events(gateway::Controller& controller, const faces::Sitter* holder);
    void report_link(MotorPart& motor, base::Instant now);

    AxisJournal& journal_;
    base::Instant tell_silence_at_ = base::kNever;
    faces::NewEvents events_;
    motor::Link told_link_ = motor::Link::down;
};

}  // namespace nplc::boards
