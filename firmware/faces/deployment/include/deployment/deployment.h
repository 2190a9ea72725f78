#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "deployment/file.h"
#include "deployment/settings.h"
#include "faces/axis_model.h"
#include "faces/upload.h"
#include "orders/order.h"
#include "orders/pieces.h"
#include "orders/report.h"

namespace nplc::deployment {

class Disk;
struct Record;

/// Handles the orders for one axis: checks them, collects their tables, stores, activates and monitors these,
/// and rolls back to the former table. Does no network I/O. Each state is on the disk before its consequences
/// begin, so that a restart at any point continues it. Used by one thread, that of its face.
class Deployment {
  public:
    /// A one-line message for the operator; an error or news.
    using Tell = std::function<void(bool is_error, const std::string&)>;

    /// `target`: GROUP/NODE/AXIS. Reads the state left by an earlier process.
    Deployment(const Settings& settings, std::string target, faces::AxisModel& axis, faces::Bell& bell,
               Tell tell);
    ~Deployment();
    Deployment(const Deployment&) = delete;
    Deployment& operator=(const Deployment&) = delete;

    const std::string& target() const { return target_; }
    void take_order(std::string_view text, const Moment& moment);
    void take_piece(const orders::Hash& hash, std::size_t number, std::span<const std::uint8_t> piece);
    /// Hash of the artifact whose pieces are awaited; null: none.
    const orders::Hash* wanted() const;

    /// To be called regularly, with or without orders.
    void tick(const Moment& moment);
    /// Empty while the axis has reported nothing yet, or its table is being changed. Without the time.
    std::optional<orders::Report> report() const;

  private:
    enum class Stage : std::uint8_t {
        starting,  ///< until the axis reports its table
        idle,
        saving,
        fetching,
        waiting,
        seating,   ///< the operator's seat has been requested
        stopping,  ///< the sequence has been stopped
        storing,
        activating,
        running,  ///< the sequence has been started
        trial,
        failing,
    };
    /// A table that is being stored and activated.
    struct Job {
        std::vector<std::uint8_t> bytes{};
        orders::Hash hash{};
        bool is_rollback = false;
    };
    struct Trial {
        base::Microseconds ran{};
        base::Microseconds healthy{};  ///< since the last ERROR
        std::string error{};           ///< the last error
        bool was_in_step = false;
        base::Instant watched{};                      ///< last
        std::optional<std::uint32_t> first_reason{};  ///< SAFE_REASON from before the trial
    };
    /// A write in progress, and the action after it.
    struct Saving {
        std::unique_ptr<Record> record{};  ///< null: none in progress
        std::vector<File> files{};
        std::function<void()> then{};
        std::string error{};
    };
    struct Refusals {
        std::uint64_t count = 0;
        std::string last{};
        std::uint64_t at = 0;  ///< ms since 1970
    };
    using State = orders::State;

    std::string path(const char* file) const;
    void read_stored();
    void note(bool is_error, const std::string& text) const;
    void refuse(const std::string& text);
    std::string why_not(const orders::SignedOrder& order) const;
    bool may_be_replaced() const;
    void accept(const orders::SignedOrder& order, const std::string& text);

    void follow_table();
    bool is_active(std::string_view sha256) const { return !active_.empty() && active_ == sha256; }
    bool is_ordered_active() const { return order_ && is_active(orders::hex(order_->sha256)); }
    void save(const Record& next, std::vector<File> files, std::function<void()> then);
    void move_to(State state, const std::string& text, Stage stage);
    void end(State state, const std::string& text);
    void look_at_disk();
    void look_at_commands();

    void take_up();
    void look_at_artifact();
    void wait();
    bool may_go_on();
    void begin_job();
    void give_way(const std::string& why);
    void take_seat(const faces::Completion& ended);
    void stop_first();
    void store();
    void upload_ended();
    void activate();
    void try_activation(const faces::Completion& ended);
    void activated();
    void run_after_saving(bool runs_again, Stage stage);
    void run_again();
    void end_of_run(const faces::Completion& ended);
    void forget_run(const std::string& why);
    void leave_seat();
    void watch();
    void fail_trial(const std::string& why);
    void go_back();
    bool submit(const faces::Command& command);

    Settings settings_;
    std::string target_;
    faces::AxisModel& axis_;
    Tell tell_;
    std::unique_ptr<faces::CommandDesk::Client> client_;
    std::unique_ptr<Disk> disk_;
    std::unique_ptr<Record> record_;
    std::string damage_;  ///< damage of the stored state: no order is accepted; empty: none
    Moment moment_{};
    faces::AxisImage image_{};
    std::shared_ptr<const faces::AxisTable> table_;
    std::string active_;  ///< its SHA-256; empty: no table
    bool knows_table_ = false;
    bool has_news_ = false;  ///< change of the table that is not on the disk yet

    Stage stage_ = Stage::starting;
    Stage after_run_ = Stage::idle;
    std::optional<orders::Order> order_;  ///< the last accepted one
    std::string order_hash_;              ///< SHA-256 of its text
    std::string next_order_;              ///< handled when the present one has ended
    std::unique_ptr<orders::Pieces> pieces_;
    Job job_;
    std::optional<faces::Upload> upload_;
    std::uint32_t command_ = 0;  ///< command in progress; 0: none
    /// AxisImage::stops when the sequence was stopped, if it ran before; it is restarted if no other client
    /// stops it.
    std::optional<std::uint32_t> ran_{};
    base::Instant not_before_{};
    base::Instant since_{};  ///< start of the stage
    std::string waits_;      ///< reason for waiting; empty: not waiting
    Trial trial_;
    Saving saving_;
    Refusals refusals_;
};

}  // namespace nplc::deployment
