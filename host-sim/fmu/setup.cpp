#include "sim/fmu/setup.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/crc32.h"

namespace nplc::sim::fmu {
namespace {

constexpr std::size_t kMostBytes = 1U << 20U;
constexpr std::string_view kHeading = "nanoplc-fmu 1\n";

std::uint32_t crc_of(std::string_view text) {
    return base::crc32({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

struct Content {
    std::string bytes;
    std::string problem;
};

/// Not through the system's own file functions, which would add their dependencies to the library.
Content read_file(const std::string& name) {
    Content content;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "rb"), std::fclose);
    if (file == nullptr) return {.bytes = {}, .problem = std::strerror(errno)};
    content.bytes.resize(kMostBytes);
    content.bytes.resize(std::fread(content.bytes.data(), 1, kMostBytes, file.get()));
    if (std::ferror(file.get()) != 0) content.problem = std::strerror(errno);
    return content;
}

std::string in_folder(std::string folder, std::string_view file) {
    if (!folder.empty() && !folder.ends_with('/') && !folder.ends_with('\\')) folder += '/';
    return folder.append(file);
}

/// Takes "WORD VALUE\n" from the front of `text`, such as "motor MAC140\n" or "table N\n".
bool take(std::string_view& text, std::string_view word, std::string_view& value) {
    if (!text.starts_with(word) || !text.substr(word.size()).starts_with(' ')) return false;
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return false;
    value = text.substr(word.size() + 1, end - word.size() - 1);
    text.remove_prefix(end + 1);
    return true;
}

/// "256 5 0 0 0"; the plant itself limits extreme values.
std::optional<Load> load_in(std::string_view text) {
    std::array<double, 5> numbers{};
    for (double& number : numbers) {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (text.starts_with(' ')) text.remove_prefix(1);
    }
    if (!text.empty() || numbers[4] < 0 || numbers[4] > Load::kLatest) return std::nullopt;
    return Load{.inertia_256 = numbers[0],
                .friction_torque = numbers[1],
                .torque = numbers[3],
                .viscous_torque = numbers[2],
                .late_inner_samples = static_cast<std::int32_t>(numbers[4])};
}

std::string damaged(const std::string& file, std::string_view why) {
    return fmt::format("{}: {}; write the FMU anew with `nanoplc-sim fmu`", file, why);
}

}  // namespace

std::string machine_text(const Setup& setup) {
    std::string text = fmt::format("{}motor {}\n", kHeading, registers::name_of(setup.motor));
    if (setup.table) text += fmt::format("table {:08X}\n", base::crc32(*setup.table));
    if (setup.plant) {
        const Load& load = *setup.plant;
        text += fmt::format("plant {:.17g} {:.17g} {:.17g} {:.17g} {}\n", load.inertia_256,
                            load.friction_torque, load.viscous_torque, load.torque, load.late_inner_samples);
    }
    return text;
}

std::string token_of(const Setup& setup) {
    return fmt::format("{{nanoplc-{}-{:08x}-{:08x}}}", NPLC_VERSION, crc_of(machine_text(setup)),
                       setup.table ? base::crc32(*setup.table) : 0);
}

SetupReading read_setup(const std::string& resources) {
    SetupReading reading;
    const std::string machine_file = in_folder(resources, kMachineFile);
    const Content machine = read_file(machine_file);
    if (!machine.problem.empty()) {
        reading.problem = fmt::format("{}: cannot be read: {}; the FMU must be unpacked as it is",
                                      machine_file, machine.problem);
        return reading;
    }
    std::string_view text = machine.bytes;
    std::string_view value;
    if (!text.starts_with(kHeading)) {
        reading.problem = damaged(machine_file, "is not of this version");
        return reading;
    }
    text.remove_prefix(kHeading.size());
    const auto model = take(text, "motor", value) ? registers::model_of(value) : std::nullopt;
    if (!model) {
        reading.problem = damaged(machine_file, "names no motor");
        return reading;
    }
    reading.setup.motor = *model;
    if (take(text, "table", value)) {
        const std::string table_file = in_folder(resources, kTableFile);
        const Content table = read_file(table_file);
        if (!table.problem.empty() || fmt::format("{:08X}", crc_of(table.bytes)) != value) {
            reading.problem = damaged(table_file, table.problem.empty() ? "is damaged" : table.problem);
            return reading;
        }
        reading.setup.table.emplace(table.bytes.begin(), table.bytes.end());
    }
    if (take(text, "plant", value)) {
        reading.setup.plant = load_in(value);
        if (!reading.setup.plant) text = value;
    }
    if (!text.empty()) reading.problem = damaged(machine_file, "is damaged");
    return reading;
}

}  // namespace nplc::sim::fmu
