#include "faces/motor_reader.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "registers/layout.h"

namespace nplc::faces {
namespace {

constexpr std::uint8_t kMostFailures = 2;
constexpr base::Microseconds kLongest{1'000'000};
constexpr base::Microseconds kBusy{1'000};
constexpr base::Microseconds kPause{10'000'000};  ///< without a read, after which all is read anew

constexpr auto kPosition = MotorItem::position;
constexpr auto kVelocity = MotorItem::velocity;
constexpr auto kTorque = MotorItem::torque;
using Turn = std::optional<MotorItem>;
constexpr Turn kOther{};  ///< the next one of the others
constexpr std::array<Turn, 8> kUsual{kPosition, kVelocity, kPosition, kTorque,
                                     kPosition, kVelocity, kPosition, kOther};
/// For a displayed trend: the same number of reads, with the torque as often as the position.
constexpr std::array<Turn, 7> kTrend{kPosition, kVelocity, kTorque, kPosition, kVelocity, kTorque, kOther};

/// While the user port reads the motor too: the least time between an access here and the next one, which
/// takes some 10 ms at 19200 baud, so that the port keeps most of the line.
constexpr base::Microseconds kTurn{50'000};
constexpr base::Microseconds kBeside{200'000};  ///< since the port was last seen to wait for the motor

/// The motor's one access may be begun: it is neither an activation's nor the port's. Between two accesses
/// for one message of the port it is free, too.
bool is_free(gateway::Controller& controller) {
    return !controller.registers().asks_motor() && !controller.user_port().accesses_motor();
}

std::int32_t signed_value(const registers::Register& reg, std::uint32_t value) {
    if (registers::is_32_bit(reg.format)) return static_cast<std::int32_t>(value);
    return reg.min < 0 ? static_cast<std::int16_t>(value) : static_cast<std::uint16_t>(value);
}

}  // namespace

void MotorReader::begin(const motor::Access& access) {
    wanted_ = access;
    item_.reset();
    surveyed_ = nullptr;
    asked_ = false;
    failures_ = 0;
    begun_.reset();
}

void MotorReader::forget() {
    wanted_.reset();
    item_.reset();
    surveyed_ = nullptr;
    to_survey_.clear();
    survey_ended_ = survey_failed_ = false;
    asked_ = false;
    last_.ended = {};
    hurried_ = kHurried;
}

void MotorReader::drop(gateway::Controller& controller) {
    if (asked_ && !controller.registers().asks_motor() && ended_since(controller) == Ended{})
        controller.motor().drop_access();
    asked_ = false;
    wanted_.reset();
    item_.reset();
    surveyed_ = nullptr;
}

base::Microseconds MotorReader::pause(const gateway::Controller& controller, base::Instant now) const {
    const bool runs = controller.sequence().run_state() != gateway::RunState::stopped;
    const base::Milliseconds running(runs ? controller.registers().settings().get(store::Setting::read_pause)
                                          : 0);
    return now - last_.port_waited <= kBeside ? std::max<base::Microseconds>(running, kTurn) : running;
}

MotorReader::Ended MotorReader::ended_since(const gateway::Controller& controller) const {
    const motor::Counters counters = controller.motor().counters();
    return {.done = counters.accesses - before_.done, .failed = counters.access_fails - before_.failed};
}

MotorReader::State MotorReader::poll(gateway::Controller& controller, base::Instant now) {
    if (!begun_) begun_ = now;
    if (controller.user_port().awaits_motor()) last_.port_waited = now;
    const bool is_usable = motor::link_is_usable(controller.motor().link());
    if (asked_ && is_usable) {  // first, for a process that was halted: it may have ended in time
        const State state = take(controller, now);
        if (state != State::under_way) return state;
    }
    if (!is_usable || now - *begun_ > kLongest) {
        drop(controller);
        return State::failed;
    }
    if (asked_) return State::under_way;
    if (is_free(controller) && now - last_.ended >= pause(controller, now)) {
        const motor::Counters before = controller.motor().counters();
        asked_ = controller.motor().begin_access(*wanted_);
        if (asked_) before_ = {.done = before.accesses, .failed = before.access_fails};
    }
    return State::under_way;
}

/// The next access may be the port's already, begun in the poll in which this one ended: the counters tell
/// its end, and the value is kept until another one ends. A failed or dropped write may have been executed:
/// it is not repeated.
MotorReader::State MotorReader::take(gateway::Controller& controller, base::Instant now) {
    const Ended ended = ended_since(controller);
    const bool lost = controller.registers().asks_motor() || ended.done + ended.failed > 1;
    const bool dropped = controller.motor().access_state() == motor::AccessState::none;
    if (!lost && !dropped && ended == Ended{}) return State::under_way;
    asked_ = false;
    last_.ended = now;
    if (lost || ended.done == 0) {
        if (!wanted_->is_write && (lost || ++failures_ < kMostFailures)) return State::under_way;
        wanted_.reset();
        return State::failed;
    }
    value_ = controller.motor().access_value();
    wanted_.reset();
    return State::done;
}

base::Instant MotorReader::next(const gateway::Controller& controller, base::Instant now) const {
    if (!wanted_) return base::kNever;
    const base::Instant patience = begun_.value_or(now) + kLongest + base::Microseconds(1);
    if (asked_) return motor::is_open(controller.motor().access_state()) ? patience : now;
    return std::min(patience, std::max(now + kBusy, last_.ended + pause(controller, now)));
}

/// The next one of the motor that is not read oftener.
MotorItem MotorReader::next_other(registers::Model model) {
    constexpr auto kFirst = static_cast<unsigned>(MotorItem::error_word);
    MotorItem item{};
    do {
        item = static_cast<MotorItem>(other_);
        other_ = other_ + 1 < kMotorItems ? other_ + 1 : kFirst;
    } while (item == MotorItem::torque || register_of(item, model) == nullptr);
    return item;
}

/// In the order of kUsual or kTrend. At first, and after a pause, every second read is of the others, until
/// each was read once.
void MotorReader::choose_item(const AxisImage& image, bool has_trend) {
    const registers::Model model = model_of(image);
    const unsigned turn = turn_++;
    Turn next = has_trend ? kTrend[turn % kTrend.size()] : kUsual[turn % kUsual.size()];
    if (hurried_ != 0) {
        next = turn % 2 == 0 ? kPosition : kVelocity;
        if (turn % 4 >= 2) next = --hurried_ == 0 ? Turn(kTorque) : kOther;
    }
    const MotorItem item = next ? *next : next_other(model);
    const registers::Register& found = *register_of(item, model);
    begin({.reg = found.number, .longword = registers::is_32_bit(found.format)});
    item_ = item;
}

void MotorReader::begin_survey(registers::Model model) {
    const auto before = causes::judged_before(model);
    to_survey_ = causes::judged(model);
    std::reverse(to_survey_.begin(), to_survey_.end());
    to_survey_.insert(to_survey_.end(), before.begin(), before.end());
    before_left_ = before.size();
    survey_ = Survey{};
    survey_.model = model;
    survey_ended_ = false;
}

void MotorReader::choose_surveyed() {
    const registers::Register& next = *to_survey_.back();
    begin({.reg = next.number, .longword = registers::bytes_of(survey_.model, next) == 4});
    surveyed_ = &next;
}

void MotorReader::note_surveyed(base::Instant wall) {
    const bool is_before = before_left_ != 0;
    if (is_before) --before_left_;
    (is_before ? survey_.before : survey_.now).set(surveyed_->number, signed_value(*surveyed_, value_), wall);
    surveyed_ = nullptr;
    to_survey_.pop_back();
    if (!to_survey_.empty()) return;
    survey_.taken = wall;
    survey_ended_ = true;
}

std::optional<Survey> MotorReader::take_survey() {
    if (!std::exchange(survey_ended_, false)) return std::nullopt;
    return std::exchange(survey_, Survey{});
}

void MotorReader::note_item(AxisImage& image, base::Instant wall) {
    constexpr std::int32_t kMotion = 8;  // counts; more than noise
    const MotorItem item = *item_;
    item_.reset();
    const registers::Register& found = *register_of(item, model_of(image));
    MotorValue& kept = image.motor[static_cast<std::size_t>(item)];
    const std::int32_t value = signed_value(found, value_);
    if (item == MotorItem::position) {
        const bool moves = kept.is_known && std::abs(std::int64_t{value} - kept.value) >= kMotion;
        if (moves && !image.moves) image.moving_since = wall;
        image.moves = moves;
    }
    kept = {true, value, wall};
}

void MotorReader::look_around(gateway::Controller& controller, AxisImage& image, base::Instant now,
                              base::Instant wall, bool has_trend) {
    if (period_.count() == 0) return;
    if (!wanted_) {
        // By turns where both are due: reads may take longer than the period.
        const bool is_surveys_turn = surveys() && std::exchange(read_item_, false);
        if (wall >= due_ && !is_surveys_turn) {
            if (wall - due_ > kPause) hurried_ = kHurried;
            due_ = wall + period_;
            read_item_ = true;
            choose_item(image, has_trend);
        } else if (surveys()) {
            choose_surveyed();
        }
        if (!wanted_) return;
    }
    const bool is_item = item_.has_value();
    switch (poll(controller, now)) {
        case State::under_way:
            return;
        case State::failed:
            item_.reset();
            surveyed_ = nullptr;
            if (!is_item || (surveys() && !motor::link_is_usable(controller.motor().link()))) {
                to_survey_.clear();
                survey_failed_ = true;
            }
            return;
        case State::done:
            return is_item ? note_item(image, wall) : note_surveyed(wall);
    }
}

}  // namespace nplc::faces
