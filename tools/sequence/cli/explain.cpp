#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/json.h"
#include "cli/subcommands.h"
#include "diagnostics/explanations.h"
#include "diagnostics/reference.h"
#include "language/names.h"
#include "registers/details.h"
#include "symbols/commands.h"

namespace nplc::seqc::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ExplainArguments {
    std::string code;
    bool json = false;
};

std::string indented(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n') + 1);
        result += fmt::format("    {}", line);
        text.remove_prefix(line.size());
    }
    return result;
}

std::string example(std::string_view title, std::string_view shade, std::string_view program) {
    if (program.empty()) return {};
    return fmt::format("\n{}\n{}", painted(stdout, shade, title), indented(shown_program(program)));
}

std::string page(const Explanation& info) {
    return fmt::format("{}: {}\n\n{}\n", painted(stdout, info.code[0] == 'E' ? "1;31" : "1;33", info.code),
                       painted(stdout, "1", info.title), info.text) +
           example("Wrong:", "1;31", info.wrong) + example("Right:", "1;32", info.right);
}

Json page_object(const Explanation& info) {
    Json object;
    object["code"] = info.code;
    object["title"] = info.title;
    object["explanation"] = info.text;
    object["wrong"] = whole_program(info.wrong);
    object["right"] = whole_program(info.right);
    return object;
}

/// Explains a word of the language, from the reference.
int explain_word(const std::string& word, const std::vector<Paragraph>& passages, bool json) {
    if (json) {
        Json document;
        document["word"] = word;
        document["passages"] = Json::array();
        for (const Paragraph& passage : passages)
            document["passages"].push_back({{"section", passage.section}, {"text", passage.text}});
        return print_json(document, kOk);
    }
    std::string text = painted(stdout, "1", word) + "\n";
    std::string_view section;
    for (const Paragraph& passage : passages) {
        if (passage.section != section) text += fmt::format("\nLANGUAGE.md, {}:\n", passage.section);
        section = passage.section;
        text += indented(fmt::format("{}\n", passage.text));
    }
    return print_or_write(text, {});
}

int number_of(std::string_view code) {
    const std::size_t digits = std::min(code.find_first_of("0123456789"), code.size());
    int number = -1;
    std::from_chars(code.data() + digits, code.data() + code.size(), number);
    return number;
}

/// "E010, E011 and E012" for E015; empty for a word that does not look like a code.
std::string nearest_codes(std::string_view wanted, std::vector<Explanation> all) {
    const int number = number_of(wanted);
    const std::string letter = upper(wanted.substr(0, 1));
    if (number < 0) return {};
    std::erase_if(all, [&](const Explanation& info) {
        return (letter == "E" || letter == "V" || letter == "W") && !info.code.starts_with(letter);
    });
    std::stable_sort(all.begin(), all.end(), [&](const Explanation& a, const Explanation& b) {
        return std::abs(number_of(a.code) - number) < std::abs(number_of(b.code) - number);
    });
    return fmt::format("; near it are {}, {} and {}", all[0].code, all[1].code, all[2].code);
}

/// "; did you mean WITHIN?", or a reference for a word of scenarios.
std::string nearest_word(std::string_view wanted) {
    constexpr std::array<std::string_view, 21> kOfScenarios{
        "at",    "every",   "when",   "once",  "follows", "appears", "disappears",
        "pulse", "toggle",  "cancel", "motor", "expect",  "ordered", "rises",
        "falls", "changes", "recipe", "seed",  "log",     "never",   "eventually"};
    const auto is_wanted = [&](std::string_view word) { return same_name(word, wanted); };
    if (std::any_of(kOfScenarios.begin(), kOfScenarios.end(), is_wanted))
        return "; it is a word of scenarios, which host-sim/scenario/README.md explains";
    const std::string guess = suggestion(wanted, reference_words());
    return guess.empty() ? guess : "; " + guess;
}

/// A mode, a bit or a field of the motors' registers: a line for each register that has it.
std::vector<std::string> values_named(std::string_view word) {
    std::vector<std::string> lines;
    const auto add = [&](std::string line) {
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(std::move(line));
    };
    for (const registers::Model model : {registers::Model::mac140, registers::Model::mac800}) {
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

/// Explains a name of the register maps.
int explain_values(const std::string& word, const std::vector<std::string>& lines, bool json) {
    if (json) {
        Json document;
        document["word"] = word;
        document["values"] = lines;
        return print_json(document, kOk);
    }
    std::string text = fmt::format("{}\n\nIn the motor's registers:\n", painted(stdout, "1", word));
    for (const std::string& line : lines) text += indented(line + "\n");
    return print_or_write(text, {});
}

int unknown(const ExplainArguments& options, const std::vector<Explanation>& all) {
    const std::string codes = nearest_codes(options.code, all);
    const std::string problem =
        fmt::format("there is no code '{}'{} (seqc explain lists all)", options.code.substr(0, 40),
                    codes.empty() ? nearest_word(options.code) : codes);
    if (!options.json) return file_problem(problem);
    Json document;
    document["error"] = problem;
    return print_json(document, kUsageOrFile);
}

int list(const std::vector<Explanation>& all, bool json) {
    if (json) {
        Json document;
        document["codes"] = Json::array();
        for (const Explanation& info : all) document["codes"].push_back(page_object(info));
        return print_json(document, kOk);
    }
    std::string text;
    for (const Explanation& info : all)
        text += fmt::format("{}  {}\n", painted(stdout, "1", info.code), info.title);
    return print_or_write(text, {});
}

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

int explain(const ExplainArguments& options) {
    const std::vector<Explanation> all = explanations();
    if (options.code.empty()) return list(all, options.json);
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const Explanation& info) { return same_name(info.code, options.code); });
    if (found == all.end()) {
        constexpr std::string_view kMoving = "moving";  // the only lower-case word
        const std::string word =
            same_name(options.code, kMoving) ? std::string(kMoving) : command_of(upper(options.code));
        const std::vector<Paragraph> passages = passages_about(word);
        if (!passages.empty()) return explain_word(word, passages, options.json);
        const std::vector<std::string> values = values_named(word);
        return values.empty() ? unknown(options, all) : explain_values(word, values, options.json);
    }
    return options.json ? print_json(page_object(*found), kOk) : print_or_write(page(*found), {});
}

}  // namespace

void add_explain(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<ExplainArguments>();
    arguments::App& command = *app.add_subcommand("explain",
                                                  "Tell what an error, a warning or a finding of verify "
                                                  "means, with a wrong and a right program; or what a "
                                                  "word of the language does");
    command.add_option("code", options->code,
                       "Such as E012 or W004, or a word such as TIMER; without one all codes are listed");
    command.add_flag("--json", options->json, "Print it as JSON");
    command.callback([options, &exit_code] { exit_code = explain(*options); });
}

}  // namespace nplc::seqc::cli
