#include "report/graph/graph_print.h"

#include <fmt/format.h>

#include "report/graph/graph_text.h"

namespace nplc::seqc {
namespace {

constexpr double kInch = 72;
constexpr double kTextHeight = 1.2;  // line height, times the size
constexpr double kBelowFoot = 0.3;   // descent, times the size

class Print {
  public:
    explicit Print(const Picture& picture) : picture_(picture) {}

    std::string text() {
        text_ = fmt::format(
            "digraph {{\n  graph [pad=0, margin=0, splines=true, outputorder=nodesfirst, "
            "size=\"{:.3f},{:.3f}\"];\n"
            "  node [fontname=\"Helvetica\", shape=box, fixedsize=true, margin=0, label=\"\"];\n"
            "  edge [arrowsize=0.6, penwidth=0.8];\n",
            picture_.width * picture_.scale / kInch, picture_.height * picture_.scale / kInch);
        node(picture_.width / 2, picture_.height / 2, picture_.width, picture_.height,
             R"(style=filled, fillcolor="#ffffff", color="#ffffff")");
        node(0, picture_.height, 0, 0, "style=invis");  // anchors of lines
        anchor_ = count_ - 1;
        for (const Picture::Box& box : picture_.boxes) outline(box);
        for (const Picture::Text& part : picture_.texts) label(part, style_of(part.kind).colour);
        for (const Picture::Box& box : picture_.boxes) texts(box);
        for (const Picture::Line& line : picture_.lines) {
            if (!line.points.empty()) edge(line);
        }
        return text_ + "}\n";
    }

  private:
    double up(double y) const { return picture_.height - y; }

    void node(double x, double y, double width, double height, const std::string& more) {
        text_ += fmt::format("  {} [pos=\"{:.2f},{:.2f}\", width={:.4f}, height={:.4f}, {}];\n", count_++, x,
                             up(y), width / kInch, height / kInch, more);
    }

    void outline(const Picture::Box& box) {
        using Kind = Picture::BoxKind;
        const std::string_view more = box.kind == Kind::note   ? "shape=note, style=filled"
                                      : box.kind != Kind::step ? R"(style="filled,rounded,dashed")"
                                                               : "style=filled";
        node(box.x + box.width / 2, box.y + box.height / 2, box.width, box.height,
             fmt::format(R"(color="{}", fillcolor="{}", {})", colour_of(box), fill_of(box), more));
        if (inset_of(box) == 0) return;
        node(box.x + box.width / 2, box.y + box.height / 2, box.width - 2 * kInnerFrame,
             box.height - 2 * kInnerFrame, fmt::format(R"(color="{}")", colour_of(box)));
    }

    void texts(const Picture::Box& box) {
        for (const double y : box.rules)
            path({{box.x + inset_of(box), y}, {box.x + box.width - inset_of(box), y}},
                 fmt::format(R"(arrowhead=none, penwidth=0.5, color="{}")", colour_of(box)));
        for (const Picture::Text& part : box.texts) label(part, colour_of(box, part));
    }

    /// `\l` and `\r` align a label within its node.
    void label(const Picture::Text& part, std::string_view colour) {
        using Anchor = Picture::Anchor;
        const TextStyle style = style_of(part.kind);
        const double x = part.anchor == Anchor::start    ? part.x + part.width / 2
                         : part.anchor == Anchor::middle ? part.x
                                                         : part.x - part.width / 2;
        const double height = style.size * kTextHeight;
        std::string words = seqc::quoted(part.text);
        words.insert(words.size() - 1, part.anchor == Anchor::start    ? "\\l"
                                       : part.anchor == Anchor::middle ? "\\n"
                                                                       : "\\r");
        const std::string_view font = style.bold     ? "Helvetica-Bold"
                                      : style.italic ? "Helvetica-Oblique"
                                                     : "Helvetica";
        node(x, part.y + style.size * kBelowFoot - height / 2, part.width, height,
             fmt::format(R"(shape=plaintext, fontname="{}", fontsize={:g}, fontcolor="{}", label={})", font,
                         style.size, colour, words));
    }

    void edge(const Picture::Line& line) {
        using Kind = Picture::LineKind;
        const bool is_dashed = line.kind == Kind::error || line.kind == Kind::note;
        path(line.points,
             fmt::format(R"(color="{}"{})", colour_of(line.kind), is_dashed ? ", style=dashed" : ""), true);
    }

    /// Straight segments as cubic curves; an arrow replaces the end of the last one.
    void path(std::vector<Picture::Point> points, const std::string& more, bool has_arrow = false) {
        constexpr double kArrow = 6;
        std::string pos;
        if (has_arrow) {
            auto& [x, y] = points.back();
            const auto& [fx, fy] = points[points.size() - 2];
            pos = fmt::format("e,{:.2f},{:.2f} ", x, up(y));
            x += x > fx ? -kArrow : x < fx ? kArrow : 0;
            y += y > fy ? -kArrow : y < fy ? kArrow : 0;
        }
        const auto place = [&](const Picture::Point& point) {
            return fmt::format("{:.2f},{:.2f}", point.first, up(point.second));
        };
        pos += place(points.front());
        for (std::size_t i = 1; i < points.size(); ++i)
            pos += fmt::format(" {} {} {}", place(points[i - 1]), place(points[i]), place(points[i]));
        text_ += fmt::format("  {0} -> {0} [pos=\"{1}\", {2}];\n", anchor_, pos, more);
    }

    const Picture& picture_;
    std::string text_;
    std::size_t count_ = 0;
    std::size_t anchor_ = 0;
};

}  // namespace

std::string print_of(const Picture& picture) {
    return Print(picture).text();
}

}  // namespace nplc::seqc
