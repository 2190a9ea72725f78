#include "report/graph/graph_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/graph/graph_text.h"

namespace nplc::seqc {
namespace {

constexpr double kCorner = 4;

std::string attributes(const Picture::Text& text) {
    const TextStyle style = style_of(text.kind);
    using Anchor = Picture::Anchor;
    std::string result = fmt::format(R"(x="{:.1f}" y="{:.1f}" font-size="{:g}")", text.x, text.y, style.size);
    if (text.anchor != Anchor::start)
        result += fmt::format(R"( text-anchor="{}")", text.anchor == Anchor::end ? "end" : "middle");
    if (style.bold) result += R"( font-weight="bold")";
    if (style.italic) result += R"( font-style="italic")";
    return result;
}

std::string element(const Picture::Text& text, std::string_view colour) {
    return fmt::format("<text class=\"{}\" {} fill=\"{}\">{}</text>\n", style_of(text.kind).name,
                       attributes(text), colour, markup(text.text));
}

std::string outline(const Picture::Box& box) {
    using Kind = Picture::BoxKind;
    const double right = box.x + box.width;
    if (box.kind == Kind::note) {
        return fmt::format(
            "<path d=\"M{:.1f},{:.1f} H{:.1f} L{:.1f},{:.1f} V{:.1f} H{:.1f} Z\" fill=\"{}\" "
            "stroke=\"{}\"/>\n",
            box.x, box.y, right - kNoteFold, right, box.y + kNoteFold, box.y + box.height, box.x,
            fill_of(box), colour_of(box));
    }
    const auto rectangle = [&](double inset, std::string_view more) {
        return fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" stroke="{}"{}/>)"
                           "\n",
                           box.x + inset, box.y + inset, box.width - 2 * inset, box.height - 2 * inset,
                           colour_of(box), more);
    };
    if (box.kind != Kind::step)
        return rectangle(0, R"( rx="8" stroke-dasharray="4 2" fill=")" + std::string(fill_of(box)) + '"');
    const std::string fill = fmt::format(R"( fill="{}")", fill_of(box));
    if (inset_of(box) == 0) return rectangle(0, fill);
    return rectangle(0, fill) + rectangle(kInnerFrame, R"( fill="none")");
}

std::string node(const Picture::Box& box) {
    const double inset = inset_of(box);
    std::string text =
        fmt::format("<g id=\"{}\" class=\"node {}\">\n{}", box.id, name_of(box.kind), outline(box));
    for (const double y : box.rules) {
        text += fmt::format(
            "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
            "stroke-width=\"0.5\"/>\n",
            box.x + inset, box.x + box.width - inset, y, y, colour_of(box));
    }
    for (const Picture::Text& part : box.texts) text += element(part, colour_of(box, part));
    return text + "</g>\n";
}

/// A point up to a corner's length from `at` towards `to`.
Picture::Point towards(Picture::Point at, Picture::Point to) {
    const double length = std::hypot(to.first - at.first, to.second - at.second);
    const double share = length == 0 ? 0 : std::min(kCorner, length / 2) / length;
    return {at.first + (to.first - at.first) * share, at.second + (to.second - at.second) * share};
}

std::string path_of(const std::vector<Picture::Point>& points) {
    std::string path = fmt::format("M{:.1f},{:.1f}", points.front().first, points.front().second);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const auto [bx, by] = towards(points[i], points[i - 1]);
        const auto [ex, ey] = towards(points[i], points[i + 1]);
        path += fmt::format(" L{:.1f},{:.1f} Q{:.1f},{:.1f} {:.1f},{:.1f}", bx, by, points[i].first,
                            points[i].second, ex, ey);
    }
    return path + fmt::format(" L{:.1f},{:.1f}", points.back().first, points.back().second);
}

std::string edge(const Picture::Line& line) {
    using Kind = Picture::LineKind;
    const bool is_dashed = line.kind == Kind::error || line.kind == Kind::note;
    return fmt::format(
        "<path class=\"edge {0}\" data-from=\"{1}\" data-to=\"{2}\"{3} d=\"{4}\" fill=\"none\" "
        "stroke=\"{5}\"{6} "
        "marker-end=\"url(#{0})\"/>\n",
        name_of(line.kind), line.from, line.to, line.way ? fmt::format(R"( data-way="{}")", *line.way) : "",
        path_of(line.points), colour_of(line.kind), is_dashed ? R"( stroke-dasharray="4 2")" : "");
}

std::string arrows() {
    using Kind = Picture::LineKind;
    std::string text = "<defs>\n";
    for (const Kind kind : {Kind::forward, Kind::back, Kind::error, Kind::note}) {
        text += fmt::format(
            "<marker id=\"{}\" viewBox=\"0 0 8 6\" refX=\"8\" refY=\"3\" markerWidth=\"8\" "
            "markerHeight=\"6\" "
            "markerUnits=\"userSpaceOnUse\" orient=\"auto\"><path d=\"M0,0 L8,3 L0,6 Z\" "
            "fill=\"{}\"/></marker>\n",
            name_of(kind), colour_of(kind));
    }
    return text + "</defs>\n";
}

}  // namespace

std::string svg_of(const Picture& picture, const std::string& title) {
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.1f}pt\" height=\"{:.1f}pt\" viewBox=\"0 0 "
        "{:.1f} "
        "{:.1f}\" font-family=\"Helvetica, Arial, sans-serif\">\n<title>{}</title>\n{}"
        "<rect class=\"page\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        picture.width * picture.scale, picture.height * picture.scale, picture.width, picture.height,
        markup(title), arrows());
    for (const Picture::Text& part : picture.texts) text += element(part, style_of(part.kind).colour);
    for (const Picture::Line& line : picture.lines) {
        if (!line.points.empty()) text += edge(line);
    }
    for (const Picture::Box& box : picture.boxes) text += node(box);
    return text + "</svg>\n";
}

}  // namespace nplc::seqc
