#include "views/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "views/graph_model.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

bool continues(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Bytes of the character that `text` begins with; 0 if it is none that XML may hold.
std::size_t character_length(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    if (first < 0x80) return first >= 0x20 && first != 0x7F ? 1 : 0;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
    if (!std::all_of(text.begin() + 1, text.begin() + static_cast<std::ptrdiff_t>(length), continues))
        return 0;
    std::uint32_t code = first & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i)
        code = (code << 6) | (static_cast<unsigned char>(text[i]) & 0x3FU);
    constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    const bool control = code < 0xA0 || code == 0xFFFE || code == 0xFFFF;
    return code < kLeast[length] || code > 0x10FFFF || surrogate || control ? 0 : length;
}

/// Calls `use` with each character, a replacement for what is none.
template <class Use>
void for_each_character(std::string_view text, Use use) {
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        use(length == 0 ? kReplacement : text.substr(0, length));
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
}

std::string_view entity(std::string_view character) {
    if (character == "&") return "&amp;";
    if (character == "<") return "&lt;";
    if (character == ">") return "&gt;";
    if (character == "\"") return "&quot;";
    return character;
}

std::size_t characters_in(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

/// How much of `text` belongs together at its beginning, with the blank that ends it.
std::size_t piece_length(std::string_view text) {
    for (std::size_t at = 1; at < text.size(); ++at) {
        if (text[at - 1] != ' ') continue;
        const bool after_mark = at >= 2 && (text[at - 2] == ',' || text[at - 2] == ';');
        if (after_mark || text.substr(at).starts_with("AND ") || text.substr(at).starts_with("OR "))
            return at;
    }
    return text.size();
}

}  // namespace

std::string quoted(std::string_view text) {
    std::string result = "\"";
    for_each_character(text, [&](std::string_view character) {
        if (character == "\"" || character == "\\") result += '\\';
        result += character;
    });
    return result + "\"";
}

std::string markup(std::string_view text) {
    std::string result;
    for_each_character(text, [&](std::string_view character) { result += entity(character); });
    return result;
}

std::vector<std::string> wrapped(std::string_view text, std::size_t width) {
    std::vector<std::string> lines;
    const bool fits = characters_in(text) <= width;
    while (!text.empty()) {
        const std::string_view piece = text.substr(0, piece_length(text));
        text.remove_prefix(piece.size());
        if (lines.empty() || (!fits && piece.starts_with("OR ")) ||
            characters_in(lines.back()) + characters_in(piece) > width)
            lines.emplace_back();
        lines.back() += piece;
    }
    for (std::string& line : lines) {
        while (line.ends_with(' ')) line.pop_back();
    }
    return lines;
}

namespace {

constexpr std::size_t kBoxWidth = 36;   // characters of a line in a step
constexpr std::size_t kEdgeWidth = 26;  // and beside an arrow
// What Graphviz lays out in seconds; beyond it the arrows go without their labels.
constexpr std::size_t kMostArrows = 250;
constexpr std::size_t kMostWays = 500;

constexpr const char* kActionColour = "#1f4e79";
constexpr const char* kErrorColour = "#c00000";
constexpr const char* kStyle = R"(
  node [fontname="Helvetica", fontsize=11, shape=box, style=filled, fillcolor="#ffffff", color="#333333", margin="0.08,0.04"];
  edge [fontname="Helvetica", fontsize=10, color="#333333", arrowsize=0.7];
)";
// A4 less half an inch of margin.
constexpr const char* kPage =
    R"(size="7.3,10.7", margin=0.2, nodesep=0.4, ranksep=0.4, labelloc=b, fontname="Helvetica", fontsize=9)";

std::string row(std::string_view content) {
    return fmt::format(R"(<TR><TD ALIGN="LEFT">{}</TD></TR>)", content);
}

std::string rows(std::string_view text, std::size_t width) {
    std::string result;
    for (const std::string& line : wrapped(text, width)) result += row(markup(line));
    return result;
}

std::string action_rows(std::string_view text, std::size_t width) {
    std::string result;
    for (const std::string& line : wrapped(text, width))
        result += row(fmt::format(R"(<FONT COLOR="{}">{}</FONT>)", kActionColour, markup(line)));
    return result;
}

