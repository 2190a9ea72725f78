#include "faces/why_keeper.h"

#include "faces/points.h"
#include "registers/gateway.h"

namespace nplc::faces {

namespace gw = registers::gateway;

namespace {

Findings judge(const AxisImage& image, const causes::GatewayState& gateway, const Survey* survey) {
    if (image.midi) return causes::why(*image.midi, gateway);
    if (survey == nullptr) return causes::why(gateway);
    causes::Condition condition{
        .model = survey->model, .before = survey->before, .now = survey->now, .gateway = gateway};
    Findings all = causes::why(condition);
    const bool says_moves = !all.empty() && all.front().code == "moves";
    if (image.moves && !says_moves && all.front().code != "runaway")
        return {causes::moving(survey->model, image.of_motor(MotorItem::velocity).value)};
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
    const Key key{.survey = asks_motor ? survey.get() : nullptr,
                  .status = image[gw::STATUS] & kJudged,
                  .reason = image[gw::SAFE_REASON],
                  .moves = image.moves,
                  .midi = image.midi};
    const std::lock_guard lock(mutex_);
    if (findings_ == nullptr || !(key == key_)) {
        const causes::GatewayState gateway{.status = image[gw::STATUS],
                                           .safe_reason = image[gw::SAFE_REASON]};
        Findings all = judge(image, gateway, key.survey);
        findings_ = all.empty() ? nullptr : std::make_shared<const Findings>(std::move(all));
        key_ = key;
        survey_ = survey;
    }
    return findings_;
}

}  // namespace nplc::faces
