#include "report/graph/graph_routes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "report/graph/graph_tracks.h"

namespace nplc::seqc {
namespace {

using Side = Tracks::Side;

constexpr double kAbove = -40;      // above the first cards, before the height of the lines there is known
constexpr double kBusApart = 7;     // from line to line above the cards
constexpr double kBusToCards = 12;  // from the lowest of them to the cards
constexpr double kSideways = 12;    // horizontal distance of a line up from one down
constexpr double kLevelsApart = 3;  // distance of two lines that would overlap

struct Place {
    std::size_t column = 0;
    std::size_t row = 0;
};

/// The horizontal part of a line from a box to its track.
struct LineEnd {
    std::size_t channel = 0;
    std::uint8_t target = 0;
    Side box_on = Side::left;
    double y = 0;
};

enum class Shape : std::uint8_t { none, down, up, beside, far };

struct Route {
    Place from;
    Place to;
    std::uint8_t target = 0;
    std::optional<std::size_t> way;
    Picture::LineKind kind = Picture::LineKind::forward;
    Shape shape = Shape::none;
    std::size_t begin = 0;  ///< index in the line ends
    std::size_t end = 0;
};

class Router {
  public:
    Router(CardColumns& columns, const GraphModel& model, LinesDrawn drawn)
        : columns_(columns), drawn_(drawn) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            for (std::size_t r = 0; r < columns[c].size(); ++r) {
                const Picture::Box& box = columns[c][r].box;
                if (box.kind != Picture::BoxKind::note) places_[box.step] = {c, r};
            }
        }
        for (const GraphModel::Box& box : model.boxes) add_ways(box);
        add_notes();
    }

    Routes run() {
        plan();
        tracks_.assign(columns_.size() + 1);
        set_across();
        keep_apart();
        for (auto& column : columns_) {
            for (Card& card : column) card.box.y += bus_room_;
        }
        Routes result{.lines = {}, .width = width_, .height = 0};
        for (const Route& route : routes_) result.lines.push_back(line(route));
        for (const auto& column : columns_) {
            const Picture::Box& last = column.back().box;
            result.height = std::max(result.height, last.y + last.height);
        }
        return result;
    }

  private:
    void add_ways(const GraphModel::Box& box) {
        for (std::size_t i = 0; i < box.ways.size(); ++i) {
            const GraphModel::Way& way = box.ways[i];
            const std::uint8_t target = way.by.value_or(way.to);
            if (way.to == box.step || !places_.contains(target)) continue;
            const Place from = places_.at(box.step);
            const Place to = places_.at(target);
            const bool is_back = std::tie(to.column, to.row) < std::tie(from.column, from.row);
            routes_.push_back({.from = from,
                               .to = to,
                               .target = target,
                               .way = i,
                               .kind = way.on_error ? Picture::LineKind::error
                                       : is_back    ? Picture::LineKind::back
                                                    : Picture::LineKind::forward});
        }
    }

