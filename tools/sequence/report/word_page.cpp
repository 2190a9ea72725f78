#include "report/word_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

#include "language/names.h"
#include "language/reserved_words.h"
#include "registers/details.h"
#include "report/register_facts.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

using registers::Model;

struct MapOfMotors {
    Model model;
    std::string_view motors;
};

constexpr std::array kMaps{
    MapOfMotors{Model::mac140, "MAC50, MAC95, MAC140, MAC141"},
    MapOfMotors{Model::mac800, "MAC800"},
};

/// CLEAR_P_IST for 03H or 63H, the manuals' notation; other words unchanged.
std::string command_of(const std::string& word) {
    unsigned byte = 0;
    const char* const end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, byte, 16);
    if (word.size() != 3 || read.ptr != end - 1 || word.back() != 'H' || byte > 0x7F) return word;
    const auto number = static_cast<std::uint8_t>(byte);
    const std::string text =
        describe_command(byte < table::kCommandNumbers ? table::command_numbered(number) : number);
    return text.substr(0, text.find('('));
}

std::vector<RegisterPage> registers_named(std::string_view word) {
    std::vector<RegisterPage> pages;
    for (const auto& [model, motors] : kMaps) {
        const registers::Register* reg = registers::find(model, word);
        if (reg == nullptr) continue;
        const registers::Details* details = registers::details_of(model, reg->number);
        pages.push_back({std::string(motors), std::string(reg->name), reg->number,
                         details == nullptr ? "" : std::string(details->title),
                         register_facts(*reg, model, {})});
    }
    return pages;
}

std::vector<std::string> values_named(std::string_view word) {
    std::vector<std::string> lines;
    const auto add = [&](std::string line) {
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
    };
    for (const auto& [model, motors] : kMaps) {
        for (const registers::Register& reg : registers::map_of(model)) {
            const std::string place = fmt::format("{} (register {})", reg.name, reg.number);
            for (const registers::Field& field : registers::fields_of(model, reg.number)) {
                if (same_name(field.name, word) && field.width == 1)
                    add(fmt::format("bit {} of {}: {}", field.first, place, field.meaning));
                else if (same_name(field.name, word))
                    add(fmt::format("bits {} to {} of {}: {}", field.first, field.first + field.width - 1,
                                    place, field.meaning));
                for (const registers::NamedValue& value : field.values) {
                    if (same_name(value.name, word))
                        add(fmt::format("value {} of {} in {}: {}", value.value, field.name, place,
                                        value.meaning));
                }
            }
        }
    }
    return lines;
}

constexpr std::string_view kMoving = "moving";  // the language's only lower-case word

/// All words that page_of_word() knows.
std::vector<std::string_view> known_words() {
    std::vector<std::string_view> words = reference_words();
    words.push_back(kMoving);
    for (const auto& [model, motors] : kMaps) {
        for (const registers::Register& reg : registers::map_of(model)) {
            words.push_back(reg.name);
            for (const registers::Field& field : registers::fields_of(model, reg.number)) {
                words.push_back(field.name);
                for (const registers::NamedValue& value : field.values) words.push_back(value.name);
            }
        }
    }
    std::erase(words, "");
    std::sort(words.begin(), words.end());
    words.erase(std::unique(words.begin(), words.end()), words.end());
    return words;
}

}  // namespace

WordPage page_of_word(std::string_view written) {
    WordPage page;
    page.word = same_name(written, kMoving) ? std::string(kMoving) : command_of(upper(written));
    const std::vector<std::string_view> commands = command_names();
    page.is_of_language =
        is_reserved(page.word) || std::find(commands.begin(), commands.end(), page.word) != commands.end();
    page.passages = passages_about(page.word);
    page.registers = registers_named(page.word);
    page.values = values_named(page.word);
    return page;
}

std::string nearest_words(std::string_view wanted) {
    constexpr std::array<std::string_view, 21> kOfScenarios{
        "at",    "every",   "when",   "once",  "follows", "appears", "disappears",
        "pulse", "toggle",  "cancel", "motor", "expect",  "ordered", "rises",
        "falls", "changes", "recipe", "seed",  "log",     "never",   "eventually"};
    const auto is_wanted = [&](std::string_view word) { return same_name(word, wanted); };
    if (std::any_of(kOfScenarios.begin(), kOfScenarios.end(), is_wanted))
        return "; it is a word of scenarios, which host-sim/scenario/README.md explains";
    constexpr std::size_t kMost = 3;
    const std::vector<std::string_view> words = known_words();
    if (const auto meant = all_nearest(wanted, words); !meant.empty())
        return fmt::format("; did you mean '{}'?", fmt::join(meant, "' or '"));
    // None is near enough to be meant
    std::vector<std::string_view> near = most_similar(wanted, words, kMost);
    if (near.empty()) return {};
    const std::string_view last = near.back();
    near.pop_back();
    return near.empty() ? fmt::format("; nearest is {}", last)
                        : fmt::format("; nearest are {} and {}", fmt::join(near, ", "), last);
}

}  // namespace nplc::seqc
