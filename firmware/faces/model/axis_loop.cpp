#include "faces/axis_loop.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/bytes.h"
#include "causes/commands.h"
#include "protocol/fastmac.h"
#include "registers/layout.h"

namespace nplc::faces {

namespace gw = registers::gateway;
using Kind = Command::Kind;

namespace {

constexpr int kMostAtOnce = 16;
constexpr base::Microseconds kBriefly{1'000};

struct Range {
    std::uint8_t first;
    std::uint8_t count;
};
/// Not read: FIRED_SCAN, since reading it has a side effect, and FIRED, which would need a pass over the
/// table.
constexpr Range kImaged[] = {
    {gw::IDENTITY, 9},
    {gw::STATUS, gw::STOP_SINCE + 1 - gw::STATUS},
    {gw::COMMAND, 5},
    {gw::UPLOAD_STATE, 5},
    {gw::PROOF_BYTES, 1 + gw::kProofWords},
    {gw::SET_POINT_COUNT, 1 + gw::SET_POINT_BYTES - gw::SET_POINT_COUNT},
    {gw::LOG, 2 * gw::kLogEntries},
    {gw::SET_POINT, 2 * gw::kSetPoints},
    {gw::SETTINGS, 1 + gw::kMostSettings},
};

Completion completion_of(std::uint32_t word) {
    return {.result = static_cast<Result>(word & 0xFF), .detail = static_cast<std::uint16_t>(word >> 16)};
}

/// The motor's error bits, without the other bits of ERR_STAT.
std::uint32_t errors_of(const AxisImage& image) {
    const MotorValue& word = image.of_motor(MotorItem::error_word);
    return word.is_known ? static_cast<std::uint32_t>(word.value) & causes::error_bits(model_of(image)) : 0;
}

bool is_followed_by(const AxisTable& table, std::span<const std::uint8_t> behind) {
    const auto shown = std::span(table.uploaded).subspan(table.bytes.size());
    return table.bytes.empty() || std::equal(shown.begin(), shown.end(), behind.begin(), behind.end());
}

AxisTable table_of(gateway::Controller& controller, std::uint32_t crc) {
    const std::span<const std::uint8_t> active = controller.tables().active();
    AxisTable table{.crc = crc, .bytes = {active.begin(), active.end()}};
    if (active.empty()) return table;
    table.uploaded = table.bytes;
    controller.set_points().show_defaults(table.uploaded, 0);
    const std::span<const std::uint8_t> behind = controller.tables().behind_active();
    table.uploaded.insert(table.uploaded.end(), behind.begin(), behind.end());
    return table;
}

std::array<std::uint8_t, 4> bytes_of(std::uint32_t value) {
    std::array<std::uint8_t, 4> bytes{};
    base::store_u32(bytes.data(), value);
    return bytes;
}

/// The equivalent message on the user port.
protocol::mactalk::Request motor_request(const Command& command) {
    const bool writes = command.kind != Kind::read_motor;
    return {.kind = writes ? protocol::mactalk::Kind::write : protocol::mactalk::Kind::read,
            .address = 0,
            .reg = command.reg,
            .length = static_cast<std::uint8_t>(command.longword ? 4 : 2),
            .value = command.value};
}

}  // namespace

void AxisLoop::poll(gateway::Controller& controller, base::Instant now, base::Instant wall,
                    const motor::AnyDriver* driver) {
    driver_ = driver;
    now_ = now;
    wall_ = wall;
    come_back_ = false;
    count(controller);
    look_for_stops(controller);
    model_.arm_loop();
    look_at_control(controller);
    let_go(controller);
    report();
    take_stops(controller);
    follow_stops(controller);
    serve_change(controller);
    take_others(controller);
    if (motor::link_is_usable(controller.motor().link())) {
        image_.motor_contact = wall;
        image_.had_contact = true;
    } else {
        forget_motor();
    }
    const bool is_wanted = model_.is_wanted(wall);
    if (!is_wanted && !model_.wants_motor(wall)) return;
    if (!reader_.is_for_face()) {
        reader_.look_around(controller, image_, now, wall, model_.wants_trend(wall));
        survey(controller);
    }
    if (is_wanted && wall >= image_.taken + AxisModel::kPeriod) take_image(controller);
}

/// For clients that ask for the cause of a standstill. An order waits while a register is read, so this is
/// done rarely: again when the shaft has stopped or the error bits have changed. For a drive of another
/// family its driver has the data.
void AxisLoop::survey(const gateway::Controller& controller) {
    constexpr base::Milliseconds kBetween{20'000};
    constexpr base::Milliseconds kAtRest{2'000};
    constexpr base::Milliseconds kAfterFailure{2'000};
    if (auto survey = reader_.take_survey();
        survey && !model_.survey_shelf().put(std::make_shared<const Survey>(std::move(*survey))))
        surveyed_ = kLongAgo;
    if (reader_.take_survey_failure()) surveyed_ = wall_ - kBetween + kAfterFailure;
    if (image_.moves) moved_ = wall_;
    const bool has_come_to_rest = moved_ > surveyed_ && wall_ - moved_ >= kAtRest;
    const std::uint32_t errors = errors_of(image_);
    const bool is_due = wall_ - surveyed_ >= kBetween || has_come_to_rest || errors != surveyed_errors_;
    if (!is_due || reader_.surveys() || !model_.wants_survey(wall_)) return;
    if (!motor::link_is_usable(controller.motor().link())) return;
    if (image_.number == 0 || image_.setting(gw::Setting::motor_kind) != 0) return;
    surveyed_ = wall_;
    surveyed_errors_ = errors;
    reader_.begin_survey(model_of(image_));
}

/// Of a motor that is lost nothing is known any more: another one may answer next, or the same one after its
/// power was off.
void AxisLoop::forget_motor() {
    for (MotorValue& value : image_.motor) value.is_old = true;
    image_.moves = false;
    surveyed_ = kLongAgo;
    reader_.hurry();
    if (model_.survey_shelf().last().taken != base::Instant{})
        static_cast<void>(model_.survey_shelf().put(std::make_shared<const Survey>()));
}

void AxisLoop::restarted() {
    if (work_ && begun_ && !ended_) ended_ = Completion{.result = Result::too_late};
    if (change_ && !change_ended_)
        change_ended_ =
            Completion{.result = change_writer_.request == 0 ? Result::too_late : Result::interrupted};
    reader_.forget();
    midi_ = {};
    tally_.restart();
    writes_seen_.reset();
    ++image_.stops;
    for (MotorValue& value : image_.motor) value.is_known = false;
    image_.moves = false;
    surveyed_ = kLongAgo;
    ++image_.restarts;
    is_restarted_ = true;
}

base::Instant AxisLoop::next(const gateway::Controller& controller) const {
    const bool looks_soon = come_back_ || ended_ || change_ || !carried_out_.empty();
    base::Instant next = std::min(seat_.ends(), looks_soon ? wall_ + kBriefly : base::kNever);
    if (work_ && !ended_) {
        const bool waits_for_motor = begun_ && reader_.is_for_face();
        next = std::min(next, waits_for_motor ? reader_.next(controller, wall_) : wall_ + kBriefly);
    }
    const bool is_wanted = model_.is_wanted(wall_);
    if (!is_wanted && !model_.wants_motor(wall_)) return next;
    if (is_wanted) next = std::min(next, image_.taken + AxisModel::kPeriod);
    return std::min(next, reader_.is_idle() ? reader_.due() : reader_.next(controller, wall_));
}

void AxisLoop::look_at_control(const gateway::Controller& controller) {
    Control control = settings_.control;
    if (settings_.remote_input) {
        const bool is_on = (controller.sequence().terminals() >> *settings_.remote_input & 1) != 0;
        control = is_on ? Control::remote : Control::local;
    }
    seat_.set_control(control);
    const std::uint32_t force_time = controller.registers().settings().get(store::Setting::force_timeout);
    seat_.set_silence(settings_.seat_silence.value_or(base::Milliseconds(force_time)));
    seat_.look(wall_);
}

/// Their clients no longer wait for these operations.
void AxisLoop::let_go(gateway::Controller& controller) {
    base::Ring<std::uint64_t, CommandDesk::kMostClients> leavers;
    if (!model_.desk().take_leavers(leavers)) come_back_ = true;
    for (; !leavers.empty(); leavers.pop()) {
        seat_.leave(leavers.front());
        if (change_ && change_->client.number == leavers.front()) {
            change_.reset();
            change_ended_.reset();
        }
        if (!work_ || work_->client.number != leavers.front()) continue;
        drop(controller);
        work_.reset();
        ended_.reset();
    }
}

void AxisLoop::drop(gateway::Controller& controller) {
    if (!begun_ || ended_) return;
    if (work_->command.kind == Kind::write_own) {
        if (controller.registers().writes_begun() == own_write_) controller.registers().drop_write();
    } else {
        reader_.drop(controller);
    }
}

/// A stop of the user port between two polls, or of a face.
void AxisLoop::look_for_stops(gateway::Controller& controller) {
    gateway::GatewayRegisters& own = controller.registers();
    const std::uint8_t writes = own.writes_begun();
    if (writes != writes_seen_.value_or(writes) && own.written() == gw::COMMAND) {
        std::array<std::uint8_t, 4> bytes{};
        own.read(gw::COMMAND, bytes, now_);
        const auto last = static_cast<gw::Command>(base::load_u32(bytes.data()));
        if (Command::of(last, now_).is_stop()) ++image_.stops;
    }
    writes_seen_ = writes;
    const bool is_enabled = controller.sequence().enabled();
    if (std::exchange(was_enabled_, is_enabled) && !is_enabled) ++image_.stops;
}

void AxisLoop::take_stops(gateway::Controller& controller) {
    for (int i = 0; i < kMostAtOnce && !told_stop_; ++i) {
        std::optional<Work> stop;
        if (!model_.desk().take(stop, true)) come_back_ = true;
        if (!stop) return;
        carry_out_stop(controller, *stop);
    }
}

/// First stops the machine; then ends the earlier commands of others as too_late.
void AxisLoop::carry_out_stop(gateway::Controller& controller, const Work& stop) {
    controller.user_port().cancel_own_write();
    if (work_ && !ended_ && work_->command.operates()) {
        drop(controller);
        ended_ = Completion{.result = Result::too_late};
    }
    if (change_ && !change_ended_ && change_writer_.request == 0)
        change_ended_ = Completion{.result = Result::too_late};
    Completion completion = write_own(controller, stop.command);
    if (settings_.tell_write && completion.result == Result::done) settings_.tell_write(stop.command);
    // A hold of a sequence that does not run is no stop; the motor may be moving all the same.
    if (completion.result == Result::not_running && controller.sequence().stop_unconfirmed())
        completion.result = Result::stop_unconfirmed;
    look_for_stops(controller);
    if (!model_.desk().drop_all_that_operates()) come_back_ = true;
    take_image(controller);
    if (completion.result == Result::done && !carried_out_.full()) {
        carried_out_.push({stop, wall_});
        return;
    }
    told_stop_ = stop;
    stop_told_ = completion;
    report();
}

/// A stop is complete when the motor has confirmed it, a hold when the sequence is held with the motor
/// stopped.
void AxisLoop::follow_stops(gateway::Controller& controller) {
    const gateway::Gateway& sequence = controller.sequence();
    for (; !carried_out_.empty() && !told_stop_; carried_out_.pop()) {
        const CarriedOut& stop = carried_out_.front();
        const bool is_hold = stop.work.command.value == static_cast<std::uint32_t>(gw::Command::hold);
        const gw::RunState state = sequence.run_state();
        const bool is_held = state == gw::RunState::held || state == gw::RunState::stopped;
        const bool is_done = !sequence.stop_unconfirmed() && (!is_hold || is_held);
        if (!is_done && wall_ - stop.at < kLongestStop) return;
        take_image(controller);
        told_stop_ = stop.work;
        stop_told_ = Completion{.result = is_done ? Result::done : Result::stop_unconfirmed};
        report();
    }
}

void AxisLoop::take_others(gateway::Controller& controller) {
    for (int i = 0; i < kMostAtOnce && !told_stop_; ++i) {
        if (!work_) {
            if (!model_.desk().take(work_, false)) come_back_ = true;
            if (!work_) return;
            if (work_->command.is_stop()) {  // it arrived after take_stops()
                const Work stop = *std::exchange(work_, std::nullopt);
                carry_out_stop(controller, stop);
                continue;
            }
            begun_ = clears_ = false;
            ended_.reset();
        }
        if (!begun_ && !ended_) begin(controller);
        if (!work_) continue;
        if (begun_ && !ended_) go_on(controller);
        if (!ended_) return;
        if (work_->command.operates()) take_image(controller);
        report();
        if (work_) return;
    }
    come_back_ = true;
}

std::optional<Completion> AxisLoop::refusal() {
    const Command& command = work_->command;
    if (wall_ - command.origin > Command::kLongestWait) return Completion{.result = Result::too_late};
    if (command.stops.value_or(image_.stops) != image_.stops) return Completion{.result = Result::too_late};
    if (!command.operates()) return std::nullopt;
    const bool takes_over = command.kind == Command::Kind::take_over_seat;
    const Seat::Verdict verdict =
        takes_over ? seat_.take_over(work_->client, wall_) : seat_.take(work_->client, wall_);
    if (verdict == Seat::Verdict::granted) return std::nullopt;
    return Completion{.result = Result::seat_taken, .detail = detail_of(verdict)};
}

void AxisLoop::begin(gateway::Controller& controller) {
    const Command& command = work_->command;
    ended_ = refusal();
    if (ended_) return;
    switch (command.kind) {
        case Kind::take_seat:
        case Kind::take_over_seat:
            ended_ = Completion{};
            return;
        case Kind::leave_seat:
            seat_.leave(work_->client.number);
            ended_ = Completion{};
            return;
        case Kind::write_own:
            if (command.reg == gw::SET_POINT_WRITE) return begin_change(controller);
            // A user port write in progress is completed first.
            if (!controller.user_port().awaits_own_write()) begin_own(controller);
            return;
        case Kind::write_motor:
        case Kind::reset_error:
        case Kind::read_motor:
            return begin_motor(controller);
    }
}

/// Stored in parallel to other commands, however long that takes; the next change waits.
void AxisLoop::begin_change(gateway::Controller& controller) {
    if (change_) return;
    change_ = std::exchange(work_, std::nullopt);
    change_writer_ = {.origin = change_->command.from, .since = now_};
    serve_change(controller);
}

void AxisLoop::serve_change(gateway::Controller& controller) {
    if (!change_ || change_ended_) return;
    const Command& command = change_->command;
    const gateway::PendingResult progress =
        controller.set_points().serve(change_writer_, std::span(command.data).first(command.size), now_);
    if (!progress) return;
    change_ended_ = completion_of(progress.word());
    take_image(controller);
    report();
}

void AxisLoop::begin_own(gateway::Controller& controller) {
    begun_ = true;
    const Command& command = work_->command;
    const auto value = bytes_of(command.value);
    const std::span<const std::uint8_t> bytes =
        command.size != 0 ? std::span(command.data).first(command.size) : std::span(value);
    controller.registers().begin_write(command.reg, bytes, now_);
    own_write_ = controller.registers().writes_begun();
    if (settings_.tell_write) settings_.tell_write(command);
}

void AxisLoop::begin_motor(gateway::Controller& controller) {
    const Command& command = work_->command;
    const bool writes = command.kind == Kind::write_motor;
    const registers::Model model = model_of(image_);
    const bool resets = command.kind == Kind::reset_error;
    if (resets && controller.registers().settings().get(store::Setting::motor_kind) != 0)
        return reset_drive(controller);
    const bool longword =
        resets ? registers::bytes_of(model, *registers::find(model, command.reg)) == 4 : command.longword;
    if (!motor::link_is_usable(controller.motor().link())) {
        ended_ = Completion{.result = Result::link_down};
    } else if (!controller.user_port().motor_allows(motor_request(command))) {
        ended_ = Completion{.result = Result::not_allowed};
    } else {
        if (writes) controller.sequence().forget_mode();
        reader_.drop(controller);
        reader_.begin({.is_write = writes, .reg = command.reg, .longword = longword, .value = command.value});
        begun_ = true;
    }
}

/// A drive of another family has no ERR_STAT to write. The loss of the link is acknowledged by the sequence
/// only.
void AxisLoop::reset_drive(gateway::Controller& controller) {
    motor::Motor& motor = controller.motor();
    if (motor.link() != motor::Link::up)
        ended_ = Completion{.result = Result::link_down};
    else if (!controller.user_port().motor_allows(motor_request(work_->command)))
        ended_ = Completion{.result = Result::not_allowed};
    else if (!motor.has_room())
        ended_ = Completion{.result = Result::busy};
    if (ended_) return;
    controller.sequence().forget_mode();
    motor.send({.command = protocol::fastmac::command_byte(protocol::fastmac::Number::reset_error)});
    ended_ = Completion{};
}

void AxisLoop::go_on(gateway::Controller& controller) {
    if (work_->command.kind == Kind::write_own) return go_on_own(controller);
    switch (reader_.poll(controller, now_)) {
        case MotorReader::State::under_way:
            return;
        case MotorReader::State::done:
            if (work_->command.kind == Kind::reset_error && !clears_) return clear_error();
            ended_ = Completion{.value = reader_.value()};
            return;
        case MotorReader::State::failed:
            ended_ = Completion{.result = Result::link_down, .detail = 1};
            return;
    }
}

/// ERR_STAT has been read: its setting bits are kept.
void AxisLoop::clear_error() {
    const registers::Model model = model_of(image_);
    const bool longword = registers::bytes_of(model, *registers::find(model, registers::ERR_STAT)) == 4;
    clears_ = true;
    reader_.begin({.is_write = true,
                   .reg = registers::ERR_STAT,
                   .longword = longword,
                   .value = reader_.value() & registers::settings_of_err_stat(model)});
}

/// RESULT stays that of the user port.
void AxisLoop::go_on_own(gateway::Controller& controller) {
    gateway::GatewayRegisters& own = controller.registers();
    if (own.writes_begun() != own_write_) {
        ended_ = Completion{.result = Result::too_late};
        return;
    }
    const std::uint32_t result = own.result();
    const gateway::PendingResult progress =
        own.poll_write(std::span(work_->command.data).first(work_->command.size), now_);
    if (!progress) return;
    own.set_result(result);
    ended_ = completion_of(progress.word());
}

/// Executes a stop, which ends at once.
Completion AxisLoop::write_own(gateway::Controller& controller, const Command& command) {
    gateway::GatewayRegisters& own = controller.registers();
    const std::uint32_t result = own.result();
    own.begin_write(command.reg, bytes_of(command.value), now_);
    const gateway::PendingResult progress = own.poll_write({}, now_);
    own.set_result(result);
    return completion_of(progress.word());
}

void AxisLoop::report() {
    const auto tell = [this](std::optional<Work>& work, std::optional<Completion>& ended) {
        if (!work || !ended) return;
        ended->id = work->id;
        if (!model_.desk().end(*work, *ended)) {
            come_back_ = true;
            return;
        }
        ++(ended->result == Result::done ? image_.commands_done : image_.commands_refused);
        work.reset();
        ended.reset();
    };
    tell(told_stop_, stop_told_);
    tell(work_, ended_);
    tell(change_, change_ended_);
}

void AxisLoop::take_image(gateway::Controller& controller) {
    gateway::GatewayRegisters& own = controller.registers();
    std::array<std::uint8_t, 128> bytes{};
    for (const Range& range : kImaged) {
        own.read(range.first, std::span(bytes).first(std::size_t{4} * range.count), now_);
        for (unsigned i = 0; i < range.count; ++i)
            image_.own[range.first + i] = base::load_u32(&bytes[std::size_t{4} * i]);
    }
    const gateway::Gateway& sequence = controller.sequence();
    image_.own[gw::FIRED_SCAN] = sequence.scans();
    image_.own[gw::FIRED_STEP] = sequence.scanned_step();
    image_.own[gw::FIRED_KEY] = sequence.scanned_key();
    if (driver_ != nullptr) image_.midi = midi_.look(*driver_, wall_);
    fill_shelves(controller);
    show_seat();
    image_.tally = tally_.tally();
    image_.taken = wall_;
    ++image_.number;
    model_.board().put(image_);
    model_.strike_bells();
}

void AxisLoop::fill_shelves(gateway::Controller& controller) {
    const std::span<const std::uint8_t> table = controller.tables().active();
    const std::uint32_t crc = image_.own[gw::TABLE_CRC];
    const AxisTable& shown = model_.table_shelf().last();
    const bool is_shown = shown.crc == crc && shown.bytes.size() == table.size() &&
                          is_followed_by(shown, controller.tables().behind_active());
    if (!is_shown && !model_.table_shelf().put(std::make_shared<const AxisTable>(table_of(controller, crc))))
        come_back_ = true;
    const bool is_new =
        is_restarted_ || model_.set_point_shelf().last().edition != controller.set_points().edition();
    if (!is_new) return;
    auto book = std::make_shared<const SetPointBook>(book_of(controller));
    is_restarted_ = !model_.set_point_shelf().put(std::move(book));
    if (is_restarted_) come_back_ = true;
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): a shared_ptr holds the book

void AxisLoop::show_seat() {
    const Sitter* holder = seat_.holder();
    image_.control = seat_.control();
    image_.holder_name.fill('\0');
    image_.holder = holder == nullptr ? 0 : holder->number;
    if (holder == nullptr) return;
    image_.holder_side = holder->side;
    holder->name.copy(image_.holder_name.data(), image_.holder_name.size() - 1);
}

}  // namespace nplc::faces
