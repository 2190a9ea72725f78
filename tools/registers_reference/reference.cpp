#include "registers_reference/reference.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "parts.h"
#include "registers/scale.h"

namespace nplc::registers_reference {
namespace {

using registers::Format;
using registers::Model;
using registers::Register;

std::string title_of(Model model) {
    return model == Model::mac800 ? "MAC800" : "MAC50, MAC95, MAC140 and MAC141";
}

std::string formats(Model model) {
    std::vector<Format> list = {Format::word, Format::integer, Format::long_int, Format::fixed4,
                                Format::fixed8};
    if (model == Model::mac800) list = {Format::long_int, Format::fixed16, Format::fixed24};
    std::string text = "| format | bits | sign | one step |\n| --- | --- | --- | --- |\n";
    for (const Format format : list) {
        const std::int64_t one = registers::one_in(format);
        text += fmt::format(
            "| {} | {} | {} | {} |\n", name_of(format), registers::is_32_bit(format) ? 32 : 16,
            format == Format::word ? "unsigned" : "signed", one == 1 ? "1" : fmt::format("1/{}", one));
    }
    return text;
}

/// Registers with the same note share a line.
std::string notes(Model model) {
    std::vector<std::pair<std::string_view, std::string>> lines;
    for (const Register& reg : registers::map_of(model)) {
        const std::string_view note = registers::details_of(model, reg.number)->note;
        if (note.empty()) continue;
        std::string who = fmt::format("{} {}", reg.number, reg.name);
        bool known = false;
        for (auto& [text, names] : lines) {
            if (text != note) continue;
            names += ", " + who;
            known = true;
        }
        if (!known) lines.emplace_back(note, std::move(who));
    }
    std::string result;
    for (const auto& [note, names] : lines) result += fmt::format("- {}: {}\n", names, note);
    return result;
}

constexpr std::string_view kHowToRead = R"(How to read the tables:

- **unit**: how many raw steps the register has for a unit of the world outside. {rates}
- **range**: raw values, and below them the same in the unit. Where a manual only recommends a range, the format's own
  is given first.
- **access**: *read only*: the motor overwrites it all the time, or it only tells something. *motor too*: it may be
  written, and the motor changes it as well.
- **danger**: a wrong value may damage the motor or upset its control. Also where nobody says what the register does.
- The manuals give no values from the factory. *nominal* is what they call normal.
{width}
)";

}  // namespace

std::string anchor(const Register& reg) {
    std::string text = fmt::format("{}-{}", reg.number, reg.name);
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

std::string cell(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '|') result += '\\';
        result += c;
    }
    return result;
}

std::string reference(Model model) {
    const bool large = model == Model::mac800;
    const auto scale = registers::exact_scale_of(model);
    const std::string rates = fmt::format("A turn is {} counts, and a sample\n  is taken {} times a second.",
                                          scale.counts_per_rev, large ? "770" : "520.83");
    const std::string_view width = large ? "- Every register is 32 bits wide and takes one number. Nothing "
                                           "is known of numbers that are missing."
                                         : "- A register with two numbers is 32 bits wide: the first holds "
                                           "the low word, the second the high one.";
    std::string text = fmt::format("# Registers of {}\n\n", title_of(model));
    text +=
        "Made from the tables in this folder with `cmake --build --preset release --target "
        "registers_reference`.\n"
        "Edit the tables, not this file. ";
    text += large ? "\"004\" is the MAC800's preliminary manual, \"001\" the technical manual of MAC50 to "
                    "MAC141.\n\n"
                  : "\"001\" is the technical manual of these motors.\n\n";
    text += fmt::format(fmt::runtime(kHowToRead), fmt::arg("rates", rates), fmt::arg("width", width));
    text += "\n## Formats\n\n" + formats(model);
    text += "\n## Registers\n" + registers_by_group(model);
    text += "\n## Bits and values\n" + bits_and_values(model);
    text += "\n## Where the manual is unclear\n\n" + notes(model);
    return text;
}

std::string file_name(Model model) {
    return model == Model::mac800 ? "REGISTERS_MAC800.md" : "REGISTERS_MAC50-141.md";
}

}  // namespace nplc::registers_reference
