#include "changeover.h"

#include <fmt/format.h>

#include <utility>

namespace nplc::deployment {

namespace gw = registers::gateway;
using faces::Command;
using faces::Result;

namespace {

constexpr base::Milliseconds kLongestActivation{10'000};
constexpr base::Milliseconds kBetweenTries{200};

/// Temporary: another client is active, or it is not possible at present.
bool passes(Result result) {
    switch (result) {
        case Result::busy:
        case Result::not_stopped:
        case Result::moving:
        case Result::link_down:
        case Result::no_upload:
        case Result::bad_offset:
        case Result::too_late:
        case Result::seat_taken:
        case Result::not_allowed:
        case Result::nothing_stored:
            return true;
        default:
            return false;
    }
}

std::string words_of(Result result, std::uint16_t detail) {
    const bool is_of_term = result >= Result::table_no_end && result <= Result::not_for_motor;
    return is_of_term ? fmt::format("term {}: {}", detail, gw::describe(result))
                      : std::string(gw::describe(result));
}

}  // namespace

Outcome Changeover::begin(Job job, base::Instant now) {
    job_ = std::move(job);
    why_.clear();
    not_before_ = {};
    phase_ = Phase::seating;
    if (!submit({.kind = Command::Kind::take_seat, .origin = now})) return give_way("too much is asked", now);
    return Outcome::open;
}

bool Changeover::submit(const Command& command) {
    const auto id = client_->submit(command);
    if (id) command_ = *id;
    return id.has_value();
}

Outcome Changeover::look_at_commands(const faces::AxisImage& image, base::Instant now) {
    Outcome outcome = Outcome::open;
    while (const auto ended = client_->take()) {
        if (ended->id != command_) continue;
        command_ = 0;
        switch (phase_) {
            case Phase::seating:
                outcome = stop(*ended, image, now);
                break;
            case Phase::storing:
                upload_->ended(*ended, now);
                break;
            case Phase::activating:
                outcome = activation_ended(*ended, now);
                break;
            case Phase::running:
                outcome = run_ended(*ended, image, now);
                break;
            default:
                break;
        }
    }
    return outcome;
}

Outcome Changeover::tick(const ActiveTable& active, base::Instant now) {
    switch (phase_) {
        case Phase::stopping:
            return await_stop(active.image(), now);
        case Phase::storing:
            return store(active.image(), now);
        case Phase::activating:
            return activate(active, now);
        case Phase::running:
            run(now);
            return Outcome::open;
        default:
            return Outcome::open;
    }
}

void Changeover::leave_seat(base::Instant now) {
    static_cast<void>(client_->submit({.kind = Command::Kind::leave_seat, .origin = now}));
}

/// After this stop the sequence is not restarted automatically, since a person may be at the machine.
void Changeover::forget_run(const std::string& why) {
    if (std::exchange(ran_, std::nullopt))
        note_(true, fmt::format("the sequence, which was stopped for an order, is not run again: {}", why));
}

Outcome Changeover::give_way(const std::string& why, base::Instant now) {
    why_ = why;
    command_ = 0;
    upload_.reset();
    phase_ = Phase::none;
    forget_run(why_);
    leave_seat(now);
    return Outcome::put_off;
}

/// The seat was requested.
Outcome Changeover::stop(const faces::Completion& ended, const faces::AxisImage& image, base::Instant now) {
    if (ended.result != Result::done) return give_way(words_of(ended.result, ended.detail), now);
    since_ = now;
    if (image.run_state() == gw::RunState::stopped) {
        begin_upload();
        return Outcome::open;
    }
    if (activation_ == Activation::when_stopped) return give_way("waits until the sequence is stopped", now);
    if (image.run_state() == gw::RunState::running) ran_ = image.stops + 1;
    note_(false, "the sequence is stopped for an order");
    static_cast<void>(client_->submit(Command::of(gw::Command::stop, now)));
    phase_ = Phase::stopping;
    return Outcome::open;
}

Outcome Changeover::await_stop(const faces::AxisImage& image, base::Instant now) {
    if (image.run_state() == gw::RunState::stopped)
        begin_upload();
    else if (now - since_ > kLongestActivation)
        return give_way("the sequence does not stop", now);
    return Outcome::open;
}

void Changeover::begin_upload() {
    upload_.emplace(job_.bytes, faces::Upload::Afterwards{}, 0);
    phase_ = Phase::storing;
}

Outcome Changeover::store(const faces::AxisImage& image, base::Instant now) {
    if (upload_->is_over()) return upload_ended(now);
    if (command_ != 0) return Outcome::open;
    if (const auto command = upload_->next(image, now)) {
        if (!submit(*command)) return give_way("too much is asked", now);
    }
    return upload_->is_over() ? upload_ended(now) : Outcome::open;
}

Outcome Changeover::upload_ended(base::Instant now) {
    const Result result = upload_->result();
    const std::string why = words_of(result, upload_->detail());
    upload_.reset();
    if (result == Result::done) {
        since_ = now;
        phase_ = Phase::activating;
        return Outcome::open;
    }
    if (job_.is_rollback || passes(result)) return give_way("could not be stored: " + why, now);
    phase_ = Phase::none;
    why_ = why;
    leave_seat(now);
    forget_run(why);
    return Outcome::refused;
}

Outcome Changeover::activate(const ActiveTable& active, base::Instant now) {
    if (active.is(orders::hex(job_.hash))) {
        phase_ = Phase::none;
        why_.clear();
        job_.bytes.clear();
        if (activation_ != Activation::restart) ran_.reset();
        return Outcome::active;
    }
    if (now - since_ > kLongestActivation)
        return give_way(why_.empty() ? "it does not become active" : std::string(why_), now);
    if (command_ == 0 && now >= not_before_)
        static_cast<void>(submit(Command::of(gw::Command::activate, now)));
    return Outcome::open;
}

Outcome Changeover::activation_ended(const faces::Completion& ended, base::Instant now) {
    not_before_ = now + kBetweenTries;
    why_ = ended.result == Result::done ? std::string() : words_of(ended.result, ended.detail);
    if (ended.result == Result::done) return Outcome::open;
    if (!passes(ended.result) || ended.result == Result::seat_taken) return give_way(std::string(why_), now);
    return Outcome::open;
}

bool Changeover::finish(base::Instant now) {
    since_ = now;
    not_before_ = {};
    phase_ = ran_ ? Phase::running : Phase::none;
    if (!ran_) leave_seat(now);
    return ran_.has_value();
}

void Changeover::run(base::Instant now) {
    if (command_ != 0 || now < not_before_) return;
    Command run = Command::of(gw::Command::run, now);
    run.stops = ran_;
    static_cast<void>(submit(run));
}

Outcome Changeover::run_ended(const faces::Completion& ended, const faces::AxisImage& image,
                              base::Instant now) {
    const bool is_short = now - since_ < kLongestActivation;
    const bool is_stopped_since = image.stops != ran_;
    if (ended.result != Result::done && is_short && passes(ended.result) && !is_stopped_since &&
        ended.result != Result::not_stopped) {
        not_before_ = now + kBetweenTries;
        return Outcome::open;
    }
    if (ended.result == Result::done || ended.result == Result::not_stopped)
        ran_.reset();
    else if (is_stopped_since)
        forget_run("another client has stopped it since");
    else
        forget_run(words_of(ended.result, ended.detail));
    leave_seat(now);
    phase_ = Phase::none;
    return Outcome::over;
}

}  // namespace nplc::deployment
