#include <fmt/format.h>

#include "macreg/picture.h"

namespace nplc::macreg {
namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            default:
                if (static_cast<unsigned char>(c) >= ' ') out += c;
        }
    }
    return out;
}

const char* anchor_words(Picture::Words::Anchor anchor) {
    return anchor == Picture::Words::Anchor::start    ? "start"
           : anchor == Picture::Words::Anchor::middle ? "middle"
                                                      : "end";
}

}  // namespace

std::string to_svg(const Picture& picture) {
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        picture.width, picture.height);
    for (const auto& line : picture.lines) {
        out += "<polyline points=\"";
        for (const Point& point : line.points) out += fmt::format("{:.1f},{:.1f} ", point.x, point.y);
        out.pop_back();
        out += fmt::format("\" fill=\"none\" stroke=\"#{:06x}\" stroke-width=\"{}\"/>\n", line.colour,
                           line.width);
    }
    for (const auto& words : picture.words)
        out += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"#{:06x}\" "
            "font-size=\"{}\">{}</text>\n",
            words.at.x, words.at.y, anchor_words(words.anchor), words.colour, words.size,
            escaped(words.text));
    return out + "</svg>\n";
}

}  // namespace nplc::macreg
