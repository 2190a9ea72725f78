#include "faces/drop_watch.h"

#include <utility>

#include "gateway/controller.h"

namespace nplc::faces {

void DropWatch::look(gateway::Controller& controller) {
    if (controller.set_points().edition() != edition_) static_cast<void>(exchanged(controller));
}

std::vector<set_points::Dropped> DropWatch::exchanged(gateway::Controller& controller) {
    SetPointBook book = book_of(controller);
    std::vector<set_points::Dropped> dropped =
        set_points::dropped_by({record_, wanted_, recipes_}, book.record);
    edition_ = book.edition;
    record_ = std::move(book.record);
    recipes_ = std::move(book.recipes);
    wanted_.clear();
    for (std::size_t i = 0; i < record_.values.size(); ++i) {
        const auto reg = static_cast<std::uint8_t>(registers::gateway::SET_POINT_WANTED + i);
        wanted_.push_back(static_cast<std::int32_t>(controller.set_points().value(reg)));
    }
    return dropped;
}

}  // namespace nplc::faces
