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
    std::uint32_t edition = 0;     ///< SetPoints::edition() that it shows
    std::uint32_t record_crc = 0;  ///< as SET_POINT_RECORD; 0: the table has none
    set_points::Record record{};
    std::vector<set_points::Recipe> recipes{};  ///< those that have a name

    std::vector<set_points::Change> changes{};  ///< the last ones of this record, the oldest first

    /// The image has this book's values.
    bool is_of(const AxisImage& image) const {
        return record_crc == image[registers::gateway::SET_POINT_RECORD] &&
               record.values.size() == (image[registers::gateway::SET_POINT_COUNT] & 0xFF);
    }
    /// Null: there is none of this number.
    const set_points::Recipe* find_recipe(std::size_t number) const;
};

/// From the axis's loop.
SetPointBook book_of(gateway::Controller& controller);

/// In the steps of what takes it; `index` of the record.
std::int32_t set_point_in_force(const AxisImage& image, std::size_t index);
std::int32_t set_point_wanted(const AxisImage& image, std::size_t index);
/// Of the recipe that was loaded last, 1 and on; 0: none.
std::uint8_t active_recipe(const AxisImage& image);

/// "Length: a set-point is out of its range; it takes 10 mm to 200 mm; nothing was changed": what a face says
/// of a request that ended so.
std::string describe_refusal(const SetPointBook& book, const Completion& ended);

}  // namespace nplc::faces
