#include "modbus/set_point_words.h"

#include <algorithm>
#include <cmath>

#include "set_points/values.h"

namespace nplc::modbus {

namespace gw = registers::gateway;
using set_points::SetPoint;

namespace {

constexpr Word kNotKnown{Exception::target_failed, 0};

std::int32_t for_plc(const SetPoint& point, std::int32_t value) {
    const double number =
        set_points::shown_value(point, value) * std::pow(10, set_points::decimals_of(point));
    constexpr double kLowest = INT32_MIN;
    constexpr double kHighest = INT32_MAX;
    return static_cast<std::int32_t>(std::llround(std::clamp(number, kLowest, kHighest)));
}

/// The ends of the range, and the present wanted value, are converted back exactly.
std::int32_t from_plc(const SetPoint& point, std::int32_t number, std::int32_t wanted) {
    for (const std::int32_t exact : {wanted, point.lowest, point.highest, point.initial}) {
        if (for_plc(point, exact) == number) return exact;
    }
    const auto steps = set_points::steps_of(point, number / std::pow(10, set_points::decimals_of(point)));
    return steps.value_or(number < 0 ? INT32_MIN : INT32_MAX);
}

Word half_of(std::uint32_t value, unsigned index, bool low_first) {
    const bool low = (index == 0) == low_first;
    return {Exception::none, static_cast<std::uint16_t>(low ? value : value >> 16)};
}

Word text_of_point(const SetPointLook& look, std::size_t index, std::uint16_t word) {
    if (index >= look.book.record.values.size()) return kNotKnown;
    const SetPoint& point = look.book.record.values[index];
    if (word >= kTextOfName) return text_word(point.name, word - std::size_t{kTextOfName});
    if (word >= kTextOfUnit) return text_word(point.unit, word - std::size_t{kTextOfUnit});
    if (word == kTextOfDecimals)
        return {Exception::none, static_cast<std::uint16_t>(set_points::decimals_of(point))};
    if (word > kTextOfDecimals) return {Exception::none, 0};
    const std::array<std::int32_t, 4> numbers{
        for_plc(point, point.lowest), for_plc(point, point.highest), for_plc(point, point.initial),
        static_cast<std::int32_t>(std::llround(point.step * std::pow(10, set_points::decimals_of(point))))};
    return half_of(static_cast<std::uint32_t>(numbers[word / 2U]), word % 2U, look.low_word_first);
}

Word recipe_name(const SetPointLook& look, std::size_t number, std::size_t word) {
    const set_points::Recipe* recipe = look.book.find_recipe(number);
    return recipe == nullptr ? Word{} : text_word(recipe->name, word);
}

Word head_word(const SetPointLook& look, std::uint16_t address) {
    const faces::AxisImage& image = look.image;
    switch (address) {
        case kSetPointCount:
            return {Exception::none, static_cast<std::uint16_t>(image[gw::SET_POINT_COUNT] & 0xFF)};
        case kSetPointState:
            return {Exception::none, static_cast<std::uint16_t>(image[gw::SET_POINT_STATE] & 0x7)};
        case kActiveRecipe:
            return {Exception::none, faces::active_recipe(image)};
        case kRecipeRoom:
            return {Exception::none, static_cast<std::uint16_t>(image[gw::SET_POINT_COUNT] >> 16 & 0xFF)};
        case kSetPointRecord:
        case kSetPointRecord + 1:
            return half_of(image[gw::SET_POINT_RECORD], address - unsigned{kSetPointRecord},
                           look.low_word_first);
        default:
            return half_of(image[gw::SET_POINT_CHANGES], address - unsigned{kSetPointChanges},
                           look.low_word_first);
    }
}

}  // namespace

Word text_word(const std::string& text, std::size_t word) {
    const auto at = [&text](std::size_t i) {
        return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
    };
    return {Exception::none, static_cast<std::uint16_t>(at(2 * word) << 8 | at(2 * word + 1))};
}

std::optional<Word> set_point_input(const SetPointLook& look, std::uint16_t address) {
    const bool is_head = address >= kSetPointCount && address < kSetPointChanges + 2;
    const bool is_value = address >= kSetPointValues && address < kSetPointValues + 2 * gw::kSetPoints;
    const bool is_text = address >= kSetPointTexts && address < kSetPointTexts + kTextWords * gw::kSetPoints;
    const bool is_recipe = address >= kRecipeNames && address < kRecipeNames + kRecipeWords * kRecipes;
    if (!is_head && !is_value && !is_text && !is_recipe) return std::nullopt;
    if (!look.book.is_of(look.image)) return kNotKnown;
    if (is_head) return head_word(look, address);
    if (is_value) {
        const std::size_t index = (address - std::size_t{kSetPointValues}) / 2;
        if (index >= look.book.record.values.size()) return kNotKnown;
        const std::int32_t value =
            for_plc(look.book.record.values[index], faces::set_point_in_force(look.image, index));
        return half_of(static_cast<std::uint32_t>(value), (address - unsigned{kSetPointValues}) & 1U,
                       look.low_word_first);
    }
    if (is_text) {
        const unsigned place = address - unsigned{kSetPointTexts};
        return text_of_point(look, place / kTextWords, static_cast<std::uint16_t>(place % kTextWords));
    }
    const unsigned place = address - unsigned{kRecipeNames};
    return recipe_name(look, 1 + place / kRecipeWords, place % kRecipeWords);
}

void StagedSetPoints::write(const SetPointLook& look, std::size_t index, std::int32_t value) {
    if (!are_of(look.book)) forget();
    if (index >= look.book.record.values.size()) return;
    record_crc_ = look.book.record_crc;
    written_ = static_cast<std::uint16_t>(written_ | 1U << index);
    values_[index] = value;
}

Word StagedSetPoints::word(const SetPointLook& look, std::uint16_t address) const {
    const unsigned place = address - unsigned{kSetPointsNew};
    const std::size_t index = place / 2;
    if (!look.book.is_of(look.image) || index >= look.book.record.values.size()) return kNotKnown;
    const bool is_written = are_of(look.book) && (written_ >> index & 1) != 0;
    const std::int32_t value =
        is_written ? values_[index]
                   : for_plc(look.book.record.values[index], faces::set_point_wanted(look.image, index));
    return half_of(static_cast<std::uint32_t>(value), place % 2, look.low_word_first);
}

std::vector<std::uint8_t> StagedSetPoints::request(const SetPointLook& look) const {
    std::vector<set_points::NewValue> values;
    for (std::size_t i = 0; i < look.book.record.values.size(); ++i) {
        if ((written_ >> i & 1) == 0) continue;
        const std::int32_t wanted = faces::set_point_wanted(look.image, i);
        const std::int32_t value = from_plc(look.book.record.values[i], values_[i], wanted);
        if (value != wanted) values.push_back({i, value});
    }
    if (values.empty()) return {};
    return set_points::encode_request(look.book.record, gw::SetPointRequest::change, values);
}

}  // namespace nplc::modbus
