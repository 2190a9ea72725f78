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

/// What a face gets of an axis: its image, its table, and a desk for commands. For any thread; the axis's
/// loop (axis_loop.h) has the other side of it.
///
/// A face's thread: make a Bell, watch() with it before the loop begins; then sleep until something of its
/// own comes or the bell rings. image() tells at once; an image is at most kPeriod old while faces ask, and
/// asks for a new one when it is older. Before sleeping for one: want(), then bell.arm(), then look once
/// more.
class AxisModel {
  public:
    static constexpr base::Milliseconds kPeriod{10};           ///< between two images, while faces ask
    static constexpr base::Milliseconds kInterest{1'000};      ///< after a face's last question
    static constexpr base::Milliseconds kWhyInterest{60'000};  ///< after the last question why
    static constexpr base::Milliseconds kOld{1'000};           ///< an image older than this is old data
    static constexpr std::size_t kMostBells = 8;

    explicit AxisModel(std::string name, Scaling scaling = {})
        : name_(std::move(name)), scaling_(std::move(scaling)) {}
    AxisModel(const AxisModel&) = delete;
    AxisModel& operator=(const AxisModel&) = delete;

    const std::string& name() const { return name_; }
    const Scaling& scaling() const { return scaling_; }

    /// The last image, and that one is wanted at `now`. number 0: the loop has not begun.
    AxisImage image(base::Instant now) {
        want(now);
        return board_.get();
    }
    /// The same with `why`, for which the motor is surveyed now and then while somebody asks. Null findings:
    /// not known, or not yet.
    AxisImage image_with_why(base::Instant now, std::shared_ptr<const Findings>* findings = nullptr);
    std::uint64_t image_number() const { return board_.number(); }
    /// Images are wanted for kInterest; wakes the loop if none were before.
    void want(base::Instant now);

    std::shared_ptr<const AxisTable> table() const { return table_.get(); }
    /// What can be set, how far, and the recipes. An image right after an upload may be of another table:
    /// SetPointBook::is_of().
    std::shared_ptr<const SetPointBook> set_points() const { return set_points_.get(); }

    /// A client of a face. Null: there are too many.
    std::unique_ptr<CommandDesk::Client> join(Side side, std::string name, Bell& bell) {
        return desk_.join(side, std::move(name), bell);
    }

    /// Rings for every new image. Before the loop begins; kMostBells at the most.
    void watch(Bell& bell);
    /// From the axis's loop, before the bell goes.
    void ignore(const Bell& bell);
    /// The bell lives until the axis's loop has ended.
    void wake_loop_with(Bell& loop);

    // The loop's side.

    ImageBoard& board() { return board_; }
    CommandDesk& desk() { return desk_; }
    Shelf<AxisTable>& table_shelf() { return table_; }
    Shelf<SetPointBook>& set_point_shelf() { return set_points_; }
    Shelf<Survey>& survey_shelf() { return survey_; }
    bool wants_survey(base::Instant now) const;
    bool is_wanted(base::Instant now) const;
    void strike_bells();
    /// Before the desk is looked at.
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
    std::atomic<std::int64_t> wanted_{INT64_MIN / 2};
    std::array<Bell*, kMostBells> bells_{};
    Bell* loop_ = nullptr;
};

/// All axes of a process, for a face.
using Axes = std::vector<AxisModel*>;

}  // namespace nplc::faces
