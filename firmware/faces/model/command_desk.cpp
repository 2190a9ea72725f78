#include "faces/command_desk.h"

#include <algorithm>

#include "registers/gateway.h"

namespace nplc::faces {
namespace {

bool is_hold(const Command& command) {
    return command.value == static_cast<std::uint32_t>(registers::gateway::Command::hold);
}

/// Removes entries that do not satisfy `stays`, keeping the order.
template <class Waiting, std::size_t capacity, class Stays>
void sift(base::Ring<Waiting, capacity>& ring, Stays stays) {
    for (std::size_t left = ring.size(); left != 0; --left) {
        const Waiting front = ring.front();
        ring.pop();
        if (stays(front)) ring.push(front);
    }
}

}  // namespace

std::unique_ptr<CommandDesk::Client> CommandDesk::join(Side side, std::string name, Bell& bell) {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        if (!places_[i]) places_[i] = std::make_unique<Place>();
        Place& place = *places_[i];
        if (place.number != 0) continue;
        const std::uint64_t number = Seat::new_number();
        place.sitter = {.number = number,
                        .side = side,
                        .name = std::move(name),
                        .way = side == Side::person ? registers::gateway::OperatorWay::panel
                                                    : registers::gateway::OperatorWay::plant};
        place.bell = &bell;
        place.has_left = false;
        place.open = 0;
        place.waiting.clear();
        place.stops.clear();
        place.open_stops.clear();
        place.ended.clear();
        place.number = number;
        return std::unique_ptr<Client>(new Client(*this, i, number));
    }
    return nullptr;
}

CommandDesk::Client::~Client() {
    desk_.leave(place_);
}

/// Its place becomes free when the loop has noticed it.
void CommandDesk::leave(std::size_t which) {
    {
        const std::lock_guard lock(mutex_);
        Place& place = *places_[which];
        place.has_left = true;
        place.bell = nullptr;
        place.waiting.clear();
        place.open_stops.clear();
        place.ended.clear();
    }
    if (loop_ != nullptr) loop_->strike();
}

std::optional<std::uint32_t> CommandDesk::Client::submit(const Command& command) {
    std::uint32_t id = 0;
    {
        const std::lock_guard lock(desk_.mutex_);
        Place& place = *desk_.places_[place_];
        if (command.is_stop()) {
            desk_.drop_waiting(place, true);
            sift(place.stops, [&](const Waiting& waiting) {
                if (waiting.command.value == command.value) id = waiting.id;
                return true;
            });
            if (id == 0) place.stops.push({id = ++place.last_id, command});
            open_stop(place, id);
        } else {
            if (place.open >= kMostWaiting) return std::nullopt;
            ++place.open;
            place.waiting.push({id = ++place.last_id, command});
        }
    }
    if (desk_.loop_ != nullptr) desk_.loop_->strike();
    return id;
}

std::optional<Completion> CommandDesk::Client::take(base::Instant now) {
    {
        const std::lock_guard lock(desk_.mutex_);
        answer_stops(*desk_.places_[place_], now);
    }
    return take();
}

std::optional<Completion> CommandDesk::Client::take() {
    const std::lock_guard lock(desk_.mutex_);
    Place& place = *desk_.places_[place_];
    if (place.ended.empty()) return std::nullopt;
    const Completion completion = place.ended.front();
    place.ended.pop();
    return completion;
}

/// If there are too many, the oldest is dropped: its outcome is then reported by the loop only.
void CommandDesk::open_stop(Place& place, std::uint32_t id) {
    bool is_open = false;
    sift(place.open_stops, [&](const OpenStop& stop) {
        is_open = is_open || stop.id == id;
        return true;
    });
    if (is_open) return;
    if (place.open_stops.full()) place.open_stops.pop();
    place.open_stops.push({.id = id});
}

void CommandDesk::answer_stops(Place& place, base::Instant now) {
    for (std::size_t left = place.open_stops.size(); left != 0; --left) {
        OpenStop stop = place.open_stops.front();
        place.open_stops.pop();
        if (!stop.seen || now - stop.looked > kHalted) stop.seen = now;
        stop.looked = now;
        if (now - *stop.seen < (stop.is_read ? kUnended : kUnread))
            place.open_stops.push(stop);
        else
            complete(place, {.id = stop.id, .result = Result::stop_unconfirmed, .is_axis_silent = true});
    }
}

/// Reads are kept, unless `all`.
void CommandDesk::drop_waiting(Place& place, bool all) {
    sift(place.waiting, [&](const Waiting& waiting) {
        if (!all && !waiting.command.operates()) return true;
        complete(place, {.id = waiting.id, .result = Result::too_late});
        --place.open;
        return false;
    });
}

/// If a client does not take completions, the oldest ones are lost.
void CommandDesk::complete(Place& place, const Completion& completion) {
    if (place.ended.full()) place.ended.pop();
    place.ended.push(completion);
}

bool CommandDesk::take_stop(std::optional<Work>& work) {
    for (const bool hold : {false, true}) {
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (!places_[i] || places_[i]->number == 0) continue;
            Place& place = *places_[i];
            sift(place.stops, [&](const Waiting& waiting) {
                if (work || is_hold(waiting.command) != hold) return true;
                work = Work{i, place.sitter, waiting.command, waiting.id};
                return false;
            });
            if (!work) continue;
            for (std::size_t left = place.open_stops.size(); left != 0; --left) {
                OpenStop stop = place.open_stops.front();
                place.open_stops.pop();
                stop.is_read = stop.is_read || stop.id == work->id;
                place.open_stops.push(stop);
            }
            return true;
        }
    }
    return false;
}

bool CommandDesk::take(std::optional<Work>& work, bool stops_only) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    if (take_stop(work) || stops_only) return true;
    for (std::size_t i = 1; i <= places_.size() && !work; ++i) {
        const std::size_t number = (last_ + i) % places_.size();
        if (!places_[number] || places_[number]->waiting.empty()) continue;
        Place& place = *places_[number];
        work = Work{number, place.sitter, place.waiting.front().command, place.waiting.front().id};
        place.waiting.pop();
        last_ = number;
    }
    return true;
}

bool CommandDesk::end(const Work& work, const Completion& completion) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    Place& place = *places_[work.place];
    if (place.number != work.client.number || place.has_left) return true;
    complete(place, completion);
    sift(place.open_stops, [&](const OpenStop& stop) { return stop.id != work.id; });
    if (!work.command.is_stop()) --place.open;
    place.bell->strike();
    return true;
}

bool CommandDesk::drop_all_that_operates() {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    for (const auto& place : places_) {
        if (!place || place->has_left || place->waiting.empty()) continue;
        drop_waiting(*place, false);
        place->bell->strike();
    }
    return true;
}

bool CommandDesk::take_leavers(base::Ring<std::uint64_t, kMostClients>& leavers) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    for (const auto& place : places_) {
        if (!place || place->number == 0 || !place->has_left || !place->stops.empty()) continue;
        leavers.push(place->number);
        place->number = 0;
    }
    return true;
}

}  // namespace nplc::faces
