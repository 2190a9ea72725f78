#pragma once

#include <cstdint>
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
#include "orders/order.h"
#include "orders/pieces.h"
#include "orders/report.h"

namespace nplc::deployment {

class ActiveTable;
class Changeover;
class Ledger;
struct Record;
class Trial;
enum class Outcome : std::uint8_t;

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
        changing,  ///< the table, or the sequence is being run again after that
        trial,
        failing,
    };
    struct Refusals {
        std::uint64_t count = 0;
        std::string last{};
        std::uint64_t at = 0;  ///< ms since 1970
    };
    using State = orders::State;

    void refuse(const std::string& text);
    std::string why_not(const orders::SignedOrder& order) const;
    bool may_be_replaced() const;
    void accept(const orders::SignedOrder& order, const std::string& text);

    void follow_table();
    bool is_ordered_active() const;
    void save(const Record& next, std::vector<File> files, std::function<void()> then);
    void move_to(State state, const std::string& text, Stage stage, std::function<void()> then = {});
    void end(State state, const std::string& text, std::function<void()> then = {});

    void take_up();
    void take_next();
    void look_at_artifact();
    void wait();
    bool may_go_on();
    void begin_change();
    void follow_change(Outcome outcome);
    void activated(bool was_rollback);
    void watch();
    void fail_trial(const std::string& why);
    void go_back();

    Settings settings_;
    std::string target_;
    faces::AxisModel& axis_;
    Tell note_;  ///< with the axis's name in front
    std::unique_ptr<Ledger> ledger_;
    std::unique_ptr<ActiveTable> active_;
    std::unique_ptr<Changeover> changeover_;  ///< null: no order is taken
    std::unique_ptr<Trial> trial_;
    Moment moment_{};

    Stage stage_ = Stage::starting;
    Stage after_run_ = Stage::idle;
    std::optional<orders::Order> order_;  ///< the last accepted one
    std::string order_hash_;              ///< SHA-256 of its text
    std::string next_order_;              ///< handled when the present one has ended
    std::unique_ptr<orders::Pieces> pieces_;
    base::Instant not_before_{};
    std::string waits_;  ///< reason for waiting; empty: not waiting
    Refusals refusals_;
};

}  // namespace nplc::deployment
