#include "macreg/sample_view.h"

#include "stepped.h"

namespace nplc::macreg {

void SampleView::set_recording(Recording recording) {
    recording_ = std::move(recording);
    move_curve(0);
    sample_ = 0;
}

void SampleView::move_curve(int steps) {
    curve_ = stepped(curve_, steps, recording_.columns.size());
}

void SampleView::move(int steps) {
    if (numbers_) {
        sample_ = stepped(sample_, steps, recording_.size());
    } else {
        move_curve(steps);
    }
}

}  // namespace nplc::macreg