    void add_notes() {
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            for (std::size_t r = 0; r < columns_[c].size(); ++r) {
                const Picture::Box& box = columns_[c][r].box;
                if (box.kind != Picture::BoxKind::note) continue;
                routes_.push_back(
                    {.from = {c, r},
                     .to = {c, r + 1},
                     .target = box.step,
                     .way = std::nullopt,
                     .kind = box.on_error ? Picture::LineKind::error : Picture::LineKind::note});
            }
        }
    }

    Shape shape_of(const Route& route) const {
        if (route.from.column == route.to.column) {
            if (route.to.row == route.from.row + 1) return Shape::down;
            if (route.to.row + 1 == route.from.row) return Shape::up;
        }
        if (drawn_ == LinesDrawn::neighbours) return Shape::none;
        const std::size_t column = route.from.column;
        if (route.to.column <= column + 1 && column <= route.to.column + 1) return Shape::beside;
        return drawn_ == LinesDrawn::all ? Shape::far : Shape::none;
    }

    /// Chooses the channels, and thereby the lines in each.
    void plan() {
        for (Route& route : routes_) {
            route.shape = shape_of(route);
            const std::size_t from = route.from.column;
            const std::size_t to = route.to.column;
            if (route.shape == Shape::beside) {
                const bool to_left = to < from || (to == from && route.kind == Picture::LineKind::back);
                const std::size_t channel = to_left ? from : from + 1;
                route.begin = begin_line(route, channel, to_left ? Side::right : Side::left);
                route.end = end_line(route, channel, to == channel ? Side::right : Side::left);
                join(route, line_ends_[route.begin].y, line_ends_[route.end].y);
            } else if (route.shape == Shape::far) {
                route.begin = begin_line(route, from + 1, Side::left);
                route.end = end_line(route, to, Side::right);
                join(route, kAbove, kAbove);
                auto& [low, high] = buses_.try_emplace(route.target, std::minmax(from + 1, to)).first->second;
                low = std::min({low, from + 1, to});
                high = std::max({high, from + 1, to});
            }
        }
        place_buses();
    }

    void join(const Route& route, double begin_to, double end_to) {
        for (const auto& [at, other] : {std::pair{route.begin, end_to}, {route.end, begin_to}}) {
            const LineEnd& line_end = line_ends_[at];
            tracks_.add(line_end.channel, line_end.target, line_end.y, other, line_end.box_on);
        }
    }

    std::size_t begin_line(const Route& route, std::size_t channel, Side box_on) {
        const Card& card = columns_[route.from.column][route.from.row];
        line_ends_.push_back({channel, route.target, box_on, card.box.y + card.way_heights[*route.way]});
        return line_ends_.size() - 1;
    }

    /// One end for all lines that arrive at a step from that side.
    std::size_t end_line(const Route& route, std::size_t channel, Side box_on) {
        const auto [at, is_new] = ends_.try_emplace({channel, route.target, box_on}, line_ends_.size());
        if (is_new) {
            const Card& card = columns_[route.to.column][route.to.row];
            line_ends_.push_back({channel, route.target, box_on, card.box.y + card.entry_height});
        }
        return at->second;
    }

    /// Lines above the cards, the shortest lowest.
    void place_buses() {
        std::vector<std::pair<std::uint8_t, std::pair<std::size_t, std::size_t>>> all(buses_.begin(),
                                                                                      buses_.end());
        std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return a.second.second - a.second.first < b.second.second - b.second.first;
        });
        std::map<std::uint8_t, std::size_t> levels;
        std::size_t count = 0;
        for (const auto& [target, reach] : all) {
            const auto is_taken = [&, &wanted = reach](std::size_t level) {
                return std::any_of(levels.begin(), levels.end(), [&](const auto& other) {
                    const auto& [low, high] = buses_.at(other.first);
                    return other.second == level && low <= wanted.second && wanted.first <= high;
                });
            };
            std::size_t level = 0;
            while (is_taken(level)) ++level;
            levels[target] = level;
            count = std::max(count, level + 1);
        }
        if (count > 0) bus_room_ = kBusToCards + static_cast<double>(count) * kBusApart;
        for (const auto& [target, level] : levels)
            bus_heights_[target] = bus_room_ - kBusToCards - static_cast<double>(level) * kBusApart;
    }

    void set_across() {
        double x = 0;
        for (std::size_t c = 0; c <= columns_.size(); ++c) {
            channels_.push_back(x);
            x += tracks_.width(c);
            if (c == columns_.size()) break;
            double width = 0;
            for (const Card& card : columns_[c]) width = std::max(width, card.box.width);
            for (Card& card : columns_[c]) card.box.x = x + (width - card.box.width) / 2;
            x += width;
        }
        width_ = x;
    }

    /// Separates two lines that arrive from both sides at the same height.
    void keep_apart() {
        for (LineEnd& right : line_ends_) {
            if (right.box_on != Side::right) continue;
            for (const LineEnd& left : line_ends_) {
                if (left.box_on != Side::left || left.channel != right.channel || left.target == right.target)
                    continue;
                const bool pass =
                    tracks_.x(left.channel, left.target) > tracks_.x(right.channel, right.target);
                if (!pass || std::abs(left.y - right.y) >= kLevelsApart) continue;
                right.y = right.y >= left.y ? left.y + kLevelsApart : left.y - kLevelsApart;
            }
        }
    }

    double track_of(const LineEnd& line_end) const {
        return channels_[line_end.channel] + tracks_.x(line_end.channel, line_end.target);
    }

    static double beside(const Picture::Box& box, Side box_on) {
        return box_on == Side::left ? box.x + box.width : box.x;
    }

    Picture::Line line(const Route& route) const {
        const Picture::Box& from = columns_[route.from.column][route.from.row].box;
        const Picture::Box& to = columns_[route.to.column][route.to.row].box;
        Picture::Line line{.from = from.id, .to = to.id, .way = route.way, .kind = route.kind, .points = {}};
        if (route.shape == Shape::down || route.shape == Shape::up) {
            const bool is_down = route.shape == Shape::down;
            const double x = from.x + from.width / 2 + (is_down ? 0 : kSideways);
            line.points = {{x, is_down ? from.y + from.height : from.y},
                           {x, is_down ? to.y : to.y + to.height}};
        } else if (route.shape != Shape::none) {
            const LineEnd& begin = line_ends_[route.begin];
            const LineEnd& end = line_ends_[route.end];
            const double first = begin.y + bus_room_;
            const double last = end.y + bus_room_;
            line.points = {{beside(from, begin.box_on), first}, {track_of(begin), first}};
            if (route.shape == Shape::far) {
                const double bus = bus_heights_.at(route.target);
                line.points.insert(line.points.end(), {{track_of(begin), bus}, {track_of(end), bus}});
            }
            line.points.insert(line.points.end(), {{track_of(end), last}, {beside(to, end.box_on), last}});
        }
        return line;
    }

    CardColumns& columns_;
    LinesDrawn drawn_;
    std::map<std::uint8_t, Place> places_;
    std::vector<Route> routes_;
    std::vector<LineEnd> line_ends_;
    std::map<std::tuple<std::size_t, std::uint8_t, Side>, std::size_t> ends_;
    std::map<std::uint8_t, std::pair<std::size_t, std::size_t>> buses_;  ///< first and last channel
    std::map<std::uint8_t, double> bus_heights_;
    double bus_room_ = 0;
    Tracks tracks_;
    std::vector<double> channels_;  ///< left edges
    double width_ = 0;
};

}  // namespace

Routes route(CardColumns& columns, const GraphModel& model, LinesDrawn drawn) {
    return Router(columns, model, drawn).run();
}

}  // namespace nplc::seqc
