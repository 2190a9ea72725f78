#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "faces/command.h"
#include "faces/image.h"
#include "set_points/changes.h"
#include "set_points/request.h"

namespace nplc::gateway {
class Controller;
}

namespace nplc::faces {

/// The set-points of an axis's active table and its recipes. Their values are in the image.
struct SetPointBook {
    std::uint32_t edition = 0;     ///< SetPoints::edition() of the content
    std::uint32_t record_crc = 0;  ///< as SET_POINT_RECORD; 0: the table has none
    set_points::Record record{};
    std::vector<set_points::Recipe> recipes{};  ///< those with a name

    std::vector<set_points::Change> changes{};  ///< the latest ones of this record, the oldest first

    /// The image's values belong to this book.
    bool is_of(const AxisImage& image) const {
        return record_crc == image[registers::gateway::SET_POINT_RECORD] &&
               record.values.size() == (image[registers::gateway::SET_POINT_COUNT] & 0xFF);
    }
    /// Null: there is none of this number.
    const set_points::Recipe* find_recipe(std::size_t number) const;
};

/// From the axis's loop.
SetPointBook book_of(gateway::Controller& controller);

/// In raw steps; `index` of the record.
std::int32_t set_point_in_force(const AxisImage& image, std::size_t index);
std::int32_t set_point_wanted(const AxisImage& image, std::size_t index);
/// The recipe that was loaded last, 1 and on; 0: none.
std::uint8_t active_recipe(const AxisImage& image);

/// Text for a refused request: "Length: a set-point is out of its range; it takes 10 mm to 200 mm; nothing
/// was changed".
std::string describe_refusal(const SetPointBook& book, const Completion& ended);

}  // namespace nplc::faces
