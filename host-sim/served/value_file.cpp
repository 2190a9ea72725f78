#include "sim/value_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "host/files.h"
#include "sim/output_file.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

/// Far more than any memory holds.
constexpr std::size_t kMostBytes = std::size_t{1} << 20U;

std::string bad_line(const std::string& path, int line, const std::string& text, const std::string& form) {
    return fmt::format("{}:{}: \"{}\" is no `{}`; mend or remove the file", path, line, text.substr(0, 40),
                       form);
}

}  // namespace

ValueFile read_values(const std::string& path, const std::string& heading, const std::string& form) {
    ValueFile result;
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return result;
    result.exists = true;
    const host::FileContent file = host::read_file(path, kMostBytes);
    if (!file.problem.empty()) {
        result.error = fmt::format("{}: cannot be read: {}", path, file.problem);
        return result;
    }
    std::istringstream lines(file.bytes.empty() ? "\n" : file.bytes);
    std::string line;
    for (int number = 1; result.error.empty() && std::getline(lines, line); ++number) {
        const std::string text(trim(line.substr(0, line.find('#'))));
        if (number == 1 && trim(line) != heading)
            result.error = fmt::format("{}:1: this file is something else; the first line must be \"{}\"",
                                       path, heading);
        if (text.empty() || !result.error.empty()) continue;
        const auto equals = text.find('=');
        const auto value = equals == std::string::npos
                               ? std::nullopt
                               : parse_integer(trim(std::string_view(text).substr(equals + 1)));
        if (value)
            result.values.push_back(
                {std::string(trim(std::string_view(text).substr(0, equals))), *value, number});
        else
            result.error = bad_line(path, number, text, form);
    }
    return result;
}

std::string bad_value(const std::string& path, const NamedValue& value, const std::string& form) {
    return bad_line(path, value.line, fmt::format("{} = {}", value.name, value.value), form);
}

std::string try_values(const std::string& path) try {
    OutputFile file(path);
    return {};
} catch (const FileError& error) {
    return error.what();
}

std::string write_values(const std::string& path, const std::string& heading,
                         const std::vector<NamedValue>& values) try {
    OutputFile file(path);
    file.write(heading + "\n");
    for (const NamedValue& value : values) file.write(fmt::format("{} = {}\n", value.name, value.value));
    file.commit();
    return {};
} catch (const FileError& error) {
    return error.what();
}

}  // namespace nplc::sim
