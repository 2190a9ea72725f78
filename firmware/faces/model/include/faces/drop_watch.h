#pragma once

#include <cstdint>
#include <vector>

#include "faces/set_point_book.h"
#include "set_points/dropped.h"

namespace nplc::faces {

/// Keeps an axis's values and recipes, to report by name which of them another table did not accept: the
/// gateway's log has no names. For the axis's loop.
class DropWatch {
  public:
    /// To be called after every poll; it reads them only where something was stored or a table was exchanged.
    void look(gateway::Controller& controller);
    /// In the place of look() once another table is active: what was dropped.
    std::vector<set_points::Dropped> exchanged(gateway::Controller& controller);
    /// There is a new controller.
    void restart() { *this = {}; }

  private:
    std::uint32_t edition_ = 0;
    set_points::Record record_;
    std::vector<set_points::Recipe> recipes_;
    std::vector<std::int32_t> wanted_;
};

}  // namespace nplc::faces
