#include "set_points/request.h"

#include <algorithm>

#include "base/bytes.h"
#include "base/crc32.h"

namespace nplc::set_points {

using registers::gateway::SetPointRequest;

namespace {

constexpr std::size_t kHeadBytes = 12;
constexpr std::size_t kOwnNumberAt = 8;

}  // namespace

std::vector<std::uint8_t> encode_request(const Record& record, SetPointRequest kind,
                                         std::vector<NewValue> values, const RecipeRef& recipe) {
    std::sort(values.begin(), values.end(),
              [](const NewValue& a, const NewValue& b) { return a.index < b.index; });
    std::vector<std::uint8_t> bytes(kHeadBytes);
    base::store_u32(bytes.data(), base::crc32(encode(record)));
    bytes[4] = static_cast<std::uint8_t>(kind);
    bytes[5] = recipe.number;
    unsigned mask = 0;
    for (const NewValue& value : values) mask |= 1U << value.index;
    base::store_u16(&bytes[6], static_cast<std::uint16_t>(mask));
    if (kind != SetPointRequest::change) {
        const std::size_t begin = bytes.size();
        const std::string_view fitting = recipe.name.substr(0, kLongestRecipeName);
        bytes.insert(bytes.end(), fitting.begin(), fitting.end());
        bytes.resize(begin + kLongestRecipeName + 1);
    }
    for (const NewValue& value : values) {
        bytes.resize(bytes.size() + 4);
        base::store_u32(&bytes[bytes.size() - 4], static_cast<std::uint32_t>(value.value));
    }
    for (const NewValue& value : values) bytes.push_back(record.values[value.index].unit_code);
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return bytes;
}

void give_number(std::span<std::uint8_t> request, std::uint32_t own_number) {
    base::store_u32(&request[kOwnNumberAt], own_number);
}

Recipe decode_recipe(std::span<const std::uint8_t> bytes, const Record& record, std::uint8_t number) {
    constexpr std::size_t kNameBytes = kLongestRecipeName + 1;
    constexpr std::size_t kValueBytes = 9;
    Recipe recipe{.number = number, .name = {}, .values = {}, .misfits = {}};
    if (bytes.size() < kRecipeBytes) return recipe;
    for (std::size_t i = 0; i < kNameBytes && bytes[i] != 0; ++i)
        recipe.name += bytes[i] >= 0x20 && bytes[i] < 0x7F ? static_cast<char>(bytes[i]) : '?';
    for (std::size_t at = kNameBytes; at + kValueBytes <= kRecipeBytes; at += kValueBytes) {
        const std::uint32_t hash = base::load_u32(&bytes[at]);
        if (hash == 0) continue;
        const auto value = static_cast<std::int32_t>(base::load_u32(&bytes[at + 4]));
        const auto fits = [&](const SetPoint& point) {
            return hash_of(point.name) == hash && point.unit_code == bytes[at + 8] && value >= point.lowest &&
                   value <= point.highest;
        };
        const auto point = std::find_if(record.values.begin(), record.values.end(), fits);
        if (point == record.values.end())
            recipe.misfits.push_back({hash, value, bytes[at + 8]});
        else
            recipe.values.push_back(
                {static_cast<std::size_t>(std::distance(record.values.begin(), point)), value});
    }
    return recipe;
}

}  // namespace nplc::set_points
