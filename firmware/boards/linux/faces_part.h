#pragma once

#include <string>

#include "faces/axis_loop.h"
#include "hal_linux/wakeup.h"

namespace nplc::boards {

/// The interface between an axis and the faces, on the event loop's side.
class FacesPart {
  public:
    FacesPart(const std::string& name, const faces::Scaling& scaling, const faces::LoopSettings& settings)
        : model_(name, scaling), loop_(model_, settings) {
        model_.wake_loop_with(bell_);
    }
    FacesPart(const FacesPart&) = delete;
    FacesPart& operator=(const FacesPart&) = delete;

    faces::AxisModel& model() { return model_; }
    faces::Seat& seat() { return loop_.seat(); }
    int descriptor() const { return wakeup_.descriptor(); }

    /// After every poll of the controller, as AxisLoop::poll.
    void poll(gateway::Controller& controller, const motor::AnyDriver& driver, base::Instant now,
              base::Instant wall) {
        wakeup_.drain();
        loop_.poll(controller, now, wall, &driver);
    }
    void restarted() { loop_.restarted(); }
    base::Instant next(const gateway::Controller& controller) const { return loop_.next(controller); }

  private:
    hal_linux::Wakeup wakeup_;
    faces::Bell bell_{[this] { wakeup_.ring(); }};
    faces::AxisModel model_;
    faces::AxisLoop loop_;
};

}  // namespace nplc::boards
