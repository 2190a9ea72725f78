#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "faces/set_point_book.h"
#include "set_points/dropped.h"

namespace nplc::panel {

/// The set-points of an axis in the form sent to clients.
class SetPointFeed {
  public:
    /// True if something has changed.
    bool look(const faces::AxisImage& image, std::shared_ptr<const faces::SetPointBook> book);
    /// In the text form of the protocol (PROTOCOL.md, set_points).
    std::string text(const std::string& axis) const;

    const faces::SetPointBook& book() const { return *book_; }
    const set_points::Record& record() const { return book_->record; }
    /// Maximum number of recipes.
    std::size_t room() const { return room_; }
    /// "Length 80 mm to 100 mm, Pieces 3 to 5": the changes at this uptime; empty if unknown.
    std::string changes_at(std::uint32_t milliseconds) const;
    /// The former values and recipes that the present table did not accept; returned once.
    std::vector<set_points::Dropped> take_dropped() { return std::exchange(dropped_, {}); }
    /// Name of a recipe that the event log identifies by number.
    std::string recipe_name(unsigned number) const;

  private:
    std::int32_t value(std::size_t first, std::size_t index) const;
    void look_for_drops(const set_points::Record& now);

    /// SET_POINT_STATE, then the values in force and the wanted ones.
    std::array<std::uint32_t, 1 + 2 * registers::gateway::kSetPoints> shown_{};
    std::shared_ptr<const faces::SetPointBook> book_ = std::make_shared<const faces::SetPointBook>();
    std::size_t room_ = 0;
    std::vector<set_points::Dropped> dropped_;
};

}  // namespace nplc::panel
