#include "faces/why_keeper.h"

#include <cstdlib>
#include <string_view>

#include "faces/points.h"
#include "registers/gateway.h"

namespace nplc::faces {

namespace gw = registers::gateway;

namespace {

/// V_IST if read since the motion began; not 0, which it passes while it starts, ends or turns round.
std::optional<std::int32_t> velocity_of(const AxisImage& image) {
    const MotorValue& read = image.of_motor(MotorItem::velocity);
    if (!image.moves || !read.is_known || read.taken < image.moving_since || read.value == 0)
        return std::nullopt;
    return read.value;
}

/// True if the value is near enough to the one in the present text that the text need not change.
bool is_near(std::int32_t value, std::int32_t told) {
    constexpr std::int64_t kPart = 8;
    return std::abs(std::int64_t{value} - told) * kPart <= std::abs(std::int64_t{told});
}

/// Position and velocity were read at rest after the survey.
bool stands(const AxisImage& image, const Survey& survey) {
    const MotorValue& position = image.of_motor(MotorItem::position);
    const MotorValue& velocity = image.of_motor(MotorItem::velocity);
    return !image.moves && position.is_known && position.taken > survey.taken && velocity.is_known &&
           velocity.taken > survey.taken && velocity.value == 0;
}

Findings judge(const AxisImage& image, const causes::GatewayState& gateway, const Survey* survey,
               std::optional<std::int32_t> velocity) {
    if (image.midi) return causes::why(*image.midi, gateway);
    if (survey == nullptr) return causes::why(gateway);
    causes::Condition condition{
        .model = survey->model, .before = survey->before, .now = survey->now, .gateway = gateway};
    Findings all = causes::why(condition);
    const std::string_view first = all.front().code;
    // The reason for the standstill follows with the next survey, which begins soon.
    if ((first == "moves" || first == "runaway") && stands(image, *survey)) return causes::why(gateway);
    if (!image.moves || first == "runaway") return all;
    if (first != "moves") return {causes::moving(survey->model, velocity)};
    if (all.front().sentence.starts_with("It moves")) all.front() = causes::moving(survey->model, velocity);
    return all;
}

}  // namespace

std::shared_ptr<const Findings> WhyKeeper::look(const AxisImage& image, base::Instant now,
                                                const std::shared_ptr<const Survey>& survey) {
    constexpr std::uint32_t kJudged = gw::kSafe | gw::kLinkDelivers | 0x7;
    if (quality_of(image, now) != Quality::good) return nullptr;
    const bool is_jvl = image.setting(gw::Setting::motor_kind) == 0;
    const bool asks_motor = is_jvl && image.is_set(gw::kLinkDelivers);
    const bool has_survey =
        survey != nullptr && survey->taken != base::Instant{} && now - survey->taken <= kGood;
    if (asks_motor && !has_survey) return nullptr;
    Key key{.survey = asks_motor ? survey.get() : nullptr,
            .status = image[gw::STATUS] & kJudged,
            .reason = image[gw::SAFE_REASON],
            .moves = image.moves,
            .stands = asks_motor && stands(image, *survey),
            .velocity = velocity_of(image),
            .midi = image.midi};
    const std::lock_guard lock(mutex_);
    if (key.velocity && key_.velocity && is_near(*key.velocity, *key_.velocity)) key.velocity = key_.velocity;
    if (findings_ == nullptr || !(key == key_)) {
        const causes::GatewayState gateway{.status = image[gw::STATUS],
                                           .safe_reason = image[gw::SAFE_REASON]};
        Findings all = judge(image, gateway, key.survey, key.velocity);
        findings_ = all.empty() ? nullptr : std::make_shared<const Findings>(std::move(all));
        key_ = key;
        survey_ = survey;
    }
    return findings_;
}

}  // namespace nplc::faces
