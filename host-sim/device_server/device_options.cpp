#include "sim/device_options.h"

#include <fmt/format.h>

#include "sim/text.h"

namespace nplc::sim {

std::int64_t whole_value(const std::string& option, const std::string& text, std::int64_t min,
                         std::int64_t max) {
    const auto value = parse_integer(text);
    if (!value || *value < min || *value > max)
        throw std::invalid_argument(
            fmt::format("{} \"{}\": write a whole number {} to {}", option, text, min, max));
    return *value;
}

UnitText unit_value(const std::string& text, const std::string& example) {
    const auto colon = text.find(':');
    if (colon == std::string::npos)
        throw std::invalid_argument(
            fmt::format("--unit \"{}\": write MODEL:ADDRESS, such as {}", text, example));
    return {text.substr(0, colon), text.substr(colon + 1)};
}

void add_speed(arguments::App& app, const std::string& description, double& speed) {
    app.add_option("--speed", description)->each([&speed](const std::string& text) {
        const auto value = parse_decimal(text);
        if (!value || !(*value >= 0.01 && *value <= 100))
            throw std::invalid_argument(fmt::format("--speed \"{}\": write a number 0.01 to 100", text));
        speed = *value;
    });
}

void add_unit(arguments::App& app, const std::string& description,
              const std::function<void(const std::string&)>& take) {
    app.add_option("--unit", description)->type_name("MODEL:ADDRESS")->repeatable()->each(take);
}

}  // namespace nplc::sim
