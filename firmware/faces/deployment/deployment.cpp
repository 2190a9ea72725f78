// Received orders, and the stored record.
#include "deployment/deployment.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "disk.h"
#include "orders/keys.h"
#include "record.h"
#include "sequencer/table.h"

namespace nplc::deployment {

namespace gw = registers::gateway;

namespace {

constexpr const char* kRecordFile = "orders";
constexpr base::Milliseconds kBetweenWrites{5'000};

std::vector<std::uint8_t> bytes_of(const std::string& text) {
    return {text.begin(), text.end()};
}

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
      tell_(std::move(tell)),
      disk_(std::make_unique<Disk>()),
      record_(std::make_unique<Record>()) {
    if (!settings_.takes_orders()) return;
    client_ = axis.join(faces::Side::plant, "order", bell);
    read_stored();
}

Deployment::~Deployment() = default;

std::string Deployment::path(const char* file) const {
    return fmt::format("{}/{}/{}", settings_.folder, axis_.name(), file);
}

/// A stored former table implies that there was a record.
void Deployment::read_stored() {
    bool is_missing = false;
    bool has_no_former = false;
    const auto bytes = read_file(path(kRecordFile), kLongestRecord, is_missing);
    static_cast<void>(read_file(path(kFormerFile), orders::kMostArtifactBytes, has_no_former));
    if (is_missing && has_no_former) return;
    auto record =
        bytes ? read_record({reinterpret_cast<const char*>(bytes->data()), bytes->size()}) : std::nullopt;
    if (!record) {
        damage_ = fmt::format(
            "{} is {}: nobody knows which orders came before; see what runs, then remove it and {}, and only "
            "then give a new order",
            path(kRecordFile), is_missing ? "missing" : "damaged", path(kFormerFile));
        return note(true, damage_);
    }
    *record_ = std::move(*record);
    auto order = orders::read_order(record_->order);
    if (!order.order) return;
    order_ = std::move(order.order->order);
    order_hash_ = hash_of(record_->order);
}

void Deployment::note(bool is_error, const std::string& text) const {
    if (tell_) tell_(is_error, fmt::format("{}: {}", axis_.name(), text));
}

void Deployment::refuse(const std::string& text) {
    ++refusals_.count;
    refusals_.at = moment_.milliseconds;
    const std::string line = "an order is refused: " + text;
    if (line == refusals_.last) return;
    refusals_.last = line;
    note(true, line);
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
    const std::uint64_t last = std::max(record_->counter, saving_.record ? saving_.record->counter : 0);
    if (order.order.counter <= last)
        return fmt::format("its counter {} is not greater than the last one, {}", order.order.counter, last);
    return {};
}

void Deployment::take_order(std::string_view text, const Moment& moment) {
    moment_ = moment;
    if (!client_ || text.empty()) return;  // empty: a retained order was cleared
    const orders::OrderReading read = orders::read_order(text);
    if (!read.order) return refuse("it " + read.error);
    const std::string hash = hash_of(text);
    if (hash == order_hash_ || text == next_order_) return;  // a retained order received again
    if (!damage_.empty()) return refuse(damage_);
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
    Record next = *record_;
    next.counter = order.order.counter;
    next.order = text;
    next.state = State::fetching;
    next.text.clear();
    next.since = moment_.milliseconds;
    order_ = order.order;
    order_hash_ = hash_of(text);
    pieces_ = std::make_unique<orders::Pieces>(order_->sha256, order_->bytes);
    save(next, {}, [this] {
        note(false, fmt::format("{} is taken", title_of(*order_)));
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
    note(true, fmt::format("{}: {}", title_of(*order_), waits_));
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
    saving_.record = std::make_unique<Record>(next);
    files.push_back({path(kRecordFile), bytes_of(write_record(next))});
    saving_.files = std::move(files);
    saving_.then = std::move(then);
    stage_ = Stage::saving;
    disk_->write(saving_.files);
}

/// Failed writes are retried; until then nothing that depends on them is done.
void Deployment::look_at_disk() {
    if (!saving_.record) return;
    if (!disk_->is_busy()) {
        if (moment_.now >= not_before_) disk_->write(saving_.files);
        return;
    }
    const auto ended = disk_->take_end();
    if (!ended) return;
    if (!ended->empty()) {
        if (*ended != saving_.error) note(true, *ended + "; tried again");
        saving_.error = *ended;
        not_before_ = moment_.now + kBetweenWrites;
        return;
    }
    saving_.error.clear();
    not_before_ = {};
    has_news_ = false;
    *record_ = *std::exchange(saving_.record, nullptr);
    stage_ = Stage::idle;
    since_ = moment_.now;
    const auto then = std::exchange(saving_.then, nullptr);
    if (then) then();
}

void Deployment::move_to(State state, const std::string& text, Stage stage) {
    Record next = *record_;
    next.state = state;
    next.text = text;
    next.since = moment_.milliseconds;
    if (orders::is_final(state)) next.has_former = false;
    waits_.clear();
    save(next, {}, [this, stage, state, text] {
        stage_ = stage;
        const bool is_bad = state == State::failed || state == State::rolled_back || state == State::failing;
        note(is_bad, fmt::format("{}: {}{}{}", title_of(*order_), orders::name_of(state),
                                 text.empty() ? "" : ": ", text));
    });
}

void Deployment::end(State state, const std::string& text) {
    pieces_.reset();
    job_ = {};
    upload_.reset();
    move_to(state, text, Stage::idle);
}

/// Tracks which table runs and since when; this is stored too.
void Deployment::follow_table() {
    const auto table = axis_.table();
    image_ = axis_.image(moment_.now);
    const bool is_of_image = image_.number != 0 && table->crc == image_[gw::TABLE_CRC] &&
                             table->bytes.size() == image_[gw::TABLE_BYTES];
    if (!is_of_image) {
        if (image_.number != 0) knows_table_ = false;
        return;
    }
    if (table != table_) {
        table_ = table;
        active_ = table->uploaded.empty() ? std::string() : orders::hex(orders::sha256(table->uploaded));
    }
    knows_table_ = true;
    if (!client_ || saving_.record || !damage_.empty()) return;
    if (stage_ == Stage::idle && has_news_) save(*record_, {}, [] {});
    if (record_->runs_sha256 == active_) return;
    has_news_ = true;
    Record& record = *record_;  // written with the next change
    record.runs_name.clear();
    if (is_active(record.former_sha256)) record.runs_name = record.former_name;
    if (is_ordered_active()) record.runs_name = order_->name;
    record.runs_since = active_.empty() ? 0 : moment_.milliseconds;
    record.runs_sha256 = active_;
}

void Deployment::tick(const Moment& moment) {
    moment_ = moment;
    follow_table();
    if (!client_) return;
    look_at_disk();
    look_at_commands();
    if (saving_.record || !knows_table_) return;
    if (!next_order_.empty() && may_be_replaced()) {
        const std::string text = std::exchange(next_order_, {});
        if (const auto read = orders::read_order(text); read.order) {
            const std::string why = why_not(*read.order);
            why.empty() ? accept(*read.order, text) : refuse(why);
        }
        return;
    }
    switch (stage_) {
        case Stage::starting:
            return take_up();
        case Stage::waiting:
            return wait();
        case Stage::stopping:
            return stop_first();
        case Stage::storing:
            return store();
        case Stage::activating:
            return activate();
        case Stage::running:
            return run_again();
        case Stage::trial:
            return watch();
        case Stage::failing:
            return go_back();
        default:
            return;
    }
}

/// Continues from the state left by an earlier process.
void Deployment::take_up() {
    stage_ = Stage::idle;
    if (!damage_.empty() || !order_ || orders::is_final(record_->state)) return;
    switch (record_->state) {
        case State::trial:
            stage_ = Stage::trial;
            trial_.watched = moment_.now;
            return;
        case State::failing:
            stage_ = Stage::failing;
            return;
        case State::activating:
            if (is_ordered_active()) return activated();
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
