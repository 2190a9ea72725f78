#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "faces/axis_table.h"
#include "faces/command_desk.h"
#include "faces/image_board.h"
#include "faces/points.h"
#include "faces/set_point_book.h"
#include "faces/shelf.h"
#include "faces/why_keeper.h"

namespace nplc::faces {

/// A face's interface to an axis: its image, its table, and a desk for commands. For any thread; the axis's
/// loop (axis_loop.h) has the other side.
///
/// In a face's thread: create a Bell, watch() with it before the loop begins; then sleep until an event of
/// its own or the bell. image() returns at once; an image is at most kPeriod old while faces request images,
/// and an older one triggers a new one. Before sleeping for it: want(), then bell.arm(), then check once
/// more.
class AxisModel {
  public:
    static constexpr base::Milliseconds kPeriod{10};             ///< image interval while requested
    static constexpr base::Milliseconds kInterest{1'000};        ///< validity of a face's request
    static constexpr base::Milliseconds kWhyInterest{60'000};    ///< validity of a request for causes
    static constexpr base::Milliseconds kMotorInterest{60'000};  ///< validity of a request for the motor
    static constexpr base::Milliseconds kOld{1'000};             ///< an older image counts as stale data
    static constexpr std::size_t kMostBells = 8;

    explicit AxisModel(std::string name, Scaling scaling = {})
        : name_(std::move(name)), scaling_(std::move(scaling)) {}
    AxisModel(const AxisModel&) = delete;
    AxisModel& operator=(const AxisModel&) = delete;

    const std::string& name() const { return name_; }
    const Scaling& scaling() const { return scaling_; }

    /// Returns the last image and requests a new one at `now`. number 0: the loop has not begun.
    AxisImage image(base::Instant now) {
        want(now);
        return board_.get();
    }
    /// The same with the causes of a standstill, for which the motor is surveyed periodically while they are
    /// requested. Null findings: not known yet.
    AxisImage image_with_why(base::Instant now, std::shared_ptr<const Findings>* findings = nullptr);
    std::uint64_t image_number() const { return board_.number(); }
    /// Requests images for kInterest; wakes the loop if there was no request before.
    void want(base::Instant now);
    /// Keeps the motor's values up to date for kMotorInterest, also between images: for clients that ask at
    /// intervals of seconds. A request for causes does the same.
    void want_motor(base::Instant now);
    /// Reads the motor's torque as often as its position for kInterest: for clients that show it over time.
    void want_trend(base::Instant now);

    std::shared_ptr<const AxisTable> table() const { return table_.get(); }
    /// Settable values, their ranges, and the recipes. An image right after an upload may belong to another
    /// table: SetPointBook::is_of().
    std::shared_ptr<const SetPointBook> set_points() const { return set_points_.get(); }

    /// Registers a client of a face. Null: too many.
    std::unique_ptr<CommandDesk::Client> join(Side side, std::string name, Bell& bell) {
        return desk_.join(side, std::move(name), bell);
    }

    /// Rings for every new image. To be called before the loop begins; at most kMostBells.
    void watch(Bell& bell);
    /// From the axis's loop, before the bell is destroyed.
    void ignore(const Bell& bell);
    /// `bell` must outlive the axis's loop.
    void wake_loop_with(Bell& loop);

    // The loop's side.

    ImageBoard& board() { return board_; }
    CommandDesk& desk() { return desk_; }
    Shelf<AxisTable>& table_shelf() { return table_; }
    Shelf<SetPointBook>& set_point_shelf() { return set_points_; }
    Shelf<Survey>& survey_shelf() { return survey_; }
    bool wants_survey(base::Instant now) const;
    bool wants_motor(base::Instant now) const;
    bool wants_trend(base::Instant now) const;
    bool is_wanted(base::Instant now) const;
    void strike_bells();
    /// To be called before the desk is checked.
    void arm_loop();

  private:
    std::string name_;
    Scaling scaling_;
    ImageBoard board_;
    CommandDesk desk_;
    Shelf<AxisTable> table_;
    Shelf<SetPointBook> set_points_;
    Shelf<Survey> survey_;
    WhyKeeper why_;
    std::atomic<std::int64_t> why_asked_{INT64_MIN / 2};
    std::atomic<std::int64_t> motor_asked_{INT64_MIN / 2};
    std::atomic<std::int64_t> trend_asked_{INT64_MIN / 2};
    std::atomic<std::int64_t> wanted_{INT64_MIN / 2};
    std::array<Bell*, kMostBells> bells_{};
    Bell* loop_ = nullptr;
};

/// All axes of a process, for a face.
using Axes = std::vector<AxisModel*>;

}  // namespace nplc::faces
