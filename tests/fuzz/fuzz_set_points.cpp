// Any bytes are a record of set-points, or are refused, and come back from what is written of it; any text is
// a file of recipes whose values lie in their ranges, or is refused with a reason.
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz.h"
#include "set_points/recipe_file.h"

namespace {

using namespace nplc::set_points;

void record(std::span<const std::uint8_t> bytes) {
    const auto read = decode(bytes);
    if (!read) return;
    const auto again = decode(encode(*read));
    require(again && *again == *read);
}

Record table() {
    SetPoint length;
    length.name = "Length";
    length.unit = "mm";
    length.reg = 51;
    length.steps_per_unit = 819.2;
    length.step = 0.1;
    length.lowest = 8192;
    length.highest = 163840;
    SetPoint dwell;
    dwell.name = "Dwell";
    dwell.unit = "ms";
    dwell.kind = ValueKind::timer;
    dwell.lowest = 1;
    dwell.highest = 5000;
    SetPoint parts;
    parts.name = "Parts";
    parts.kind = ValueKind::counter;
    parts.lowest = 1;
    parts.highest = 999;
    return {{length, dwell, parts}, 1};
}

bool same(const std::vector<NewValue>& a, const std::vector<NewValue>& b) {
    if (a.size() != b.size()) return false;
    for (const NewValue& one : a) {
        bool found = false;
        for (const NewValue& other : b)
            found = found || (other.index == one.index && other.value == one.value);
        if (!found) return false;
    }
    return true;
}

void recipes(std::string_view text, RecipeFormat format) {
    static const Record kTable = table();
    const RecipeReading read = read_recipes(text, kTable, format);
    require(read.error.empty() != read.recipes.empty());
    for (const Recipe& recipe : read.recipes) {
        require(!recipe.name.empty() && recipe.name.size() <= kLongestRecipeName && !recipe.values.empty());
        for (const NewValue& value : recipe.values) {
            const SetPoint& point = kTable.values.at(value.index);
            require(value.value >= point.lowest && value.value <= point.highest);
        }
    }
    const RecipeReading again = read_recipes(write_recipes(read.recipes, kTable, format), kTable, format);
    require(again.recipes.size() == read.recipes.size());
    for (std::size_t i = 0; i < read.recipes.size(); ++i)
        require(again.recipes[i].name == read.recipes[i].name &&
                same(again.recipes[i].values, read.recipes[i].values));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    record({data, size});
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    recipes(text, RecipeFormat::csv);
    recipes(text, RecipeFormat::toml);
    return 0;
}