std::string way_rows(std::string_view before, const GraphModel::Way& way, std::size_t width) {
    const std::string condition = fmt::format("{}{}", before, way.condition);
    return rows(condition, width) + (way.actions.empty() ? "" : action_rows("/ " + way.actions, width));
}

std::string table_of(std::string_view content) {
    return fmt::format(R"(<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="1">{}</TABLE>>)",
                       content);
}

std::string node(const GraphModel::Box& box) {
    std::string content = fmt::format("<B>{}</B>", markup(box.name));
    if (box.shows_number) content = fmt::format(R"(<FONT COLOR="#777777">{}</FONT>  {})", box.step, content);
    content = fmt::format("<TR><TD>{}</TD></TR>", content);
    if (!box.reachable) content += "<TR><TD>never reached</TD></TR>";
    std::string rest;
    for (const std::string& output : box.outputs) rest += rows(output, kBoxWidth);
    rest += action_rows(box.entry, kBoxWidth);
    for (const GraphModel::Way& way : box.every_scan) rest += way_rows("EVERY_SCAN, ", way, kBoxWidth);
    if (!rest.empty()) content += "<HR/>" + rest;
    return fmt::format("    s{} [label={}{}{}];\n", box.step, table_of(content),
                       box.step == 0 ? ", peripheries=2" : "",
                       box.reachable ? "" : R"(, fillcolor="#dddddd", fontcolor="#555555")");
}

std::string edge(const GraphModel::Arrow& arrow, bool labelled) {
    std::string label;
    for (const GraphModel::Way& way : arrow.ways) label += way_rows("", way, kEdgeWidth);
    std::string style = labelled ? "label=" + table_of(label) : "label=\"\"";
    if (arrow.on_error) style += fmt::format(R"(, style=dashed, color="{0}", fontcolor="{0}")", kErrorColour);
    // Round the outside.
    if (arrow.leads_far_back) style += ", tailport=e, headport=e";
    return fmt::format("    s{} -> s{} [{}];\n", arrow.from, arrow.to, style);
}

std::string note(std::size_t number, const GraphModel::ErrorNote& note) {
    std::string content = row("<B>ERROR</B>") + rows(note.where, kEdgeWidth);
    if (!note.actions.empty()) content += action_rows("/ " + note.actions, kEdgeWidth);
    return fmt::format(
        "    e{0} [shape=note, color=\"{3}\", fontcolor=\"{3}\", fontsize=10, label={1}];\n"
        "    e{0} -> s{2} [style=dashed, color=\"{3}\"];\n",
        number, table_of(content), note.to, kErrorColour);
}

bool can_label(const GraphModel& model) {
    std::size_t ways = 0;
    for (const GraphModel::Arrow& arrow : model.arrows) ways += arrow.ways.size();
    return model.arrows.size() <= kMostArrows && ways <= kMostWays;
}

}  // namespace

std::string graph_of(std::span<const std::uint8_t> table, const Symbols* symbols, const std::string& title) {
    const GraphModel model = graph_model_of(table, symbols, title);
    const bool labelled = can_label(model);
    std::string text =
        fmt::format("digraph {} {{\n  graph [{}, label=<{}{}>];", quoted(model.title), kPage,
                    markup(model.footer), labelled ? "" : "; too many switches to say more: see seqc report");
    text += kStyle;
    text += fmt::format(
        "  subgraph cluster_table {{\n    graph [peripheries=0, fontsize=16, labelloc=t, "
        "label=<<B>{}</B>{}>];\n"
        "    {{ rank=min; s0; }}\n",
        markup(model.title), model.motor.empty() ? "" : "  " + model.motor);
    for (const GraphModel::Box& box : model.boxes) text += node(box);
    std::size_t number = 0;
    for (const GraphModel::ErrorNote& error : model.notes) text += note(number++, error);
    for (const GraphModel::Arrow& arrow : model.arrows) text += edge(arrow, labelled);
    return text + "  }\n}\n";
}

}  // namespace nplc::seqc
