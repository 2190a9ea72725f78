#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "set_points/request.h"

/// Kept values that a table does not take (firmware/gateway/SET_POINTS.md, "A new upload").
namespace nplc::set_points {

enum class DropReason : std::uint8_t {
    gone,           ///< the table has no set-point of this name
    other_unit,     ///< in which the register, timer or counter counts
    out_of_range,   ///< of the table's set-point
    not_for_motor,  ///< known to the gateway only
    no_fit,         ///< one of the reasons above: the kept value is not known
    other_scale,    ///< not dropped: the register keeps its value, which is another one in the unit
};

struct Dropped {
    std::string recipe{};  ///< that has the value; empty: it was in force
    std::string name{};    ///< empty: not known
    std::string value{};   ///< "90 mm"; empty: not known
    DropReason why{};
    std::string now{};    ///< other_scale: what the value is now; else the default in its place, if any
    std::string takes{};  ///< the range of the table's set-point, if it has it
    bool operator==(const Dropped&) const = default;
};

/// What is kept while a table is active.
struct Kept {
    const Record& record;
    const std::vector<std::int32_t>& wanted;
    const std::vector<Recipe>& recipes;  ///< as decoded with the record
};
/// The values of `before` that a table with the record `now` does not accept: of the wanted values none if
/// all of them are the former defaults, since then none was ever set; of the recipes those that were valid
/// before.
std::vector<Dropped> dropped_by(const Kept& before, const Record& now);
/// Of a recipe as it was saved, without the names of set-points that the record does not have.
std::vector<Dropped> misfits_of(const Recipe& recipe, const Record& record);
/// A value that fits and was not taken.
Dropped refused_by_motor(const SetPoint& point, std::int32_t value);
/// A set-point that got its default because no kept value fits.
Dropped without_fit(const SetPoint& point);

/// "Speed 2000 rpm is dropped, its default 1200 rpm is in its place: it takes 100 rpm to 1500 rpm".
std::string text_of(const Dropped& dropped);
/// Stable name of the reason, for documents: "out_of_range".
std::string_view key_of(DropReason why);

}  // namespace nplc::set_points
