#include "macreg/service.h"

#include <fmt/format.h>

#include "macreg/change.h"
#include "macreg/parameters.h"
#include "macreg/values.h"

namespace nplc::macreg {

using mactalk_client::Interrupted;
using mactalk_client::LineError;
using registers::Model;

namespace {

constexpr base::Milliseconds kLook{50};
constexpr base::Milliseconds kStopWait{10'000};
/// R: no manual says how long the flash takes.
constexpr base::Milliseconds kRestartWait{5'000};
constexpr base::Milliseconds kOrderWait{1'000};
constexpr int kOrders = 3;

/// A gateway that refuses 54h to 57h does not answer; its registers show the refusal. The motor has not
/// received the message.
[[noreturn]] void no_accept(Motor& motor, const LineError& error, Trail& trail) {
    const std::string refusal =
        error.kind() == LineError::Kind::no_answer ? gateway_refusal(motor, Asked::service) : std::string();
    if (refusal.empty()) throw LineError(error.kind(), error.what());
    if (!trail.stopped) trail.ran_in.clear();
    trail.in_safe_mode = false;
    throw NotDone(refusal);
}

void go_to_init(Motor& motor, Trail& trail) {
    try {
        motor.master().init_mode(motor.address());
    } catch (const LineError& error) {
        no_accept(motor, error, trail);
    }
}

}  // namespace

void stop_motor(Motor& motor, const std::function<bool()>& goes_on, Trail& trail) {
    trail.ran_in = mode_text(motor.model(), motor.read(registers::MODE_REG));
    go_to_init(motor, trail);
    const base::Instant end = motor.now() + kStopWait;
    const registers::Register& speed = *motor.find(registers::V_IST);
    while (motor.read(registers::MODE_REG) != kInit) {
        trail.turns = fmt::format("{} {}", speed.name, value_text(speed, motor.model(), motor.read(speed)));
        if (goes_on && !goes_on()) throw Interrupted("interrupted");
        if (motor.now() >= end)
            throw NotDone(
                "the motor was told to stop and does not become passive, also not after 10 s; is something "
                "driving its shaft, or does a sequence start it again?");
        motor.master().pause(kLook);
    }
    trail.stopped = true;
}

std::string mode_text(Model model, std::int64_t mode) {
    return value_text(*registers::find(model, registers::MODE_REG), model, mode);
}

SafeMode::SafeMode(Motor& motor, bool stop, std::function<bool()> goes_on, Trail& trail)
    : motor_(motor), trail_(trail) {
    const std::int64_t found = motor.read(registers::MODE_REG);
    was_safe_ = found == kSafe;
    if (was_safe_) return;
    if (found != kInit) {
        if (!stop)
            throw NotDone(
                fmt::format("the motor is in {} and would have to be stopped; stop it first, or say --stop",
                            mode_text(motor.model(), found)));
        stop_motor(motor, goes_on, trail);
    }
    trail.in_safe_mode = true;
    try {
        motor.master().safe_mode(motor.address());
    } catch (const LineError& error) {
        no_accept(motor, error, trail);
    }
}

SafeMode::~SafeMode() {
    if (left_ || was_safe_) return;
    try {
        motor_.master().init_mode(motor_.address());
        trail_.in_safe_mode = false;
    } catch (const std::exception&) {  // the line has failed; nothing more can be done
    }
}

void Service::look() const {
    if (goes_on_ && !goes_on_()) throw Interrupted("interrupted");
}

void Service::begin(Task task) {
    task_ = task;
    trail_ = {};
}

void Service::enter_safe() {
    begin(Task::safe_mode);
    SafeMode safe(motor_, stop_, goes_on_, trail_);
    safe.keep();
    if (mode() != kSafe)
        throw NotDone("the motor did not stay in SAFE_MODE; does another master speak to it?");
}

void Service::exit_safe() {
    begin(Task::safe_mode);
    if (mode() != kSafe)
        throw NotDone(
            fmt::format("the motor is not in SAFE_MODE but in {}", mode_text(motor_.model(), mode())));
    trail_.in_safe_mode = true;
    go_to_init(motor_, trail_);
    if (mode() == kSafe) throw NotDone("the motor did not leave SAFE_MODE");
    trail_.in_safe_mode = false;
}

/// If it is out of SAFE_MODE it has been reset: no other message does that here. False: the command was lost.
bool Service::wait_until_out_of_safe() {
    const base::Instant begun = motor_.now();
    std::string silence = "the motor does not answer any more";
    while (motor_.now() < begun + kRestartWait) {
        motor_.master().pause(kLook);
        try {
            if (mode() != kSafe) return true;
            if (motor_.now() > begun + kOrderWait) return false;
        } catch (const LineError& error) {
            if (error.kind() != LineError::Kind::no_answer) throw;
            silence = error.what();
        }
    }
    throw LineError(LineError::Kind::no_answer,
                    silence + "; if its address came back to another value, `macreg find` shows it");
}

/// 56h, 57h and MODE_REG 256 have no answer: they are repeated while the motor is still in SAFE_MODE.
void Service::order_reset(const std::function<void()>& order, const char* what) {
    SafeMode safe(motor_, stop_, goes_on_, trail_);
    look();
    for (int i = 0; i < kOrders; ++i) {
        trail_.order = Trail::Order::sent;
        order();
        if (!wait_until_out_of_safe()) continue;
        trail_.order = Trail::Order::done;
        trail_.in_safe_mode = false;
        safe.left();
        return;
    }
    trail_.order = Trail::Order::none;
    throw NotDone(fmt::format("the motor did not {}, asked {} times; it is as before", what, kOrders));
}

std::vector<std::string> Service::save() {
    begin(Task::save);
    const ParameterSet before = read_parameters(motor_, {}, goes_on_);
    order_reset([&] { motor_.master().write_flash(motor_.address()); }, "write its flash");
    const ParameterSet after = read_parameters(motor_, {}, goes_on_);
    std::vector<std::string> changed;
    for (const Difference& one : differences(before, after)) changed.push_back(one.reg->name.data());
    return changed;
}

void Service::reset() {
    begin(Task::reset);
    order_reset([&] { motor_.master().reset(motor_.address()); }, "reset");
}

void Service::defaults(bool into_flash) {
    begin(into_flash ? Task::defaults : Task::unsaved_defaults);
    if (!into_flash) return order_parameters(kFactoryDefaults, "read its defaults");
    const registers::Register& mode_reg = *motor_.find(registers::MODE_REG);
    order_reset([&] { static_cast<void>(motor_.try_write(mode_reg, kDefaultsToFlash)); },
                "read its defaults");
}

void Service::reload() {
    begin(Task::reload);
    order_parameters(kReload, "read its flash");
}

/// Reading parameters twice has no side effects.
void Service::order_parameters(std::int64_t code, const char* what) {
    SafeMode safe(motor_, stop_, goes_on_, trail_);
    look();
    const registers::Register& mode_reg = *motor_.find(registers::MODE_REG);
    for (int i = 0; i < kOrders; ++i) {
        trail_.order = Trail::Order::sent;
        if (!motor_.try_write(mode_reg, code)) continue;
        trail_.order = Trail::Order::done;
        return;
    }
    const std::string refusal = gateway_refusal(motor_, Asked::service);
    throw NotDone(refusal.empty() ? fmt::format("the motor did not accept to {}", what) : refusal);
}

std::string Trail::stop_words() const {
    if (stopped)
        return fmt::format("the motor ran in {} and was stopped: it starts again only when MODE_REG is set",
                           ran_in);
    return fmt::format(
        "the motor ran in {} and was told to stop, but HAS NOT STOPPED as far as is known{}: if it must "
        "stand, cut its power",
        ran_in, turns.empty() ? "" : " (" + turns + ")");
}

std::string Service::left_behind() const {
    struct Words {
        const char* none;
        const char* sent;
        const char* done;
    };
    // By Task.
    constexpr Words kWords[] = {
        {"", "", ""},
        {"the flash was not written",
         "the order to write the flash was sent, and whether it was written is not known: once the motor "
         "answers, see with `macreg diff` or `macreg get` which values it starts with, before it is saved "
         "again",
         "the flash was written and the motor has reset, but not all of it was compared: see `macreg diff` "
         "or `macreg get`"},
        {"parameters and flash are as they were",
         "the order to load the factory's parameters into memory and flash was sent, and whether it was "
         "carried out is not known: see `macreg diff` or `macreg get`",
         "the factory's parameters are in memory and flash, and the motor has reset"},
        {"the parameters are as they were",
         "the order to load the factory's parameters was sent, and whether it was carried out is not known: "
         "see `macreg get`; the flash is as it was",
         "the factory's parameters are in memory, the flash is as it was"},
        {"the parameters are as they were",
         "the order to read the flash was sent, and whether it was carried out is not known: see `macreg "
         "get`; the flash is as it was",
         "the flash's parameters are in memory"},
        {"the motor was not reset; its memory is as it was",
         "the order to reset was sent, and whether it was carried out is not known: after a reset what was "
         "not saved is gone, see `macreg get`",
         "the motor has reset"},
    };
    const Words& words = kWords[static_cast<std::size_t>(task_)];
    std::string text = trail_.order == Trail::Order::none   ? words.none
                       : trail_.order == Trail::Order::sent ? words.sent
                                                            : words.done;
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
    const bool resets = task_ == Task::save || task_ == Task::defaults || task_ == Task::reset;
    if (!trail_.ran_in.empty() && !(resets && trail_.order == Trail::Order::done)) add(trail_.stop_words());
    if (trail_.in_safe_mode)
        add("the motor may be in SAFE_MODE, deaf to FastMAC: see `macreg get MODE_REG`; `macreg safe exit` "
            "takes it out");
    return text.empty() ? "the motor's mode is as it was" : text;
}

}  // namespace nplc::macreg
