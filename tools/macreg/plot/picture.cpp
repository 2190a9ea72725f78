#include "macreg/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_easy_font.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

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

constexpr int kFiner = 3;
constexpr double kFontLine = 8.5;  // of the library's letters, in its own steps: as high as a line of size 1
constexpr std::size_t kChannels = 3;

/// The picture drawn three times as large and scaled down (anti-aliasing).
class Canvas {
  public:
    explicit Canvas(const Picture& picture)
        : width_(picture.width * kFiner),
          height_(picture.height * kFiner),
          pixels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0xFFFFFF) {
        for (const auto& line : picture.lines) {
            for (std::size_t i = 1; i < line.points.size(); ++i)
                stroke(line.points[i - 1], line.points[i], line.width * kFiner / 2, line.colour);
        }
        for (const auto& words : picture.words) write(words);
    }

    std::vector<std::uint8_t> small() const {
        std::vector<std::uint8_t> out;
        for (int y = 0; y < height_; y += kFiner) {
            for (int x = 0; x < width_; x += kFiner) {
                for (const int shift : {16, 8, 0}) {
                    unsigned sum = 0;
                    for (int i = 0; i < kFiner * kFiner; ++i)
                        sum += (at(x + i % kFiner, y + i / kFiner) >> shift) & 0xFF;
                    out.push_back(static_cast<std::uint8_t>(sum / (kFiner * kFiner)));
                }
            }
        }
        return out;
    }

  private:
    Colour at(int x, int y) const {
        return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x)];
    }
    void dot(int x, int y, Colour colour) {
        if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
        pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(x)] = colour;
    }

    /// All points within `radius` of the line segment.
    void stroke(Point from, Point to, double radius, Colour colour) {
        from = {from.x * kFiner, from.y * kFiner};
        to = {to.x * kFiner, to.y * kFiner};
        const double dx = to.x - from.x;
        const double dy = to.y - from.y;
        const double length2 = std::max(dx * dx + dy * dy, 1e-9);
        const auto low = [&](double a, double b) {
            return static_cast<int>(std::floor(std::min(a, b) - radius));
        };
        const auto high = [&](double a, double b) {
            return static_cast<int>(std::ceil(std::max(a, b) + radius));
        };
        for (int y = std::max(0, low(from.y, to.y)); y <= std::min(height_ - 1, high(from.y, to.y)); ++y) {
            for (int x = std::max(0, low(from.x, to.x)); x <= std::min(width_ - 1, high(from.x, to.x)); ++x) {
                const double px = x + 0.5 - from.x;
                const double py = y + 0.5 - from.y;
                const double along = std::clamp((px * dx + py * dy) / length2, 0.0, 1.0);
                const double ex = px - along * dx;
                const double ey = py - along * dy;
                if (ex * ex + ey * ey <= radius * radius) dot(x, y, colour);
            }
        }
    }

    void write(const Picture::Words& words) {
        constexpr std::size_t kBytesALetter = 1200;
        constexpr std::size_t kQuad = std::size_t{4} * 16;
        std::string text = words.text;
        for (char& c : text) {
            if (c < ' ' || c > '~') c = '?';
        }
        std::vector<char> quads(text.size() * kBytesALetter + kQuad);
        const int count =
            stb_easy_font_print(0, 0, text.data(), nullptr, quads.data(), static_cast<int>(quads.size()));
        const double scale = words.size / kFontLine * kFiner;
        const double width = stb_easy_font_width(text.data()) * scale;
        const double share = words.anchor == Picture::Words::Anchor::start    ? 0
                             : words.anchor == Picture::Words::Anchor::middle ? 0.5
                                                                              : 1;
        const double left = words.at.x * kFiner - share * width;
        const double top = words.at.y * kFiner - 7 * scale;  // the library's baseline
        for (int i = 0; i < count; ++i) {
            std::array<float, 2> from{};
            std::array<float, 2> to{};
            const char* quad = quads.data() + static_cast<std::size_t>(i) * kQuad;
            std::memcpy(from.data(), quad, sizeof from);
            std::memcpy(to.data(), quad + kQuad / 2, sizeof to);
            const auto x = [&](float value) { return left + static_cast<double>(value) * scale; };
            const auto y = [&](float value) { return top + static_cast<double>(value) * scale; };
            fill(x(from[0]), y(from[1]), x(to[0]), y(to[1]), words.colour);
        }
    }

    void fill(double left, double top, double right, double bottom, Colour colour) {
        for (int y = static_cast<int>(std::lround(top)); y < static_cast<int>(std::lround(bottom)); ++y) {
            for (int x = static_cast<int>(std::lround(left)); x < static_cast<int>(std::lround(right)); ++x)
                dot(x, y, colour);
        }
    }

    int width_;
    int height_;
    std::vector<Colour> pixels_;
};

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

std::string to_png(const Picture& picture) {
    const std::vector<std::uint8_t> pixels = Canvas(picture).small();
    std::string out;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    stbi_write_png_to_func(append, &out, picture.width, picture.height, kChannels, pixels.data(),
                           picture.width * static_cast<int>(kChannels));
    return out;
}

}  // namespace nplc::macreg
