#include "sim/device_memory.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <sstream>

#include "host/text_file.h"
#include "sim/output_file.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

/// More than any memory holds.
constexpr std::size_t kMostBytes = std::size_t{1} << 20U;

/// NAME = VALUE
std::optional<NamedValue> parse_line(std::string_view text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) return std::nullopt;
    const auto value = parse_integer(trim(text.substr(equals + 1)));
    if (!value) return std::nullopt;
    return NamedValue{std::string(trim(text.substr(0, equals))), *value};
}

std::string bad_line(const std::string& path, int line, const std::string& text, const std::string& form) {
    return fmt::format("{}:{}: \"{}\" is no `{}`; mend or remove the file", path, line, text.substr(0, 40),
                       form);
}

std::string load(const std::string& path, DeviceMemory& memory) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return {};
    const host::FileContent file = host::read_text(path, kMostBytes);
    if (!file.problem.empty()) return fmt::format("{}: cannot be read: {}", path, file.problem);
    std::istringstream lines(file.bytes.empty() ? "\n" : file.bytes);
    std::string line;
    std::string unknown;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (number == 1 && trim(line) != memory.heading())
            return fmt::format("{}:1: this file is something else; the first line must be \"{}\"", path,
                               memory.heading());
        const std::string text(trim(line.substr(0, line.find('#'))));
        if (text.empty()) continue;
        const auto value = parse_line(text);
        if (!value) return bad_line(path, number, text, memory.form());
        if (unknown.empty() && !memory.take(*value))
            unknown =
                bad_line(path, number, fmt::format("{} = {}", value->name, value->value), memory.form());
    }
    if (unknown.empty()) memory.restore();
    return unknown;
}

std::string save(const std::string& path, const DeviceMemory& memory) try {
    OutputFile file(path);
    file.write(memory.heading() + "\n");
    for (const NamedValue& value : memory.values())
        file.write(fmt::format("{} = {}\n", value.name, value.value));
    file.commit();
    return {};
} catch (const FileError& error) {
    return error.what();
}

/// Leaves no temporary file behind.
std::string try_to_save(const std::string& path) try {
    OutputFile file(path);
    return {};
} catch (const FileError& error) {
    return error.what();
}

}  // namespace

std::string MemoryFiles::add(const std::string& file, int address, std::unique_ptr<DeviceMemory> memory) {
    if (file.empty()) return {};
    const std::string path = files_.empty() ? file : fmt::format("{}.{}", file, address);
    std::string error = load(path, *memory);
    if (error.empty()) error = try_to_save(path);
    const std::uint32_t written = memory->writes();
    files_.push_back({path, std::move(memory), written});
    return error;
}

std::string MemoryFiles::save_changed() {
    for (File& file : files_) {
        if (file.memory->writes() == file.written) continue;
        file.written = file.memory->writes();
        if (std::string error = save(file.path, *file.memory); !error.empty()) return error;
    }
    return {};
}

}  // namespace nplc::sim
