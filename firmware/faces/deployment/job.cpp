// Storing a table, its activation and its trial.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "deployment/deployment.h"
#include "disk.h"
#include "record.h"

namespace nplc::deployment {

namespace gw = registers::gateway;
using faces::Command;
using faces::Result;

namespace {

constexpr base::Milliseconds kPause{5'000};
constexpr base::Milliseconds kLongestActivation{10'000};
constexpr base::Milliseconds kBetweenTries{200};

bool has_proof(std::span<const std::uint8_t> table) {
    return table.size() > gw::kProofBytes &&
           std::equal(gw::kProofMark.begin(), gw::kProofMark.end(), table.end() - gw::kProofBytes);
}

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

bool Deployment::submit(const Command& command) {
    const auto id = client_->submit(command);
    if (id) command_ = *id;
    return id.has_value();
}

void Deployment::look_at_commands() {
    while (const auto ended = client_->take()) {
        if (ended->id != command_) continue;
        command_ = 0;
        switch (stage_) {
            case Stage::seating:
                take_seat(*ended);
                break;
            case Stage::storing:
                upload_->ended(*ended, moment_.now);
                break;
            case Stage::activating:
                try_activation(*ended);
                break;
            case Stage::running:
                end_of_run(*ended);
                break;
            default:
                break;
        }
    }
}

void Deployment::leave_seat() {
    static_cast<void>(client_->submit({.kind = Command::Kind::leave_seat, .origin = moment_.now}));
}

/// Restarts the sequence that was stopped for the order, unless anyone has stopped it since.
void Deployment::run_again() {
    if (command_ != 0 || moment_.now < not_before_) return;
    Command run = Command::of(gw::Command::run, moment_.now);
    run.stops = ran_;
    static_cast<void>(submit(run));
}

void Deployment::end_of_run(const faces::Completion& ended) {
    const bool is_short = moment_.now - since_ < kLongestActivation;
    const bool is_stopped_since = image_.stops != ran_;
    if (ended.result != Result::done && is_short && passes(ended.result) && !is_stopped_since &&
        ended.result != Result::not_stopped) {
        not_before_ = moment_.now + kBetweenTries;
        return;
    }
    if (ended.result == Result::done || ended.result == Result::not_stopped)
        ran_.reset();
    else if (is_stopped_since)
        forget_run("somebody else has stopped it, too");
    else
        forget_run(words_of(ended.result, ended.detail));
    leave_seat();
    not_before_ = {};
    trial_.watched = moment_.now;
    stage_ = after_run_;
}

/// After this stop the sequence is not restarted automatically, since a person may be at the machine.
void Deployment::forget_run(const std::string& why) {
    if (std::exchange(ran_, std::nullopt))
        note(true, fmt::format("the sequence, which was stopped for an order, is not run again: {}", why));
}

/// Common conditions: a responding gateway, and a machine that may be stopped. Sets the reason otherwise.
bool Deployment::may_go_on() {
    const bool is_alive = moment_.now - image_.taken <= faces::AxisModel::kOld;
    const bool is_stopped = image_.run_state() == gw::RunState::stopped;
    if (moment_.now < not_before_) return false;
    if (!is_alive)
        waits_ = "the axis does not answer";
    else if (!is_stopped && settings_.activation == Activation::when_stopped)
        waits_ = "waits until the sequence is stopped";
    else if (!image_.is_set(gw::kLinkDelivers))
        waits_ = "waits for the motor: nobody knows whether it stands still";
    else
        return true;
    return false;
}

void Deployment::wait() {
    if (is_ordered_active()) return end(State::confirmed, "it runs already");
    if (!may_go_on()) return;
    if (settings_.window && !settings_.window->contains(moment_.milliseconds)) {
        waits_ = fmt::format("waits for the window {}", settings_.window->text());
        return;
    }
    if (image_.setting(gw::Setting::require_proof) != 0 && !has_proof(pieces_->artifact()))
        return end(State::failed, "it has no certificate, which setting require_proof asks for");
    job_ = {.bytes = pieces_->artifact(), .hash = order_->sha256};
    begin_job();
}

/// The former table is on the disk before the new one is begun. During a trial the former table stays the
/// same.
void Deployment::begin_job() {
    waits_.clear();
    const auto ask = [this] {
        stage_ = Stage::seating;
        if (!submit({.kind = Command::Kind::take_seat, .origin = moment_.now})) give_way("too much is asked");
    };
    if (job_.is_rollback) return ask();
    Record next = *record_;
    std::vector<File> files;
    if (!next.has_former && !active_.empty()) {
        next.has_former = true;
        next.former_sha256 = active_;
        next.former_name = next.runs_name;
        files.push_back({path(kFormerFile), table_->uploaded});
    }
    next.state = State::activating;
    next.since = moment_.milliseconds;
    next.text.clear();
    save(next, std::move(files), ask);
}

/// Retried later.
void Deployment::give_way(const std::string& why) {
    waits_ = why;
    command_ = 0;
    upload_.reset();
    forget_run(why);
    leave_seat();
    not_before_ = moment_.now + kPause;
    stage_ = job_.is_rollback ? Stage::failing : Stage::waiting;
}

void Deployment::take_seat(const faces::Completion& ended) {
    if (ended.result != Result::done) return give_way(words_of(ended.result, ended.detail));
    since_ = moment_.now;
    if (image_.run_state() == gw::RunState::stopped) {
        upload_.emplace(job_.bytes, faces::Upload::Afterwards{}, 0);
        stage_ = Stage::storing;
        return;
    }
    if (settings_.activation == Activation::when_stopped)
        return give_way("waits until the sequence is stopped");
    if (image_.run_state() == gw::RunState::running) ran_ = image_.stops + 1;
    note(false, "the sequence is stopped for an order");
    static_cast<void>(client_->submit(Command::of(gw::Command::stop, moment_.now)));
    stage_ = Stage::stopping;
}

void Deployment::stop_first() {
    if (image_.run_state() != gw::RunState::stopped) {
        if (moment_.now - since_ > kLongestActivation) give_way("the sequence does not stop");
        return;
    }
    upload_.emplace(job_.bytes, faces::Upload::Afterwards{}, 0);
    stage_ = Stage::storing;
}

void Deployment::store() {
    if (upload_->is_over()) return upload_ended();
    if (command_ != 0) return;
    if (const auto command = upload_->next(image_, moment_.now)) {
        if (!submit(*command)) give_way("too much is asked");
    }
    if (upload_->is_over()) upload_ended();
}

void Deployment::upload_ended() {
    const Result result = upload_->result();
    const std::string why = words_of(result, upload_->detail());
    if (result == Result::done) {
        upload_.reset();
        since_ = moment_.now;
        stage_ = Stage::activating;
        return;
    }
    if (job_.is_rollback || passes(result)) return give_way("could not be stored: " + why);
    leave_seat();
    forget_run(why);
    end(State::failed, "the firmware does not take it: " + why);
}

void Deployment::activate() {
    if (is_active(orders::hex(job_.hash))) return activated();
    if (moment_.now - since_ > kLongestActivation)
        return give_way(waits_.empty() ? "it does not become active" : waits_);
    if (command_ != 0 || moment_.now < not_before_) return;
    static_cast<void>(submit(Command::of(gw::Command::activate, moment_.now)));
}

void Deployment::try_activation(const faces::Completion& ended) {
    if (ended.result == Result::done) {
        waits_.clear();
        not_before_ = moment_.now + kBetweenTries;
        return;
    }
    waits_ = words_of(ended.result, ended.detail);
    not_before_ = moment_.now + kBetweenTries;
    if (!passes(ended.result) || ended.result == Result::seat_taken) give_way(waits_);
}

/// The axis reports this table as the active one.
void Deployment::activated() {
    const bool runs_again = ran_ && settings_.activation == Activation::restart;
    if (!runs_again) ran_.reset();
    const bool was_rollback = job_.is_rollback;
    waits_.clear();
    not_before_ = {};
    trial_ = {};
    if (was_rollback) {
        end(State::rolled_back, std::string(record_->text));
        return run_after_saving(runs_again, Stage::idle);
    }
    pieces_.reset();
    job_ = {};
    move_to(State::trial, "", Stage::trial);
    run_after_saving(runs_again, Stage::trial);
}

void Deployment::run_after_saving(bool runs_again, Stage stage) {
    const auto told = std::exchange(saving_.then, nullptr);
    saving_.then = [this, told, runs_again, stage] {
        told();
        trial_.watched = moment_.now;
        after_run_ = stage;
        if (runs_again)
            stage_ = Stage::running;
        else
            leave_seat();
    };
}

void Deployment::watch() {
    if (!is_ordered_active()) return end(State::failed, "somebody has made another table active");
    const std::uint32_t reason = image_[gw::SAFE_REASON];
    if (!trial_.first_reason || reason == static_cast<std::uint32_t>(gw::SafeReason::none))
        trial_.first_reason = reason;
    const std::string_view why = obstacle(image_);
    if (!why.empty() && reason != *trial_.first_reason) return fail_trial(std::string(why));
    const base::Instant last = std::exchange(trial_.watched, moment_.now);
    waits_ = image_.run_state() == gw::RunState::running ? "" : "waits until the sequence runs";
    if (!waits_.empty()) return;
    trial_.ran += moment_.now - last;
    trial_.healthy += moment_.now - last;
    if (image_.is_set(gw::kMotorError)) {
        trial_.healthy = {};
        trial_.error = fmt::format("ERROR in step {} on trial", image_[gw::STEP]);
    }
    if (settings_.healthy_step && image_[gw::STEP] == *settings_.healthy_step) trial_.was_in_step = true;
    const bool has_step = !settings_.healthy_step || trial_.was_in_step;
    if (trial_.healthy >= settings_.healthy_after && has_step) return end(State::confirmed, "");
    const base::Microseconds left = settings_.healthy_within - trial_.ran;
    if (!trial_.error.empty() && left < settings_.healthy_after - trial_.healthy)
        return fail_trial(trial_.error);
    if (left.count() <= 0 && !has_step)
        fail_trial(fmt::format("step {} was not reached on trial", *settings_.healthy_step));
}

void Deployment::fail_trial(const std::string& why) {
    if (!record_->has_former)
        return end(State::failed, why + "; there is no former table to go back to, it stays");
    move_to(State::failing, why, Stage::failing);
}

void Deployment::go_back() {
    if (is_active(record_->former_sha256)) {
        job_.is_rollback = true;
        return activated();
    }
    if (!is_ordered_active()) return end(State::failed, "somebody has made another table active");
    if (!may_go_on()) return;
    bool is_missing = false;
    auto former = read_file(path(kFormerFile), orders::kMostArtifactBytes, is_missing);
    if (!former || orders::hex(orders::sha256(*former)) != record_->former_sha256)
        return end(State::failed,
                   fmt::format("{}; {} is {}, so there is nothing to go back to, it stays", record_->text,
                               path(kFormerFile), is_missing ? "missing" : "damaged"));
    job_ = {.bytes = std::move(*former), .hash = {}, .is_rollback = true};
    job_.hash = orders::sha256(job_.bytes);
    begin_job();
}

}  // namespace nplc::deployment
