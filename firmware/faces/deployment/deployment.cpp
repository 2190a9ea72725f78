// Received orders, and the stages in their sequence.
#include "deployment/deployment.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "active_table.h"
#include "changeover.h"
#include "ledger.h"
#include "orders/keys.h"
#include "sequencer/table.h"
#include "trial.h"

namespace nplc::deployment {

namespace {

std::string title_of(const orders::Order& order) {
    return fmt::format("order {} (table {})", order.counter, order.name);
}

std::string hash_of(std::string_view text) {
    return orders::hex(orders::sha256(text));
}

}  // namespace

Deployment::Deployment(const Settings& settings, std::string target, faces::AxisModel& axis,
                       faces::Bell& bell, Tell tell)
    : settings_(settings),
      target_(std::move(target)),
      axis_(axis),
      note_([tell = std::move(tell), name = axis.name()](bool is_error, const std::string& text) {
          if (tell) tell(is_error, fmt::format("{}: {}", name, text));
      }),
      ledger_(std::make_unique<Ledger>(fmt::format("{}/{}", settings.folder, axis.name()), note_)),
      active_(std::make_unique<ActiveTable>()),
      trial_(std::make_unique<Trial>(settings_)) {
    if (!settings_.takes_orders()) return;
    auto client = axis.join(faces::Side::plant, "order", bell);
    if (client) changeover_ = std::make_unique<Changeover>(settings_.activation, std::move(client), note_);
    ledger_->read();
    auto order = orders::read_order(ledger_->record().order);
    if (!order.order) return;
    order_ = std::move(order.order->order);
    order_hash_ = hash_of(ledger_->record().order);
}

Deployment::~Deployment() = default;

void Deployment::refuse(const std::string& text) {
    ++refusals_.count;
    refusals_.at = moment_.milliseconds;
    const std::string line = "an order is refused: " + text;
    if (line == refusals_.last) return;
    refusals_.last = line;
    note_(true, line);
}

/// Empty: the order is accepted.
std::string Deployment::why_not(const orders::SignedOrder& order) const {
    if (order.order.target != target_) return fmt::format("it is for {}", order.order.target);
    const orders::TrustedKeys trusted = orders::read_trusted(settings_.keys);
    if (!trusted.error.empty()) return trusted.error;
    const orders::TrustedKey* key = trusted.find(order.order.key);
    if (key == nullptr)
        return fmt::format("its key {} is not in {}", orders::hex(order.order.key), settings_.keys);
    if (!orders::is_signed(order.message, order.signature, key->key))
        return fmt::format("its signature is not of key {}", key->name);
    const std::uint64_t last = ledger_->last_counter();
    if (order.order.counter <= last)
        return fmt::format("its counter {} is not greater than the last one, {}", order.order.counter, last);
    return {};
}

void Deployment::take_order(std::string_view text, const Moment& moment) {
    moment_ = moment;
    if (!changeover_ || text.empty()) return;  // empty: a retained order was cleared
    const orders::OrderReading read = orders::read_order(text);
    if (!read.order) return refuse("it " + read.error);
    const std::string hash = hash_of(text);
    if (hash == order_hash_ || text == next_order_) return;  // a retained order received again
    if (!ledger_->damage().empty()) return refuse(ledger_->damage());
    if (const std::string why = why_not(*read.order); !why.empty()) return refuse(why);
    if (may_be_replaced()) return accept(*read.order, std::string(text));
    const auto waiting = orders::read_order(next_order_);
    if (waiting.order && waiting.order->order.counter >= read.order->order.counter)
        return refuse(fmt::format("order {} came before it", waiting.order->order.counter));
    next_order_ = text;
}

/// No operation is in progress that must be completed first.
bool Deployment::may_be_replaced() const {
    switch (stage_) {
        case Stage::idle:
        case Stage::fetching:
        case Stage::waiting:
        case Stage::trial:
        case Stage::failing:
            return true;
        default:
            return false;
    }
}

void Deployment::accept(const orders::SignedOrder& order, const std::string& text) {
    Record next = ledger_->record();
    next.counter = order.order.counter;
    next.order = text;
    next.state = State::fetching;
    next.text.clear();
    next.since = moment_.milliseconds;
    order_ = order.order;
    order_hash_ = hash_of(text);
    pieces_ = std::make_unique<orders::Pieces>(order_->sha256, order_->bytes);
    save(next, {}, [this] {
        note_(false, fmt::format("{} is taken", title_of(*order_)));
        stage_ = is_ordered_active() ? Stage::waiting : Stage::fetching;
    });
}

const orders::Hash* Deployment::wanted() const {
    const bool awaits = stage_ == Stage::fetching && pieces_ && pieces_->artifact().empty();
    return awaits ? &pieces_->hash() : nullptr;
}

void Deployment::take_piece(const orders::Hash& hash, std::size_t number,
                            std::span<const std::uint8_t> piece) {
    const orders::Hash* awaited = wanted();
    if (awaited == nullptr || *awaited != hash) return;
    using Verdict = orders::Pieces::Verdict;
    switch (pieces_->take(number, piece)) {
        case Verdict::taken:
            return;
        case Verdict::whole:
            return look_at_artifact();
        case Verdict::not_one:
            waits_ = fmt::format("piece {} has a length that it cannot have; it must come again", number);
            break;
        case Verdict::wrong_whole:
            waits_ = "the pieces do not fit the order's hash; all must come again";
            break;
    }
    note_(true, fmt::format("{}: {}", title_of(*order_), waits_));
}

/// Checks made by the firmware during the upload are not repeated here.
void Deployment::look_at_artifact() {
    const std::vector<std::uint8_t>& bytes = pieces_->artifact();
    const auto loaded = sequencer::Table::load(bytes);
    if (!loaded.ok)
        return end(State::failed, fmt::format("it is no table: term {}: {}", loaded.fault.term,
                                              sequencer::describe(loaded.fault.error)));
    waits_.clear();
    stage_ = Stage::waiting;
}

void Deployment::save(const Record& next, std::vector<File> files, std::function<void()> then) {
    stage_ = Stage::saving;
    ledger_->save(next, std::move(files), [this, then = std::move(then)] {
        not_before_ = {};
        stage_ = Stage::idle;
        if (then) then();
    });
}

void Deployment::move_to(State state, const std::string& text, Stage stage, std::function<void()> then) {
    Record next = ledger_->record();
    next.state = state;
    next.text = text;
    next.since = moment_.milliseconds;
    if (orders::is_final(state)) next.has_former = false;
    waits_.clear();
    save(next, {}, [this, stage, state, text, then = std::move(then)] {
        stage_ = stage;
        const bool is_bad = state == State::failed || state == State::rolled_back || state == State::failing;
        note_(is_bad, fmt::format("{}: {}{}{}", title_of(*order_), orders::name_of(state),
                                  text.empty() ? "" : ": ", text));
        if (then) then();
    });
}

void Deployment::end(State state, const std::string& text, std::function<void()> then) {
    pieces_.reset();
    move_to(state, text, Stage::idle, std::move(then));
}

bool Deployment::is_ordered_active() const {
    return order_ && active_->is(orders::hex(order_->sha256));
}

/// Tracks which table runs and since when; this is stored too.
void Deployment::follow_table() {
    active_->read(axis_, moment_.now);
    if (!active_->is_known() || !changeover_ || ledger_->is_saving() || !ledger_->damage().empty()) return;
    const Record& record = ledger_->record();
    if (stage_ == Stage::idle && ledger_->has_unsaved()) save(record, {}, {});
    if (record.runs_sha256 == active_->sha256()) return;
    std::string name;
    if (active_->is(record.former_sha256)) name = record.former_name;
    if (is_ordered_active()) name = order_->name;
    const std::uint64_t since = active_->sha256().empty() ? 0 : moment_.milliseconds;
    ledger_->set_running(active_->sha256(), name, since);
}

void Deployment::tick(const Moment& moment) {
    moment_ = moment;
    follow_table();
    if (!changeover_) return;
    ledger_->look_at_disk(moment_.now);
    follow_change(changeover_->look_at_commands(active_->image(), moment_.now));
    if (ledger_->is_saving() || !active_->is_known()) return;
    if (!next_order_.empty() && may_be_replaced()) return take_next();
    switch (stage_) {
        case Stage::starting:
            return take_up();
        case Stage::waiting:
            return wait();
        case Stage::changing:
            return follow_change(changeover_->tick(*active_, moment_.now));
        case Stage::trial:
            return watch();
        case Stage::failing:
            return go_back();
        default:
            return;
    }
}

void Deployment::take_next() {
    const std::string text = std::exchange(next_order_, {});
    const auto read = orders::read_order(text);
    if (!read.order) return;
    const std::string why = why_not(*read.order);
    why.empty() ? accept(*read.order, text) : refuse(why);
}

/// Continues from the state left by an earlier process.
void Deployment::take_up() {
    stage_ = Stage::idle;
    if (!ledger_->damage().empty() || !order_ || orders::is_final(ledger_->record().state)) return;
    switch (ledger_->record().state) {
        case State::trial:
            stage_ = Stage::trial;
            trial_->go_on_at(moment_.now);
            return;
        case State::failing:
            stage_ = Stage::failing;
            return;
        case State::activating:
            if (is_ordered_active()) return activated(false);
            break;
        default:
            break;
    }
    const auto trusted = orders::read_trusted(settings_.keys);
    if (trusted.error.empty() && trusted.find(order_->key) == nullptr)
        return end(State::failed, "its key is not trusted any more");
    pieces_ = std::make_unique<orders::Pieces>(order_->sha256, order_->bytes);
    stage_ = is_ordered_active() ? Stage::waiting : Stage::fetching;
}

}  // namespace nplc::deployment
