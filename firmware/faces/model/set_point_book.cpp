#include "faces/set_point_book.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "gateway/controller.h"
#include "set_points/values.h"

namespace nplc::faces {

namespace gw = registers::gateway;

namespace {

std::vector<std::uint8_t> view(gateway::SetPoints& kept, std::size_t which, std::size_t length) {
    std::vector<std::uint8_t> bytes(length);
    kept.read(static_cast<std::uint32_t>(which << 16), bytes);
    return bytes;
}

}  // namespace

SetPointBook book_of(gateway::Controller& controller) {
    gateway::SetPoints& kept = controller.set_points();
    SetPointBook book{.edition = kept.edition(), .record_crc = kept.value(gw::SET_POINT_RECORD)};
    if (const auto record = set_points::decode(kept.record().bytes())) book.record = *record;
    const std::uint32_t room = kept.value(gw::SET_POINT_COUNT) >> 16 & 0xFF;
    for (std::size_t number = 1; number <= room; ++number) {
        auto recipe = set_points::decode_recipe(view(kept, number, set_points::kRecipeBytes), book.record,
                                                static_cast<std::uint8_t>(number));
        if (!recipe.name.empty()) book.recipes.push_back(std::move(recipe));
    }
    book.changes = set_points::decode_changes(view(kept, static_cast<std::size_t>(gw::SetPointView::changes),
                                                   gateway::SetPoints::kKeptChanges * gw::kChangeBytes),
                                              book.record);
    return book;
}

const set_points::Recipe* SetPointBook::find_recipe(std::size_t number) const {
    const auto found =
        std::find_if(recipes.begin(), recipes.end(),
                     [number](const set_points::Recipe& recipe) { return recipe.number == number; });
    return found == recipes.end() ? nullptr : &*found;
}

std::int32_t set_point_in_force(const AxisImage& image, std::size_t index) {
    return static_cast<std::int32_t>(image.own[gw::SET_POINT + index]);
}

std::int32_t set_point_wanted(const AxisImage& image, std::size_t index) {
    return static_cast<std::int32_t>(image.own[gw::SET_POINT_WANTED + index]);
}

std::uint8_t active_recipe(const AxisImage& image) {
    return static_cast<std::uint8_t>(image[gw::SET_POINT_STATE] >> 8);
}

std::string describe_refusal(const SetPointBook& book, const Completion& ended) {
    const std::string_view why = gw::describe(ended.result);
    const bool names_one = ended.result == Result::out_of_range || ended.result == Result::wrong_unit ||
                           ended.result == Result::not_for_motor;
    if (!names_one || ended.detail >= book.record.values.size())
        return fmt::format("{}; nothing was changed", why);
    const set_points::SetPoint& point = book.record.values[ended.detail];
    return fmt::format("{}: {}; it takes {}; nothing was changed", point.name, why,
                       set_points::range_text(point));
}

}  // namespace nplc::faces
