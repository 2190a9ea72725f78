#include "sim/axis.h"

#include <fmt/format.h>

#include <filesystem>

#include "host/text_file.h"

namespace nplc::sim {

AxisReading read_axis(const std::string& file, registers::Model model) {
    constexpr std::size_t kLargest = std::size_t{1} << 20U;
    AxisReading result;
    const host::FileContent content = host::read_text(file, kLargest);
    if (!content.problem.empty()) {
        result.error = fmt::format("{}: cannot be read: {}; name a file that `macreg fit` has written", file,
                                   content.problem);
        return result;
    }
    plant_file::Reading read = plant_file::read_plant(content.bytes, file);
    result.error = std::move(read.error);
    if (!result.error.empty()) return result;
    if (const std::string why = plant_file::mismatch(read.plant, model); !why.empty()) {
        result.error = fmt::format("{}:{}: {}", file, read.plant.motor_line, why);
        return result;
    }
    result.load = load_of(read.plant, model);
    result.plant = std::move(read.plant);
    return result;
}

/// Names in the scenario are relative to its folder.
AxisReading read_axis(const std::string& option, const Scenario& scenario, registers::Model model) {
    if (!option.empty()) return read_axis(option, model);
    if (!scenario.plant) return {};
    const std::filesystem::path folder = std::filesystem::path(scenario.file).parent_path();
    AxisReading result = read_axis((folder / scenario.plant->file).string(), model);
    if (!result.error.empty())
        result.error = fmt::format("{}:{}: {}", scenario.file, scenario.plant->line, result.error);
    return result;
}

}  // namespace nplc::sim
