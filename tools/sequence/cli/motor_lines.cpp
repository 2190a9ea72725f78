#include "cli/motor_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(kBlanks), text.size());
    text.remove_prefix(begin);
    return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Text up to a comment or one of `ends`, outside of quotes.
std::string_view up_to(std::string_view text, std::string_view ends) {
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') quoted = !quoted;
        if (quoted) continue;
        if (ends.find(text[i]) != std::string_view::npos || text.substr(i).starts_with("//"))
            return text.substr(0, i);
    }
    return text;
}

bool begins_with_word(std::string_view text, std::string_view word) {
    const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    return text.size() > word.size() && kBlanks.find(text[word.size()]) != std::string_view::npos &&
           std::equal(word.begin(), word.end(), text.begin(), [&](char b, char a) { return same(a, b); });
}

/// A plant file's path is relative to the scenario's folder, and the new scenario may be in another one.
std::string with_whole_path(std::string_view action, const fs::path& folder) {
    const std::size_t open = action.find('"');
    const std::size_t close = action.rfind('"');
    if (open == std::string_view::npos || close == open) return std::string(action);
    const fs::path file = fs::absolute(folder / fs::path(action.substr(open + 1, close - open - 1)));
    return fmt::format("{}{}{}", action.substr(0, open + 1), file.lexically_normal().string(),
                       action.substr(close));
}

void add_actions(std::string_view line, const fs::path& folder, std::vector<std::string>& lines) {
    line = up_to(line, "#");
    if (!begins_with_word(trimmed(line), "motor")) return;
    while (!line.empty()) {
        const std::string_view action = up_to(line, ",");
        line.remove_prefix(std::min(action.size() + 1, line.size()));
        if (begins_with_word(trimmed(action), "motor"))
            lines.push_back(with_whole_path(trimmed(action), folder));
    }
}

}  // namespace

MotorLines motor_lines_of(const std::string& file) {
    const fs::path path(file);
    if (path.extension() == ".toml")
        return {.lines = {fmt::format("motor plant \"{}\"", fs::absolute(path).lexically_normal().string())}};
    const whole_files::FileText text = whole_files::read_text(file);
    if (!text.error.empty()) return {.error = text.error};
    MotorLines found;
    std::string_view rest = text.text;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        add_actions(line, path.parent_path(), found.lines);
    }
    if (found.lines.empty()) {
        found.error = fmt::format(
            "{}: says nothing of the motor at the beginning, such as motor stop below -2 rev; name a "
            "scenario that "
            "does, or a plant file, axis.toml",
            file);
    }
    return found;
}

}  // namespace nplc::seqc::cli
