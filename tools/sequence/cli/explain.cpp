#include <fmt/format.h>

#include <algorithm>
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
#include "language/names.h"
#include "report/word_page.h"

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
        result += line == "\n" ? "\n" : fmt::format("    {}", line);
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

std::string passages_text(const WordPage& page) {
    std::string text;
    std::string_view section;
    for (const Paragraph& passage : page.passages) {
        if (passage.section != section) text += fmt::format("\nLANGUAGE.md, {}:\n", passage.section);
        section = passage.section;
        text += indented(fmt::format("{}\n", shown(passage)));
    }
    return text;
}

std::string registers_text(const WordPage& page) {
    std::string text;
    for (const RegisterPage& reg : page.registers) {
        const std::string own =
            same_name(reg.name, page.word) ? "" : fmt::format(", {} in its manual", reg.name);
        text += fmt::format("\nRegister {}{}: {} ({})\n", reg.number, own, reg.title, reg.motors) +
                indented(reg.facts);
    }
    if (!page.values.empty()) text += "\nIn the motor's registers:\n";
    for (const std::string& line : page.values) text += indented(line + "\n");
    return text;
}

std::string word_text(const WordPage& page) {
    const std::string head = painted(stdout, "1", page.word) + "\n";
    return page.is_of_language ? head + passages_text(page) + registers_text(page)
                               : head + registers_text(page) + passages_text(page);
}

Json word_object(const WordPage& page) {
    Json document;
    document["word"] = page.word;
    for (const Paragraph& passage : page.passages)
        document["passages"].push_back({{"section", passage.section}, {"text", passage.text}});
    for (const RegisterPage& reg : page.registers)
        document["registers"].push_back({{"motors", reg.motors},
                                         {"number", reg.number},
                                         {"name", reg.name},
                                         {"title", reg.title},
                                         {"facts", reg.facts}});
    if (!page.values.empty()) document["values"] = page.values;
    return document;
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

int unknown(const ExplainArguments& options, const std::vector<Explanation>& all) {
    const std::string codes = nearest_codes(options.code, all);
    const std::string shown = options.code.substr(0, 40);
    const std::string problem =
        codes.empty() ? fmt::format(
                            "'{}' is no code, word, command, register, mode or bit{} (seqc explain lists "
                            "the codes, LANGUAGE.md the words)",
                            shown, nearest_words(options.code))
                      : fmt::format("there is no code '{}'{} (seqc explain lists all)", shown, codes);
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

int explain(const ExplainArguments& options) {
    const std::vector<Explanation> all = explanations();
    if (options.code.empty()) return list(all, options.json);
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const Explanation& info) { return same_name(info.code, options.code); });
    if (found == all.end()) {
        const WordPage word = page_of_word(options.code);
        if (word.is_empty()) return unknown(options, all);
        return options.json ? print_json(word_object(word), kOk) : print_or_write(word_text(word), {});
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
    command.add_option(
        "code", options->code,
        "Such as E012 or W004, or a word such as TIMER, HOME or V_HOME; without one all codes are listed");
    command.add_flag("--json", options->json, "Print it as JSON");
    command.callback([options, &exit_code] { exit_code = explain(*options); });
}

}  // namespace nplc::seqc::cli
