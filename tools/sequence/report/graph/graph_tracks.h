#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace nplc::seqc {

/// Positions of vertical lines between two columns: lines to one step share a track.
class Tracks {
  public:
    enum class Side : std::uint8_t { left, right };

    /// A line to `target`, from boxes on one side of channel `channel`, spans these heights.
    void add(std::size_t channel, std::uint8_t target, double from, double to, Side box_on);

    /// Assigns positions, with as few parallel tracks as possible. Channels are numbered from the left.
    void assign(std::size_t channels);

    double width(std::size_t channel) const { return widths_[channel]; }
    /// Relative to the channel's left edge.
    double x(std::size_t channel, std::uint8_t target) const;

  private:
    struct Track {
        double top = 0;
        double bottom = 0;
        int left = 0;  ///< boxes on its left minus those on its right
        Side side = Side::left;
        std::size_t place = 0;  ///< position, from that side
    };
    using Key = std::pair<std::size_t, std::uint8_t>;

    std::size_t place_all(std::size_t channel, Side side);

    std::map<Key, Track> tracks_;
    std::vector<double> widths_;
};

}  // namespace nplc::seqc
