#include "views/graph.h"

#include <fmt/format.h>

#include "views/dot_text.h"
#include "views/graph_model.h"

namespace nplc::seqc {
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
