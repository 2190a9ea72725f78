#include "unit_set.h"

#include <algorithm>

namespace nplc::modbus {

UnitSet::~UnitSet() {
    guards_.clear();
    if (bell_ == nullptr) return;
    for (faces::AxisModel* axis : axes_) axis->ignore(*bell_);
}

void UnitSet::join(faces::Bell& bell) {
    bell_ = &bell;
    for (faces::AxisModel* axis : axes_) {
        units_.push_back(std::make_unique<Unit>(*axis, settings_, unit_of(settings_, units_.size(), first_)));
        axis->watch(bell);
        guards_.push_back(axis->join(faces::Side::plant, "Modbus: silent master", bell));
    }
}

bool UnitSet::is_fresh(base::Instant now) const {
    return std::all_of(units_.begin(), units_.end(),
                       [now](const auto& unit) { return now - unit->model.image(now).taken <= kFresh; });
}

std::optional<std::size_t> UnitSet::index_of(std::uint8_t unit) const {
    const auto found =
        std::find_if(units_.begin(), units_.end(), [unit](const auto& one) { return one->number == unit; });
    if (found == units_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - units_.begin());
}

void UnitSet::watch_masters(base::Instant now) {
    for (std::size_t i = 0; i < units_.size(); ++i) {
        if (!guards_[i]) continue;
        while (guards_[i]->take()) {
        }
        if (const auto command = units_[i]->due(now)) guards_[i]->submit(*command);
    }
}

void UnitSet::stop(std::size_t index, const faces::Command& command) {
    if (guards_[index]) guards_[index]->submit(command);
}

void UnitSet::stop_all(const faces::Command& command) {
    for (std::size_t i = 0; i < guards_.size(); ++i) stop(i, command);
}

bool UnitSet::has_master(std::uint64_t session) const {
    return std::any_of(units_.begin(), units_.end(),
                       [session](const auto& unit) { return unit->master == session; });
}

}  // namespace nplc::modbus
