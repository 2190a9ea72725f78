#include "report/graph/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "report/graph/graph_model.h"
#include "report/graph/graph_text.h"
#include "report/table_text.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kBoxWidth = 36;  // letters of a line in a step
constexpr std::size_t kNoteWidth = 30;

constexpr const char* kActionColour = "#1f4e79";
constexpr const char* kTargetColour = "#555555";
constexpr const char* kErrorColour = "#c00000";
constexpr const char* kNoteColour = "#8a5a00";
constexpr const char* kStyle = R"(
  node [fontname="Helvetica", fontsize=11, shape=box, style=filled, fillcolor="#ffffff", color="#333333", margin="0.06,0.04"];
  edge [color="#333333", arrowsize=0.7];
)";
// A4 minus margins of half an inch.
constexpr const char* kPage =
    R"(size="7.3,10.7", margin=0.2, nodesep=0.3, ranksep=0.3, labelloc=b, fontname="Helvetica", fontsize=9)";

using LinePair = std::pair<std::uint8_t, std::uint8_t>;  // from, to

/// The pairs of steps with a line between them, and whether only ERROR leads along it.
std::map<LinePair, bool> lines_of(const GraphModel& model) {
    std::map<LinePair, bool> lines;
    for (const GraphModel::Box& box : model.boxes) {
        for (const GraphModel::Way& way : box.ways) {
            if (way.to == box.step) continue;
            const auto [line, is_new] = lines.try_emplace({box.step, way.by.value_or(way.to)}, way.on_error);
            if (!is_new) line->second = line->second && way.on_error;
        }
    }
    return lines;
}

std::string coloured(std::string_view colour, std::string_view content) {
    return fmt::format(R"(<FONT COLOR="{}">{}</FONT>)", colour, content);
}

std::string row(std::string_view content) {
    return fmt::format(R"(<TR><TD ALIGN="LEFT" COLSPAN="2">{}</TD></TR>)", content);
}

std::string rows(std::string_view text, std::size_t width) {
    std::string result;
    for (const std::string& line : wrapped(text, width)) result += row(markup(line));
    return result;
}

std::string action_rows(std::string_view text, std::size_t width) {
    std::string result;
    for (const std::string& line : wrapped(text, width)) result += row(coloured(kActionColour, markup(line)));
    return result;
}

/// Lines of a cell.
std::string lines(std::string_view text, std::string_view colour) {
    std::string result;
    for (const std::string& line : wrapped(text, kBoxWidth)) {
        const std::string content = markup(line);
        result += (colour.empty() ? content : coloured(colour, content)) + R"(<BR ALIGN="LEFT"/>)";
    }
    return result;
}

class Drawing {
  public:
    explicit Drawing(const GraphModel& model) : model_(model) {}

    std::string text() const {
        const std::string_view legend = legend_of(model_);
        std::string text = fmt::format("digraph {} {{\n  graph [{}, label=<{}{}{}>];", quoted(model_.title),
                                       kPage, markup(model_.footer), legend.empty() ? "" : "; ", legend);
        text += kStyle;
        text += fmt::format(
            "  subgraph cluster_table {{\n    graph [peripheries=0, fontsize=16, labelloc=t, "
            "label=<<B>{}</B>{}>];\n",
            markup(model_.title), machine());
        for (const GraphModel::Box& box : model_.boxes) text += node(box);
        for (std::size_t i = 0; i < model_.notes.size(); ++i) text += note(i);
        text += all_lines();
        return text + "  }\n}\n";
    }

  private:
    /// Motor, scale and terminals, a line each.
    std::string machine() const {
        std::string text;
        if (!model_.motor.empty()) text += small("Motor: " + model_.motor);
        if (!model_.scale.empty()) text += small("Scale: " + model_.scale);
        for (const auto& [terminal, name] : model_.terminals) text += small(terminal + " = " + name);
        for (const std::string& point : model_.set_points) text += small(point);
        return text;
    }

    static std::string small(const std::string& line) {
        return fmt::format(R"(<BR/><FONT POINT-SIZE="10">{}</FONT>)", markup(line));
    }

    std::string name_of(std::uint8_t step) const {
        const auto box = std::find_if(model_.boxes.begin(), model_.boxes.end(),
                                      [&](const GraphModel::Box& b) { return b.step == step; });
        if (box == model_.boxes.end()) return fmt::format("step {}", step);
        return box->shows_number ? fmt::format("{} {}", step, box->name) : box->name;
    }

