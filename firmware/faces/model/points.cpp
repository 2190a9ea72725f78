#include "faces/points.h"

#include <algorithm>

#include "faces/axis_model.h"
#include "registers/scale.h"

namespace nplc::faces {

Quality quality_of(const AxisImage& image, base::Instant now) {
    if (image.number == 0) return Quality::unknown;
    return now - image.taken > AxisModel::kOld ? Quality::old : Quality::good;
}

namespace {

namespace gw = registers::gateway;
using gw::RunState;

/// Frequent values of the motor are valid for 1 s, the others, which are read in turns of some 8 s, for 20 s.
constexpr base::Milliseconds kFrequent{1'000};
constexpr base::Milliseconds kSeldom{20'000};

PointValue plain(const AxisImage& image, base::Instant now, double value) {
    return {quality_of(image, now), value};
}

template <gw::Number reg, unsigned shift = 0, std::uint32_t mask = 0xFFFF'FFFF>
PointValue own(const AxisImage& image, base::Instant now, const Scaling&) {
    return plain(image, now, image[reg] >> shift & mask);
}

template <gw::StatusBit bit>
PointValue status_bit(const AxisImage& image, base::Instant now, const Scaling&) {
    return plain(image, now, image.is_set(bit) ? 1 : 0);
}

/// Since the start of the gateway where STOP_SINCE is 0.
PointValue stop_unconfirmed_time(const AxisImage& image, base::Instant now, const Scaling&) {
    const bool waits = image.is_set(gw::kStopUnconfirmed);
    return plain(image, now, waits ? image[gw::UPTIME] - image[gw::STOP_SINCE] : 0);
}

template <RunState first, RunState second = first>
PointValue run_state(const AxisImage& image, base::Instant now, const Scaling&) {
    return plain(image, now, image.run_state() == first || image.run_state() == second ? 1 : 0);
}

PointValue is_ready(const AxisImage& image, base::Instant now, const Scaling&) {
    const bool ready = image.run_state() == RunState::stopped && image.is_set(gw::kTable) &&
                       image.is_set(gw::kEnabled) && image.is_set(gw::kLinkDelivers);
    return plain(image, now, ready ? 1 : 0);
}

PointValue is_forced(const AxisImage& image, base::Instant now, const Scaling&) {
    return plain(image, now, image.is_set(gw::kForcedInputs) || image.is_set(gw::kForcedOutputs) ? 1 : 0);
}

/// Bits 7..0 event, 15..8 step, 31..16 detail.
template <unsigned shift, std::uint32_t mask>
PointValue last_event(const AxisImage& image, base::Instant now, const Scaling&) {
    const std::uint32_t count = image[gw::LOG_COUNT];
    if (count == 0) return plain(image, now, 0);
    const std::uint32_t slot = (count - 1) % gw::kLogEntries;
    return plain(image, now, image.own[gw::LOG + 2 * slot + 1] >> shift & mask);
}

PointValue heartbeat(const AxisImage& image, base::Instant now, const Scaling&) {
    constexpr std::uint32_t kTenth = 100;
    return plain(image, now, image[gw::UPTIME] / kTenth & 0xFFFF);
}

PointValue seat(const AxisImage& image, base::Instant now, const Scaling&) {
    const double value = image.holder == 0 ? 0 : image.holder_side == Side::person ? 1 : 2;
    return plain(image, now, value);
}

PointValue control(const AxisImage& image, base::Instant now, const Scaling&) {
    return plain(image, now, static_cast<double>(image.control));
}

PointValue contact_age(const AxisImage& image, base::Instant now, const Scaling&) {
    if (!image.had_contact) return {};
    return plain(image, now, static_cast<double>((now - image.motor_contact).count()) / 1e6);
}

PointValue motor(const AxisImage& image, base::Instant now, MotorItem item, double factor) {
    const MotorValue& value = image.of_motor(item);
    const Quality quality = value.quality(now, is_frequent(item) ? kFrequent : kSeldom);
    return {std::max(quality, quality_of(image, now)), value.value * factor};
}

template <MotorItem item>
PointValue raw(const AxisImage& image, base::Instant now, const Scaling&) {
    return motor(image, now, item, 1);
}

PointValue why(const AxisImage& image, base::Instant now, const Scaling&) {
    if (image.why == 0) return {};
    return plain(image, now, image.why);
}

/// Converts counts to the axis's units.
double per_count(const AxisImage& image, const Scaling& scaling) {
    return scaling.per_revolution / registers::scale_of(model_of(image)).counts_per_rev;
}

template <MotorItem item>
PointValue length(const AxisImage& image, base::Instant now, const Scaling& scaling) {
    return motor(image, now, item, per_count(image, scaling));
}

/// V_IST is in counts per sample.
PointValue velocity(const AxisImage& image, base::Instant now, const Scaling& scaling) {
    const double samples = registers::scale_of(model_of(image)).samples_per_second;
    return motor(image, now, MotorItem::velocity, per_count(image, scaling) * samples);
}

/// 1023 is full torque (001 §3.2.7).
PointValue torque(const AxisImage& image, base::Instant now, const Scaling&) {
    return motor(image, now, MotorItem::torque, 100.0 / 1023.0);
}

PointValue temperature(const AxisImage& image, base::Instant now, const Scaling&) {
    const registers::Model model = model_of(image);
    const registers::Register* reg = register_of(MotorItem::temperature, model);
    if (reg == nullptr) return {};
    const auto steps = registers::raw_per_unit(*reg, model, "C");
    if (!steps) return {};
    return motor(image, now, MotorItem::temperature,
                 static_cast<double>(steps->denominator) / static_cast<double>(steps->numerator));
}

PointValue load(const AxisImage& image, base::Instant now, const Scaling&) {
    const MotorValue& limit = image.of_motor(MotorItem::load_limit);
    if (!limit.is_known || limit.value <= 0) return {};
    return motor(image, now, MotorItem::load, 100.0 / limit.value);
}

constexpr PointType B = PointType::boolean;
constexpr PointType W = PointType::whole;
constexpr PointType R = PointType::real;

// clang-format off
constexpr Point kPoints[] = {
    {"ready", "", B, false, "stopped, with a table, enabled, and the motor answers: run would start it", is_ready},
    {"running", "", B, false, "the sequence runs", run_state<RunState::running>},
    {"waiting", "", B, false, "started, and waits for the motor", run_state<RunState::waiting_for_motor>},
    {"held", "", B, false, "held, or about to be", run_state<RunState::held, RunState::holding>},
    {"safe", "", B, false, "the outputs have their safe values; safe_reason says why", status_bit<gw::kSafe>},
    {"error", "", B, false, "ERROR as the sequence sees it", status_bit<gw::kMotorError>},
    {"in_position", "", B, false, "IN_POS as the sequence sees it", status_bit<gw::kInPosition>},
    {"link_up", "", B, false, "the link to the motor delivers", status_bit<gw::kLinkDelivers>},
    {"forced", "", B, false, "an input or output is forced", is_forced},
    {"at_breakpoint", "", B, false, "held at a breakpoint", status_bit<gw::kAtBreakpoint>},
    {"has_table", "", B, false, "there is an active table", status_bit<gw::kTable>},
    {"enabled", "", B, false, "the enable input, if there is one, is on, and the board lacks nothing", status_bit<gw::kEnabled>},
    {"upload", "", B, false, "an upload is under way", status_bit<gw::kUpload>},
    {"settings_differ", "", B, false, "settings differ from the stored ones", status_bit<gw::kSettingsDiffer>},
    {"cannot_go_on", "", B, false, "held, and cannot go on from there", status_bit<gw::kCannotGoOn>},
    {"stop_unconfirmed", "", B, false, "the motor was told to stop and has not confirmed it: it may be moving", status_bit<gw::kStopUnconfirmed>},
    {"stop_unconfirmed_time", "ms", W, false, "since the motor was told to stop, while it has not confirmed it; else 0", stop_unconfirmed_time},
    {"run_state", "", W, false, "0 stopped, 1 waits for the motor, 2 running, 3 about to be held, 4 held", own<gw::STATUS, 0, 7>},
    {"step", "", W, false, "the step that the sequence is in, 0..62", own<gw::STEP>},
    {"timer", "ms", W, false, "what is left of it", own<gw::TIMER>},
    {"counter", "", W, false, "what the sequence counts", own<gw::COUNTER>},
    {"inputs", "", W, false, "bits 5..0 as the sequence has them, forced ones included", own<gw::INPUTS, 0, 0x3F>},
    {"terminals", "", W, false, "bits 5..0 the debounced input terminals", own<gw::INPUTS, 8, 0x3F>},
    {"outputs", "", W, false, "bits 3..0 the output terminals", own<gw::OUTPUTS, 0, 0x0F>},
    {"written_outputs", "", W, false, "bits 3..0 what the sequence wrote", own<gw::OUTPUTS, 8, 0x0F>},
    {"safe_reason", "", W, false, "why the outputs are safe: firmware/gateway/REGISTERS.md, Reasons", own<gw::SAFE_REASON>},
    {"event_count", "", W, false, "entries written to the log since the start", own<gw::LOG_COUNT>},
    {"last_event", "", W, false, "code of the last event: REGISTERS.md, Reasons", last_event<0, 0xFF>},
    {"last_event_step", "", W, false, "the step that it was in", last_event<8, 0xFF>},
    {"last_event_detail", "", W, false, "its detail", last_event<16, 0xFFFF>},
    {"heartbeat", "", W, false, "counts up ten times a second, modulo 65536", heartbeat},
    {"uptime", "ms", W, false, "since the start of the gateway, modulo 2^32", own<gw::UPTIME>},
    {"scans", "", W, false, "finished scans, modulo 2^32", own<gw::SCANS>},
    {"scan_time", "us", W, false, "between the ends of the last two scans", own<gw::SCAN_TIME>},
    {"worst_scan_time", "us", W, false, "the longest since the run began", own<gw::SCAN_WORST>},
    {"worst_poll_gap", "us", W, false, "how late a poll came at the worst since the run began", own<gw::POLL_WORST>},
    {"late_polls", "", W, false, "polls later than the setting poll_limit", own<gw::LATE_POLLS>},
    {"link", "", W, false, "0 down, 1 starting, 2 not acknowledged, 3 up", own<gw::LINK>},
    {"link_losses", "", W, false, "times that the link to the motor was lost", own<gw::LINK_LOSSES>},
    {"resent", "", W, false, "messages to the motor sent again", own<gw::RESENT>},
    {"orders", "", W, false, "orders of the sequence executed", own<gw::ORDERS>},
    {"discarded", "", W, false, "orders discarded by a lost link or a stop", own<gw::DISCARDED>},
    {"accesses", "", W, false, "motor registers read and written beside the sequence", own<gw::ACCESSES>},
    {"access_fails", "", W, false, "those that failed", own<gw::ACCESS_FAILS>},
    {"user_messages", "", W, false, "whole messages on the user's port", own<gw::MESSAGES>},
    {"user_refused", "", W, false, "those refused", own<gw::REFUSED>},
    {"table_crc", "", W, false, "CRC-32 of the active table", own<gw::TABLE_CRC>},
    {"seat", "", W, false, "who operates: 0 nobody, 1 a person, 2 the plant", seat},
    {"control", "", W, false, "who may operate: 0 everybody, 1 persons, 2 the plant", control},
    {"contact_age", "s", R, false, "since the link to the motor was last seen to deliver", contact_age},
    {"why", "", W, true, "why nothing moves, or that it moves: firmware/causes/README.md, Codes", why},
    {"position_counts", "counts", W, true, "P_IST", raw<MotorItem::position>},
    {"position", "unit", R, true, "P_IST", length<MotorItem::position>},
    {"velocity", "unit/s", R, true, "V_IST", velocity},
    {"error_word", "", W, true, "ERR_STAT", raw<MotorItem::error_word>},
    {"mode", "", W, true, "MODE_REG", raw<MotorItem::mode>},
    {"torque", "%", R, true, "VF_OUT, what the regulator asks for", torque},
    {"load", "%", R, true, "I2T of I2TLIM", load},
    {"follow_error", "unit", R, true, "FLWERR", length<MotorItem::follow_error>},
    {"target", "unit", R, true, "P_SOLL", length<MotorItem::target>},
    {"temperature", "C", R, true, "DEGC, of a MAC800 only", temperature},
};
// clang-format on

}  // namespace

std::span<const Point> points() {
    return kPoints;
}

const Point* find_point(std::string_view name) {
    const auto* found = std::find_if(std::begin(kPoints), std::end(kPoints),
                                     [name](const Point& point) { return point.name == name; });
    return found == std::end(kPoints) ? nullptr : found;
}

std::string unit_of(const Point& point, const Scaling& scaling) {
    if (!point.unit.starts_with("unit")) return std::string(point.unit);
    return scaling.unit + std::string(point.unit.substr(4));
}

}  // namespace nplc::faces
