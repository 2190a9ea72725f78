#include "ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "orders/pieces.h"

namespace nplc::deployment {

namespace {

constexpr const char* kRecordFile = "orders";
constexpr base::Milliseconds kBetweenWrites{5'000};

std::vector<std::uint8_t> bytes_of(const std::string& text) {
    return {text.begin(), text.end()};
}

}  // namespace

/// A stored former table implies that there was a record.
void Ledger::read() {
    bool is_missing = false;
    bool has_no_former = false;
    const auto bytes = read_file(path(kRecordFile), kLongestRecord, is_missing);
    static_cast<void>(read_former(has_no_former));
    if (is_missing && has_no_former) return;
    auto record =
        bytes ? read_record({reinterpret_cast<const char*>(bytes->data()), bytes->size()}) : std::nullopt;
    if (record) {
        record_ = std::move(*record);
        return;
    }
    damage_ = fmt::format(
        "{} is {}: which orders came before is not known; see what runs, then remove it and {}, and only "
        "then give a new order",
        path(kRecordFile), is_missing ? "missing" : "damaged", former_path());
    note_(true, damage_);
}

std::optional<std::vector<std::uint8_t>> Ledger::read_former(bool& is_missing) const {
    return read_file(former_path(), orders::kMostArtifactBytes, is_missing);
}

std::uint64_t Ledger::last_counter() const {
    return std::max(record_.counter, next_ ? next_->counter : 0);
}

void Ledger::save(const Record& next, std::vector<File> files, std::function<void()> then) {
    next_ = next;
    files.push_back({path(kRecordFile), bytes_of(write_record(next))});
    files_ = std::move(files);
    then_ = std::move(then);
    disk_.write(files_);
}

void Ledger::look_at_disk(base::Instant now) {
    if (!next_) return;
    if (!disk_.is_busy()) {
        if (now >= not_before_) disk_.write(files_);
        return;
    }
    const auto ended = disk_.take_end();
    if (!ended) return;
    if (!ended->empty()) {
        if (*ended != error_) note_(true, *ended + "; tried again");
        error_ = *ended;
        not_before_ = now + kBetweenWrites;
        return;
    }
    error_.clear();
    not_before_ = {};
    has_unsaved_ = false;
    record_ = *std::exchange(next_, std::nullopt);
    const auto then = std::exchange(then_, nullptr);
    if (then) then();
}

void Ledger::set_running(const std::string& sha256, const std::string& name, std::uint64_t since) {
    record_.runs_sha256 = sha256;
    record_.runs_name = name;
    record_.runs_since = since;
    has_unsaved_ = true;
}

}  // namespace nplc::deployment
