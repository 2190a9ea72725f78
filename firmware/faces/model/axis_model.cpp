#include "faces/axis_model.h"

#include <algorithm>

#include "causes/codes.h"
#include "faces/axis_table.h"

namespace nplc::faces {

void AxisModel::want(base::Instant now) {
    const std::int64_t before = wanted_.exchange(now.time_since_epoch().count(), std::memory_order_seq_cst);
    if (now.time_since_epoch().count() - before > base::Microseconds(kInterest).count() && loop_ != nullptr)
        loop_->strike();
}

bool AxisModel::is_wanted(base::Instant now) const {
    return now.time_since_epoch().count() - wanted_.load(std::memory_order_seq_cst) <=
           base::Microseconds(kInterest).count();
}

void AxisModel::want_motor(base::Instant now) {
    motor_asked_.store(now.time_since_epoch().count(), std::memory_order_relaxed);
}

bool AxisModel::wants_motor(base::Instant now) const {
    const std::int64_t asked = motor_asked_.load(std::memory_order_relaxed);
    return wants_survey(now) ||
           now.time_since_epoch().count() - asked <= base::Microseconds(kMotorInterest).count();
}

void AxisModel::want_trend(base::Instant now) {
    trend_asked_.store(now.time_since_epoch().count(), std::memory_order_relaxed);
}

bool AxisModel::wants_trend(base::Instant now) const {
    return now.time_since_epoch().count() - trend_asked_.load(std::memory_order_relaxed) <=
           base::Microseconds(kInterest).count();
}

AxisImage AxisModel::image_with_why(base::Instant now, std::shared_ptr<const Findings>* findings) {
    why_asked_.store(now.time_since_epoch().count(), std::memory_order_relaxed);
    AxisImage image = this->image(now);
    const auto found = why_.look(image, now, survey_.get());
    if (found != nullptr) image.why = causes::number_of(found->front().code);
    if (findings != nullptr) *findings = found;
    return image;
}

bool AxisModel::wants_survey(base::Instant now) const {
    return now.time_since_epoch().count() - why_asked_.load(std::memory_order_relaxed) <=
           base::Microseconds(kWhyInterest).count();
}

void AxisModel::watch(Bell& bell) {
    const auto place = std::find(bells_.begin(), bells_.end(), nullptr);
    if (place != bells_.end()) *place = &bell;
}

void AxisModel::ignore(const Bell& bell) {
    std::replace_if(
        bells_.begin(), bells_.end(), [&bell](const Bell* one) { return one == &bell; }, nullptr);
}

void AxisModel::wake_loop_with(Bell& loop) {
    loop_ = &loop;
    desk_.wake_loop_with(loop);
}

void AxisModel::arm_loop() {
    if (loop_ != nullptr) loop_->arm();
}

void AxisModel::strike_bells() {
    for (Bell* bell : bells_) {
        if (bell != nullptr) bell->strike();
    }
}

bool AxisTable::fired(std::size_t term, std::uint8_t step, sequencer::Key key) const {
    if ((term + 1) * sequencer::kTermBytes > bytes.size()) return false;
    const auto view = sequencer::TermView(std::span<const std::uint8_t>(bytes)
                                              .subspan(term * sequencer::kTermBytes)
                                              .first<sequencer::kTermBytes>());
    return sequencer::step_of(view) == step && sequencer::is_true(view, key);
}

}  // namespace nplc::faces
