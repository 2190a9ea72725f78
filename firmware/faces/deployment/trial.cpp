#include "trial.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace nplc::deployment {

namespace gw = registers::gateway;

namespace {

/// Why it cannot become healthy; empty: no reason.
std::string_view obstacle(const faces::AxisImage& image) {
    switch (static_cast<gw::SafeReason>(image[gw::SAFE_REASON])) {
        case gw::SafeReason::no_proof:
            return "it has no certificate, which setting require_proof asks for";
        case gw::SafeReason::motor_stuck:
            return "the motor was stuck";
        default:
            return {};
    }
}

}  // namespace

Trial::Judgement Trial::watch(const faces::AxisImage& image, base::Instant now) {
    const Settings& settings = settings_;
    const std::uint32_t reason = image[gw::SAFE_REASON];
    if (!first_reason_ || reason == static_cast<std::uint32_t>(gw::SafeReason::none)) first_reason_ = reason;
    const std::string_view why = obstacle(image);
    if (!why.empty() && reason != *first_reason_) return {Verdict::failed, std::string(why)};
    const base::Instant last = std::exchange(watched_, now);
    if (image.run_state() != gw::RunState::running) return {Verdict::open, "waits until the sequence runs"};
    ran_ += now - last;
    healthy_ += now - last;
    if (image.is_set(gw::kMotorError)) {
        healthy_ = {};
        error_ = fmt::format("ERROR in step {} on trial", image[gw::STEP]);
    }
    if (settings.healthy_step && image[gw::STEP] == *settings.healthy_step) was_in_step_ = true;
    const bool has_step = !settings.healthy_step || was_in_step_;
    if (healthy_ >= settings.healthy_after && has_step) return {Verdict::healthy, {}};
    const base::Microseconds left = settings.healthy_within - ran_;
    if (!error_.empty() && left < settings.healthy_after - healthy_) return {Verdict::failed, error_};
    if (left.count() <= 0 && !has_step)
        return {Verdict::failed, fmt::format("step {} was not reached on trial", *settings.healthy_step)};
    return {};
}

}  // namespace nplc::deployment
