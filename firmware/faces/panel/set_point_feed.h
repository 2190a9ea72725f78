#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "faces/set_point_book.h"

namespace nplc::panel {

/// The set-points of an axis as clients are told of them.
class SetPointFeed {
  public:
    /// True if something differs from before.
    bool look(const faces::AxisImage& image, std::shared_ptr<const faces::SetPointBook> book);
    /// As text of the wire (PROTOCOL.md, set_points).
    std::string text(const std::string& axis) const;

    const faces::SetPointBook& book() const { return *book_; }
    const set_points::Record& record() const { return book_->record; }
    /// How many recipes can be kept.
    std::size_t room() const { return room_; }
    /// "Length 80 mm to 100 mm, Pieces 3 to 5" of the changes of this uptime; empty if they are not known.
    std::string changes_at(std::uint32_t milliseconds) const;
    /// Of what the event log calls by its number.
    std::string recipe_name(unsigned number) const;

  private:
    std::int32_t value(std::size_t first, std::size_t index) const;

    /// SET_POINT_STATE, then the values in force and the wanted ones.
    std::array<std::uint32_t, 1 + 2 * registers::gateway::kSetPoints> shown_{};
    std::shared_ptr<const faces::SetPointBook> book_ = std::make_shared<const faces::SetPointBook>();
    std::size_t room_ = 0;
};

}  // namespace nplc::panel
