#include "items.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "set_points/values.h"

namespace nplc::mqtt {

namespace gw = registers::gateway;
using faces::AxisImage;
using faces::PointValue;
using faces::Quality;

namespace {

/// They change with every image and add nothing to the timestamps.
constexpr std::string_view kRestless[]{"heartbeat",   "uptime",   "scans",        "scan_time",
                                       "contact_age", "accesses", "user_messages"};

/// Whole seconds with one digit that is not 0, so that it changes ever more seldom: 9 s, 10 s, 20 s.
double with_one_digit(double milliseconds) {
    double step = 1'000;
    while (milliseconds >= 10 * step) step *= 10;
    return std::floor(milliseconds / step) * step;
}

DataType type_of(const faces::Point& point) {
    switch (point.type) {
        case faces::PointType::boolean:
            return DataType::boolean;
        case faces::PointType::whole:
            return DataType::int64;
        case faces::PointType::real:
            break;
    }
    return DataType::real64;
}

PointValue of_image(const AxisImage& image, base::Instant now, double value) {
    return {faces::quality_of(image, now), value};
}

Item set_point_item(const std::shared_ptr<const faces::SetPointBook>& book, std::size_t index) {
    const set_points::SetPoint& point = book->record.values[index];
    Item item;
    item.name = fmt::format("{}{}", kSetPoints, point.name);
    item.unit = point.unit;
    item.text = fmt::format("set-point, {}", set_points::range_text(point));
    item.lowest = set_points::shown_value(point, point.lowest);
    item.highest = set_points::shown_value(point, point.highest);
    item.set_point = index;
    item.take = [book, index](const AxisImage& image, base::Instant now) {
        if (!book->is_of(image)) return PointValue{};
        return of_image(
            image, now,
            set_points::shown_value(book->record.values[index], faces::set_point_wanted(image, index)));
    };
    return item;
}

}  // namespace

std::vector<Item> point_items(const faces::Scaling& scaling) {
    std::vector<Item> items;
    for (const faces::Point& point : faces::points()) {
        if (std::find(std::begin(kRestless), std::end(kRestless), point.name) != std::end(kRestless))
            continue;
        Item item;
        item.name = std::string(point.name);
        item.unit = faces::unit_of(point, scaling);
        item.text = std::string(point.text);
        item.type = type_of(point);
        item.take = [&point, scaling](const AxisImage& image, base::Instant now) {
            return point.take(image, now, scaling);
        };
        if (point.name == "stop_unconfirmed_time") {
            item.take = [&point, scaling](const AxisImage& image, base::Instant now) {
                PointValue value = point.take(image, now, scaling);
                value.value = with_one_digit(value.value);
                return value;
            };
        }
        items.push_back(std::move(item));
    }
    return items;
}

std::vector<Item> set_point_items(const std::shared_ptr<const faces::SetPointBook>& book) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < book->record.values.size(); ++i) items.push_back(set_point_item(book, i));
    if (items.empty()) return items;
    Item waits;
    waits.name = fmt::format("{}Change Waits", kSetPoints);
    waits.text = "true: the sequence has not taken the values yet";
    waits.type = DataType::boolean;
    waits.take = [](const AxisImage& image, base::Instant now) {
        return of_image(image, now, (image[gw::SET_POINT_STATE] & gw::kChangeWaits) != 0 ? 1 : 0);
    };
    items.push_back(std::move(waits));
    Item recipe;
    recipe.name = std::string(kRecipe);
    recipe.text = "number of the recipe that was loaded last, 0: none;";
    for (const set_points::Recipe& one : book->recipes)
        recipe.text += fmt::format(" {} {};", one.number, one.name);
    recipe.type = DataType::int64;
    recipe.take = [](const AxisImage& image, base::Instant now) {
        return of_image(image, now, faces::active_recipe(image));
    };
    items.push_back(std::move(recipe));
    return items;
}

Value value_of(const Item& item, const PointValue& value) {
    if (value.quality == Quality::unknown) return {};
    if (item.type == DataType::boolean) return value.value != 0;
    if (item.type == DataType::int64) return static_cast<std::int64_t>(std::llround(value.value));
    return value.value;
}

}  // namespace nplc::mqtt
