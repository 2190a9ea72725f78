#include "sim/world.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/motor_stage.h"

namespace nplc::sim {
namespace {

MacMotorOptions motor_options(const WorldOptions& options) {
    MacMotorOptions result;
    result.baud = static_cast<std::int32_t>(options.baud);
    result.old_register_codes = options.old_register_codes;
    result.depth = options.depth;
    result.load = options.load;
    return result;
}

/// The gateway's settings while nothing is stored.
store::SettingValues initial_settings(const WorldOptions& options) {
    store::SettingValues values = gateway::values_of(options.gateway);
    const auto set = [&values](store::Setting setting, std::uint32_t value) {
        static_cast<void>(values.set(setting, value));
    };
    set(store::Setting::motor_address, motor_options(options).address);
    set(store::Setting::motor_baud, options.baud);
    set(store::Setting::user_baud, options.user_baud);
    set(store::Setting::motor_is_mac800, options.motor == registers::Model::mac800 ? 1 : 0);
    set(store::Setting::safe_communication, options.safe_communication ? 1 : 0);
    set(store::Setting::old_register_codes, options.old_register_codes ? 1 : 0);
    if (options.drive) set(store::Setting::motor_kind, options.drive->model->motor_kind);
    return values;
}

}  // namespace

World::World(std::vector<std::uint8_t> table, const WorldOptions& options)
    : table_(std::move(table)),
      options_(options),
      line_(options.baud, options.seed),
      mac_(options.motor, motor_options(options)),
      user_line_(options.user_baud, options.seed),
      mactalk_line_(19'200, options.seed),
      next_sample_(mac_.sample_period()) {
    line_.to_motor().set_faults(options.faults);
    line_.from_motor().set_faults(options.faults);
    if (!options.drive) store(mac_, options.registers);
    if (options.drive) drive_ = make_virtual_drive(*options.drive, options.faults);
    if (drive_) {
        for (const StoredRegister& parameter : options.registers) drive_->store(parameter);
        motor_powered_ = false;
        next_sample_ = drive_->sample_period();
    }
    start_gateway(gateway::StartCause::power_up);
}

void World::start_gateway(gateway::StartCause cause) {
    const bool first = !controller_;
    ++starts_;
    const bool uploaded =
        controller_ && tables().upload_state() == static_cast<std::uint32_t>(store::Phase::done);
    if (uploaded) table_.clear();
    on_their_way_.clear();
    followed_ = {};
    lose_set_points();
    ports::Storage& storage = options_.storage != nullptr ? *options_.storage : flash_;
    settings_.emplace(storage, kSettingsArea);
    settings_->start(initial_settings(options_));
    line_.set_rates(settings_->get(store::Setting::motor_baud), options_.baud);
    const std::uint32_t user_baud = settings_->get(store::Setting::user_baud);
    user_line_.set_rates(user_baud, user_baud);
    start_driver();
    const gateway::Controller::Ports ports{
        .inputs = board_,
        .outputs = board_,
        .watchdog = board_,
        .motor = *motor_,
        .storage = storage,
        .user_line = options_.user_submits ? nullptr : &user_line_.port(),
        .motor_mactalk_line = options_.motor_mactalk_wired ? &mactalk_line_.port() : nullptr,
        .set_points = &kSetPointArea};
    controller_.emplace(ports, kTableArea, table_memory_, *settings_, cause);
    if (options_.polling != Polling::steadily) controller_->sequence().pace(base::Microseconds(250));
    controller_->sequence().observe(this);
    if (options_.is_new) settings_->keep_mark(cause == gateway::StartCause::watchdog);
    start_table(first);
}

void World::start_driver() {
    motor::DriverSettings settings = gateway::driver_settings_of(settings_->values());
    settings.motor_kind = drive_ ? options_.drive->model->motor_kind : std::uint8_t{0};
    if (drive_) drive_->complete(settings);
    motor_ = &driver_.start(drive_ ? drive_->ports() : motor::DriverPorts{.serial = &line_.port()}, settings);
}

void World::start_table(bool first) {
    if (!table_.empty()) {
        const auto result = controller_->tables().use(table_, instant());
        if (first) load_result_ = result;
        return;
    }
    controller_->tables().start(instant());
    load_result_.ok = true;
}

std::uint8_t World::gateway_address() const {
    return static_cast<std::uint8_t>(settings_->at_start(store::Setting::gateway_address));
}

std::uint8_t World::motor_address() const {
    return static_cast<std::uint8_t>(settings_->at_start(store::Setting::motor_address));
}

base::Instant World::instant() const {
    return base::Instant{std::chrono::duration_cast<base::Microseconds>(now_)};
}

Time World::next_event() const {
    Time next = std::min(next_poll_, next_sample_);
    const auto consider = [&](std::optional<Time> time) {
        if (time) next = std::min(next, *time);
    };
    consider(next_of_motor());
    for (const VirtualSerialLine* line : {&user_line_, &mactalk_line_}) {
        consider(line->to_motor().next_arrival());
        consider(line->from_motor().next_arrival());
        if (line->has_waiting()) next = std::min(next, line->to_motor().busy_until());
    }
    if (!waiting_.user.empty()) next = std::min(next, user_line_.from_motor().busy_until());
    return std::max(next, now_);
}

std::string_view World::why_not() const {
    if (load_result_.ok || !drive_ || load_result_.fault.error != base::Error::not_for_motor) return {};
    const auto loaded = sequencer::Table::load(table_);
    if (!loaded.ok) return {};
    const auto order = sequencer::order_of(loaded.table.term(load_result_.fault.term));
    const registers::DriveModel& model = *options_.drive->model;
    return order.is_register_write
               ? model.family->refuses_write(model, order.reg, order.longword, order.value)
               : model.family->refuses_command(model, order.command);
}

Time World::next_of_motor() const {
    if (drive_) return drive_->next_event(now_);
    Time next = line_.to_motor().next_arrival().value_or(Time::max());
    next = std::min(next, line_.from_motor().next_arrival().value_or(Time::max()));
    if (line_.has_waiting()) next = std::min(next, line_.to_motor().busy_until());
    return motor_powered_ ? std::min(next, motor_asks_) : next;
}

void World::step(Time limit) {
    const Time event = next_event();
    now_ = std::max(now_, std::min(event, limit));
    if (event > limit) return;
    if (now_ >= next_sample_) sample_motor();
    move_characters();
    move_user_characters();
    move_mactalk_characters();
    if (now_ >= next_poll_) poll_gateway();
}

void World::move_characters() {
    if (drive_) {
        if (drive_->service(now_)) next_poll_ = now_;
        return;
    }
    while (const auto byte = line_.to_motor().take(now_)) {
        if (motor_powered_) mac_.receive(byte->value, byte->framing_error, instant());
    }
    if (line_.service(now_)) next_poll_ = now_;
    if (!motor_powered_ || now_ < motor_asks_ || !line_.from_motor().free(now_)) return;
    if (const auto byte = mac_.transmit(instant())) {
        line_.from_motor().start(*byte, now_);
        motor_asks_ = line_.from_motor().busy_until();
    } else {
        motor_asks_ = now_ + kPollPeriod;
    }
}

/// Serviced only when the firmware polls anyway, so that the user line does not change the firmware's timing.
void World::move_user_characters() {
    if (!waiting_.user.empty() && user_line_.from_motor().free(now_)) {
        user_line_.from_motor().start(waiting_.user.front(), now_);
        waiting_.user.pop_front();
    }
    if (user_line_.service(now_)) wake();
    while (const auto byte = user_line_.to_motor().take(now_)) user_received_.push_back(byte->value);
}

void World::move_mactalk_characters() {
    if (!options_.motor_mactalk_wired) return;
    if (mactalk_line_.service(now_)) wake();
    while (const auto byte = mactalk_line_.to_motor().take(now_)) {
        if (motor_powered_) mac_.receive_mactalk(byte->value, byte->framing_error);
    }
    if (!motor_powered_ || !mactalk_line_.from_motor().free(now_)) return;
    if (const auto byte = mac_.transmit_mactalk()) mactalk_line_.from_motor().start(*byte, now_);
}

void World::sample_motor() {
    if (drive_) {
        next_sample_ += drive_->sample_period();
        if (std::exchange(motor_fails_, false) && !drive_->fail())
            log(lacks(*options_.drive->model, "a failure"));
        move_characters();
        return drive_->sample();
    }
    next_sample_ += mac_.sample_period();
    if (!motor_powered_) return mac_.coast();
    mac_.sample();
    if (std::exchange(motor_fails_, false)) mac_.overload();
}

void World::wake() {
    if (options_.polling != Polling::steadily) next_poll_ = now_;
}

Time World::next_poll() {
    const Time steadily = now_ + kPollPeriod;
    if (options_.polling == Polling::steadily) return steadily;
    const base::Instant due = std::min(controller_->next_poll(instant(), driver_.next_poll(instant())),
                                       instant() + kWatchdogTime / 2);
    const Time at = std::max<Time>(now_, due.time_since_epoch());
    return options_.polling == Polling::at_need ? at : std::min(at, steadily);
}

void World::poll_gateway() {
    ++polls_;
    serve_set_points();
    if (renews_forces_) controller_->sequence().renew_forces(instant());
    controller_->poll(instant());
    renews_forces_ = renews_forces_ && controller_->sequence().forces().any();
    follow_orders();
    line_.service(now_);
    if (drive_) drive_->service(now_);
    user_line_.service(now_);
    mactalk_line_.service(now_);
    next_poll_ = next_poll();
    if (!waiting_.set_points.empty())
        next_poll_ = std::min(next_poll_, now_ + Time(std::chrono::milliseconds(1)));
    if (board_.watchdog_bites(instant())) start_gateway(gateway::StartCause::watchdog);
    if (controller_->reset_asked()) start_gateway(gateway::StartCause::power_up);
}

/// The driver executes orders in sequence, and drops either all that wait behind the one in progress, or all.
void World::follow_orders() {
    const motor::Counters counters = motor_->counters();
    if (counters.orders == followed_.orders && counters.discarded == followed_.discarded) return;
    for (; followed_.orders != counters.orders && !on_their_way_.empty(); ++followed_.orders) {
        on_their_way_.pop_front();
    }
    const std::size_t given_up =
        std::min<std::size_t>(counters.discarded - followed_.discarded, on_their_way_.size());
    on_their_way_.resize(on_their_way_.size() - given_up);
    followed_ = counters;
}

Snapshot World::take_snapshot() {
    const sequencer::State& state = controller_->sequence().state();
    Snapshot snapshot{.time = now_,
                      .step = state.step,
                      .timer = state.timer,
                      .counter = state.counter,
                      .inputs = board_.inputs(),
                      .outputs = board_.outputs(),
                      .in_position = motor_->in_position(),
                      .error = motor_->error(),
                      .p_ist = mac_.p_ist(),
                      .v_ist = mac_.v_ist(),
                      .shaft = mac_.plant().counts(),
                      .torque = mac_.torque(),
                      .link_up = motor::link_is_usable(motor_->link()),
                      .running = controller_->sequence().run_state() == gateway::RunState::running,
                      .orders = std::exchange(orders_, {})};
    for (std::size_t i = 0; i < controller_->set_points().record().count(); ++i) {
        const auto reg = static_cast<std::uint8_t>(registers::gateway::SET_POINT + i);
        snapshot.set_points[i] = static_cast<std::int32_t>(controller_->set_points().value(reg));
    }
    if (drive_) drive_->fill(snapshot);
    return snapshot;
}

void World::ordered(base::Instant now, const sequencer::MotorOrder& order) {
    if (options_.observer != nullptr) options_.observer->ordered(now, order);
    orders_.push_back({order.is_register_write, order.command, order.reg, order.value});
    on_their_way_.push_back(orders_given_++);
}

void World::scanned(base::Instant now, const sequencer::State& before, sequencer::InputImage image,
                    const sequencer::State& after) {
    if (options_.observer != nullptr) options_.observer->scanned(now, before, image, after);
}

}  // namespace nplc::sim
