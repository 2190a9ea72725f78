// Waiting, the trial and the roll-back.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "active_table.h"
#include "changeover.h"
#include "deployment/deployment.h"
#include "ledger.h"
#include "trial.h"

namespace nplc::deployment {

namespace gw = registers::gateway;

namespace {

constexpr base::Milliseconds kPause{5'000};

bool has_proof(std::span<const std::uint8_t> table) {
    return table.size() > gw::kProofBytes &&
           std::equal(gw::kProofMark.begin(), gw::kProofMark.end(), table.end() - gw::kProofBytes);
}

}  // namespace

/// Common conditions: a responding gateway, and a machine that may be stopped. Sets the reason otherwise.
bool Deployment::may_go_on() {
    const bool is_alive = moment_.now - active_->image().taken <= faces::AxisModel::kOld;
    const bool is_stopped = active_->image().run_state() == gw::RunState::stopped;
    if (moment_.now < not_before_) return false;
    if (!is_alive)
        waits_ = "the axis does not answer";
    else if (!is_stopped && settings_.activation == Activation::when_stopped)
        waits_ = "waits until the sequence is stopped";
    else if (!active_->image().is_set(gw::kLinkDelivers))
        waits_ = "waits for the link to the motor: whether it stands still is not known";
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
    if (active_->image().setting(gw::Setting::require_proof) != 0 && !has_proof(pieces_->artifact()))
        return end(State::failed, "it has no certificate, which setting require_proof asks for");
    begin_change();
}

/// The former table is on the disk before the new one is begun. During a trial the former table stays the
/// same.
void Deployment::begin_change() {
    waits_.clear();
    Record next = ledger_->record();
    std::vector<File> files;
    if (!next.has_former && !active_->sha256().empty()) {
        next.has_former = true;
        next.former_sha256 = active_->sha256();
        next.former_name = next.runs_name;
        files.push_back({ledger_->former_path(), active_->table()->uploaded});
    }
    next.state = State::activating;
    next.since = moment_.milliseconds;
    next.text.clear();
    save(next, std::move(files), [this] {
        stage_ = Stage::changing;
        follow_change(
            changeover_->begin({.bytes = pieces_->artifact(), .hash = order_->sha256}, moment_.now));
    });
}

void Deployment::follow_change(Outcome outcome) {
    if (stage_ != Stage::changing) return;
    waits_ = changeover_->why();
    switch (outcome) {
        case Outcome::open:
            return;
        case Outcome::put_off:  // tried again later
            not_before_ = moment_.now + kPause;
            stage_ = changeover_->is_rollback() ? Stage::failing : Stage::waiting;
            return;
        case Outcome::refused:
            return end(State::failed, "the firmware does not take it: " + changeover_->why());
        case Outcome::active:
            return activated(changeover_->is_rollback());
        case Outcome::over:
            not_before_ = {};
            trial_->go_on_at(moment_.now);
            stage_ = after_run_;
            return;
    }
}

/// The axis reports this table as the active one.
void Deployment::activated(bool was_rollback) {
    waits_.clear();
    not_before_ = {};
    trial_->reset();
    const auto finish = [this] {
        trial_->go_on_at(moment_.now);
        if (!changeover_->finish(moment_.now)) return;
        after_run_ = std::exchange(stage_, Stage::changing);
    };
    if (was_rollback) return end(State::rolled_back, std::string(ledger_->record().text), finish);
    pieces_.reset();
    move_to(State::trial, "", Stage::trial, finish);
}

void Deployment::watch() {
    if (!is_ordered_active()) return end(State::failed, "another table has been activated");
    Trial::Judgement judgement = trial_->watch(active_->image(), moment_.now);
    switch (judgement.verdict) {
        case Trial::Verdict::open:
            waits_ = std::move(judgement.text);
            return;
        case Trial::Verdict::healthy:
            return end(State::confirmed, "");
        case Trial::Verdict::failed:
            return fail_trial(judgement.text);
    }
}

void Deployment::fail_trial(const std::string& why) {
    if (!ledger_->record().has_former)
        return end(State::failed, why + "; there is no former table to go back to, it stays");
    move_to(State::failing, why, Stage::failing);
}

void Deployment::go_back() {
    const Record& record = ledger_->record();
    if (active_->is(record.former_sha256)) return activated(true);
    if (!is_ordered_active()) return end(State::failed, "another table has been activated");
    if (!may_go_on()) return;
    bool is_missing = false;
    auto former = ledger_->read_former(is_missing);
    if (!former || orders::hex(orders::sha256(*former)) != record.former_sha256)
        return end(State::failed,
                   fmt::format("{}; {} is {}, so there is nothing to go back to, it stays", record.text,
                               ledger_->former_path(), is_missing ? "missing" : "damaged"));
    const orders::Hash hash = orders::sha256(*former);
    waits_.clear();
    stage_ = Stage::changing;
    follow_change(
        changeover_->begin({.bytes = std::move(*former), .hash = hash, .is_rollback = true}, moment_.now));
}

}  // namespace nplc::deployment
