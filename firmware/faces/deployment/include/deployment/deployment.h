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

/// What becomes of the orders for one axis: looked at, their tables gathered, stored, made active, watched,
/// and given up for the former one. Knows no socket. Each state is on the disk before what follows from it is
/// begun, so that a restart at any place takes up what was under way. In one thread, that of its face.
class Deployment {
  public:
    /// One line for the user; an error, or news.
    using Tell = std::function<void(bool is_error, const std::string&)>;

    /// `target`: GROUP/NODE/AXIS. Reads what an earlier process has left.
    Deployment(const Settings& settings, std::string target, faces::AxisModel& axis, faces::Bell& bell,
               Tell tell);
    ~Deployment();
    Deployment(const Deployment&) = delete;
    Deployment& operator=(const Deployment&) = delete;

    const std::string& target() const { return target_; }
    void take_order(std::string_view text, const Moment& moment);
    void take_piece(const orders::Hash& hash, std::size_t number, std::span<const std::uint8_t> piece);
    /// Whose pieces are awaited; null: nobody's.
    const orders::Hash* wanted() const;

    /// Often, whether orders come or not.
    void tick(const Moment& moment);
    /// Nothing: the axis has told nothing yet, or its table is just becoming another one. Without the time.
    std::optional<orders::Report> report() const;

  private:
    enum class Stage : std::uint8_t {
        starting,  ///< until the axis says what runs
        idle,
        saving,
        fetching,
        waiting,
        seating,   ///< the seat has been asked for
        stopping,  ///< the sequence has been told to stop
        storing,
        activating,
        running,  ///< the sequence has been told to run
        trial,
        failing,
    };
    /// A table on its way to be the active one.
    struct Job {
        std::vector<std::uint8_t> bytes{};
        orders::Hash hash{};
        bool is_rollback = false;
    };
    struct Trial {
        base::Microseconds ran{};
        base::Microseconds healthy{};  ///< since the last ERROR
        std::string error{};           ///< the last one
        bool was_in_step = false;
        base::Instant watched{};                      ///< last
        std::optional<std::uint32_t> first_reason{};  ///< SAFE_REASON that is none of the trial's
    };
    /// Under way to the disk, and what is to be done then.
    struct Saving {
        std::unique_ptr<Record> record{};  ///< null: nothing is
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
    std::string damage_;  ///< of what was stored: no order is taken; empty: none
    Moment moment_{};
    faces::AxisImage image_{};
    std::shared_ptr<const faces::AxisTable> table_;
    std::string active_;  ///< SHA-256 of it; empty: there is none
    bool knows_table_ = false;
    bool has_news_ = false;  ///< of the table, that are not on the disk yet

    Stage stage_ = Stage::starting;
    Stage after_run_ = Stage::idle;
    std::optional<orders::Order> order_;  ///< the last one that was taken
    std::string order_hash_;              ///< SHA-256 of its text
    std::string next_order_;              ///< comes when what is under way has ended
    std::unique_ptr<orders::Pieces> pieces_;
    Job job_;
    std::optional<faces::Upload> upload_;
    std::uint32_t command_ = 0;  ///< under way; 0: none
    /// AxisImage::stops once it was told to stop, if it ran before; it runs again if nobody else stops it.
    std::optional<std::uint32_t> ran_{};
    base::Instant not_before_{};
    base::Instant since_{};  ///< of the stage
    std::string waits_;      ///< for what; empty: for nothing
    Trial trial_;
    Saving saving_;
    Refusals refusals_;
};

}  // namespace nplc::deployment
