#include "set_point_feed.h"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "set_points/values.h"

namespace nplc::panel {
namespace {

using Json = nlohmann::ordered_json;
using set_points::SetPoint;
namespace own = registers::gateway;

constexpr std::size_t kInForce = 1;
constexpr std::size_t kWanted = kInForce + own::kSetPoints;

/// Rounded to a readable number of digits.
double number_of(const SetPoint& point, std::int32_t value) {
    return std::strtod(set_points::text_of(point, value).c_str(), nullptr);
}

Json values_of(const set_points::Recipe& recipe, const set_points::Record& record) {
    Json values = Json::object();
    for (const set_points::NewValue& one : recipe.values) {
        const SetPoint& point = record.values[one.index];
        values[point.name] = number_of(point, one.value);
    }
    return values;
}

}  // namespace

bool SetPointFeed::look(const faces::AxisImage& image, std::shared_ptr<const faces::SetPointBook> book) {
    if (!book->is_of(image)) return false;  // a table is being replaced: the next image will fit
    auto now = shown_;
    now[0] = image[own::SET_POINT_STATE];
    for (std::size_t i = 0; i < own::kSetPoints; ++i) {
        now[kInForce + i] = image.own[own::SET_POINT + i];
        now[kWanted + i] = image.own[own::SET_POINT_WANTED + i];
    }
    room_ = image[own::SET_POINT_COUNT] >> 16 & 0xFF;
    if (book == book_ && now == shown_) return false;
    if (book->record_crc != book_->record_crc) look_for_drops(book->record);
    shown_ = now;
    book_ = std::move(book);
    return true;
}

void SetPointFeed::look_for_drops(const set_points::Record& now) {
    std::vector<std::int32_t> wanted;
    for (std::size_t i = 0; i < record().values.size(); ++i) wanted.push_back(value(kWanted, i));
    dropped_ = set_points::dropped_by({record(), wanted, book_->recipes}, now);
}

std::int32_t SetPointFeed::value(std::size_t first, std::size_t index) const {
    return static_cast<std::int32_t>(shown_[first + index]);
}

std::string SetPointFeed::text(const std::string& axis) const {
    Json values = Json::array();
    for (std::size_t i = 0; i < record().values.size(); ++i) {
        const SetPoint& point = record().values[i];
        values.push_back({{"name", point.name},
                          {"unit", point.unit},
                          {"value", number_of(point, value(kWanted, i))},
                          {"in_force", number_of(point, value(kInForce, i))},
                          {"lowest", number_of(point, point.lowest)},
                          {"highest", number_of(point, point.highest)},
                          {"step", std::strtod(fmt::format("{:g}", point.step).c_str(), nullptr)},
                          {"initial", number_of(point, point.initial)}});
    }
    Json recipes = Json::array();
    for (const set_points::Recipe& recipe : book_->recipes)
        recipes.push_back(
            {{"number", recipe.number}, {"name", recipe.name}, {"values", values_of(recipe, record())}});
    Json takes = Json::array();
    for (unsigned step = 0; step < 64; ++step) {
        if ((record().takes >> step & 1) != 0) takes.push_back(step);
    }
    const std::uint32_t state = shown_[0];
    return Json{{"t", "set_points"},
                {"axis", axis},
                {"crc", book_->record_crc},
                {"values", std::move(values)},
                {"waits", (state & own::kChangeWaits) != 0},
                {"damaged", (state & own::kValuesDamaged) != 0},
                {"recipe", (state & own::kActiveRecipe) >> 8},
                {"differs", (state & own::kRecipeDiffers) != 0},
                {"takes", std::move(takes)},
                {"room", room_},
                {"recipes", std::move(recipes)}}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string SetPointFeed::changes_at(std::uint32_t milliseconds) const {
    return set_points::changes_text(book_->changes, record(), milliseconds);
}

std::string SetPointFeed::recipe_name(unsigned number) const {
    const set_points::Recipe* recipe = book_->find_recipe(number);
    return recipe == nullptr ? fmt::format("{}", number) : fmt::format("{} '{}'", number, recipe->name);
}

}  // namespace nplc::panel
