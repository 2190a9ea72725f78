#include "report/graph/graph_tracks.h"

#include <algorithm>
#include <tuple>

namespace nplc::seqc {
namespace {

constexpr double kApart = 7;     // from track to track
constexpr double kToBoxes = 10;  // from a track to the boxes, including an arrow
constexpr double kClear = 10;    // between two lines on one track
constexpr double kEmpty = 18;    // between columns without a track

}  // namespace

void Tracks::add(std::size_t channel, std::uint8_t target, double from, double to, Side box_on) {
    const auto [at, is_new] = tracks_.try_emplace(Key{channel, target});
    Track& track = at->second;
    const auto [low, high] = std::minmax(from, to);
    track.top = is_new ? low : std::min(track.top, low);
    track.bottom = is_new ? high : std::max(track.bottom, high);
    track.left += box_on == Side::left ? 1 : -1;
}

std::size_t Tracks::place_all(std::size_t channel, Side side) {
    std::vector<Track*> all;
    for (auto& [key, track] : tracks_) {
        if (key.first == channel && track.side == side) all.push_back(&track);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Track* a, const Track* b) { return a->bottom - a->top < b->bottom - b->top; });
    std::size_t places = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        Track& track = *all[i];
        const auto is_taken = [&](std::size_t place) {
            return std::any_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(i),
                               [&](const Track* t) {
                                   return t->place == place && t->top < track.bottom + kClear &&
                                          track.top < t->bottom + kClear;
                               });
        };
        while (is_taken(track.place)) ++track.place;
        places = std::max(places, track.place + 1);
    }
    return places;
}

void Tracks::assign(std::size_t channels) {
    for (auto& [key, track] : tracks_) track.side = track.left > 0 ? Side::left : Side::right;
    for (std::size_t channel = 0; channel < channels; ++channel) {
        const std::size_t places = place_all(channel, Side::left) + place_all(channel, Side::right);
        const bool is_outside = channel == 0 || channel + 1 == channels;
        widths_.push_back(places > 0   ? 2 * kToBoxes + static_cast<double>(places - 1) * kApart
                          : is_outside ? 0
                                       : kEmpty);
    }
}

double Tracks::x(std::size_t channel, std::uint8_t target) const {
    const Track& track = tracks_.at({channel, target});
    const double from_side = kToBoxes + static_cast<double>(track.place) * kApart;
    return track.side == Side::left ? from_side : widths_[channel] - from_side;
}

}  // namespace nplc::seqc
