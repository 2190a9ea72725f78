#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace nplc::seqc {

/// Where lines between two columns run up and down: what leads to one step shares a track.
class Tracks {
  public:
    enum class Side : std::uint8_t { left, right };

    /// A line to `target` between boxes on a side of channel `channel` passes these heights.
    void add(std::size_t channel, std::uint8_t target, double from, double to, Side box_on);

    /// Gives each its place, as few beside each other as do not touch. Channels are numbered from the left.
    void assign(std::size_t channels);

    double width(std::size_t channel) const { return widths_[channel]; }
    /// From the channel's left.
    double x(std::size_t channel, std::uint8_t target) const;

  private:
    struct Track {
        double top = 0;
        double bottom = 0;
        int left = 0;  ///< boxes on the left of it, less those on the right
        Side side = Side::left;
        std::size_t place = 0;  ///< from that side
    };
    using Key = std::pair<std::size_t, std::uint8_t>;

    std::size_t place_all(std::size_t channel, Side side);

    std::map<Key, Track> tracks_;
    std::vector<double> widths_;
};

}  // namespace nplc::seqc