    /// An outgoing transition has its target step next to it.
    std::string way_row(std::uint8_t step, const GraphModel::Way& way) const {
        const bool stays = way.to == step;
        const bool acts_on = stays && !way.actions.empty();
        const std::string condition = acts_on ? "EVERY_SCAN, " + way.condition : way.condition;
        std::string content = lines(condition, way.on_error ? kErrorColour : "");
        if (!way.actions.empty()) content += lines("/ " + way.actions, kActionColour);
        if (acts_on) return row(content);
        const std::string by = way.by ? fmt::format(", by {}", *way.by) : "";
        const std::string target = stays ? "\u00A0\u00A0stays" : to(way) + by;
        return fmt::format(R"(<TR><TD ALIGN="LEFT">{}</TD><TD ALIGN="RIGHT" VALIGN="TOP">{}</TD></TR>)",
                           content, coloured(kTargetColour, target));
    }

    /// Blanks as distance to the preceding text.
    std::string to(const GraphModel::Way& way) const {
        return "\u00A0\u00A0\u2192 " + markup(name_of(way.to));
    }

    static std::string table_of(std::string_view content) {
        return fmt::format(R"(<<TABLE BORDER="0" CELLBORDER="0" CELLSPACING="0" CELLPADDING="2">{}</TABLE>>)",
                           content);
    }

    std::string node(const GraphModel::Box& box) const {
        std::string content = fmt::format("<B>{}</B>", markup(box.name));
        if (box.shows_number)
            content = fmt::format(R"(<FONT COLOR="#777777">{}</FONT>  {})", box.step, content);
        content = fmt::format(R"(<TR><TD COLSPAN="2">{}</TD></TR>)", content);
        if (!box.reachable) content += R"(<TR><TD COLSPAN="2">never reached</TD></TR>)";
        if (!box.made_as.empty())
            content += fmt::format(R"(<TR><TD COLSPAN="2">{}</TD></TR>)", markup(box.made_as));
        if (box.steps.size() > 1)
            content += fmt::format(R"(<TR><TD COLSPAN="2">{}</TD></TR>)", numbers_text(box.steps));
        std::string rest;
        for (const std::string& output : box.outputs) rest += rows(output, kBoxWidth);
        for (const std::string& line : box.entry) rest += action_rows(line, kBoxWidth);
        if (!rest.empty()) content += "<HR/>" + rest;
        std::string ways;
        for (const GraphModel::Way& way : box.ways) ways += way_row(box.step, way);
        if (!ways.empty()) content += "<HR/>" + ways;
        return fmt::format("    s{} [label={}{}{}];\n", box.step, table_of(content),
                           box.step == 0 ? ", peripheries=2" : "",
                           !box.reachable        ? R"(, fillcolor="#dddddd", fontcolor="#555555")"
                           : !box.is_of_compiler ? ""
                                                 : R"(, style="filled,rounded,dashed", fillcolor="#f2f5f9")");
    }

    std::string note(std::size_t number) const {
        const GraphModel::Note& note = model_.notes[number];
        std::string content;
        for (const std::string& line : wrapped(note.way.condition, kNoteWidth))
            content += row("<B>" + markup(line) + "</B>");
        content += rows(note.where, kNoteWidth);
        if (!note.way.actions.empty()) content += action_rows("/ " + note.way.actions, kNoteWidth);
        content += row("\u2192 " + markup(name_of(note.way.to)));
        return fmt::format(
            "    n{0} [shape=note, color=\"{1}\", fontcolor=\"{1}\", fontsize=10, label={2}];\n", number,
            note.way.on_error ? kErrorColour : kNoteColour, table_of(content));
    }

    std::string note_line(std::size_t number) const {
        const GraphModel::Way& way = model_.notes[number].way;
        return fmt::format("    n{} -> s{} [style=dashed, color=\"{}\"];\n", number, way.to,
                           way.on_error ? kErrorColour : kNoteColour);
    }

    /// One line per pair of steps; to an earlier step in grey.
    std::string all_lines() const {
        std::string text = "    { rank=min; s0; }\n";
        for (std::size_t i = 0; i < model_.notes.size(); ++i) text += note_line(i);
        for (const auto& [pair, on_error] : lines_of(model_)) {
            const bool back = pair.second < pair.first;
            text += fmt::format("    s{} -> s{}{};\n", pair.first, pair.second,
                                on_error ? fmt::format(R"( [style=dashed, color="{}"])", kErrorColour)
                                : back   ? R"( [color="#999999"])"
                                         : "");
        }
        return text;
    }

    const GraphModel& model_;
};

}  // namespace

std::string graph_of(std::span<const std::uint8_t> table, const Symbols* symbols, const std::string& title,
                     const GraphSource& source) {
    return Drawing(graph_model_of(table, symbols, title, source)).text();
}

}  // namespace nplc::seqc
