#include "explorer.h"

#include <bit>

namespace nplc::verify {

Explorer::Explorer(const Machine& machine, const Precision& precision)
    : scans_(machine, precision),
      states_({.zones = scans_.uses_zones(),
               .deadline = precision.deadline != nullptr,
               .motion = machine.tells_motion(),
               .greatest_counter = machine.greatest_counter()}) {}

void Explorer::explore(const std::vector<Target>& targets) {
    const std::size_t groups = machine().all_groups().size();
    hits_.begin(targets, groups);
    first_uses_.assign(groups, kNone);
    states_.reserve();
    if (precision().keeps_edges) edges_.reserve();
    add({}, {}, {});
    if (precision().guide != nullptr) return explore_guided();
    for (Node node = 0; node < states_.size(); ++node) {
        edges_.begin_node();
        if (scans_.uses_zones()) {
            visit(node);
        } else {
            visit_plain(node);
        }
        if (missed_deadline() || is_worn_out()) return;
    }
    edges_.begin_node();
}

/// The shortest course through a node is never longer than through one that follows, so the first hit is of
/// the shortest course.
void Explorer::explore_guided() {
    for (std::size_t length = 0; length < open_.size(); ++length) {
        for (std::size_t i = 0; i < open_[length].size(); ++i) {
            visit(open_[length][i]);
            if (hit(0) || is_worn_out()) return;
        }
    }
}

std::uint32_t Explorer::distance(const Place& place) const {
    const Node node = precision().guide->states_.at(place);
    return node == kNone ? kFar : (*precision().distances)[node];
}

bool Explorer::is_worn_out() {
    if (!states_.is_worn_out()) return false;
    complete_ = false;
    return true;
}

void Explorer::add(const Place& place, const Zone& zone, const States::Origin& origin) {
    const bool is_guided = precision().guide != nullptr;
    const std::uint32_t depth = states_.depth_after(origin);
    states_.count_look_up();
    const bool is_line =
        precision().deadline != nullptr && zone.left == Bounds{} && !scans_.times_move(place);
    if (is_line && states_.is_covered(place, zone.passed)) return;
    Node node = is_line ? kNone : states_.find(place, zone);
    if (is_guided) node = states_.find_no_deeper(node, zone, depth);
    if (node == kNone) {
        const std::uint32_t rest = is_guided ? distance(place) : 0;
        if (rest == kFar) return;
        if (states_.size() >= precision().most_states || is_worn_out()) {
            complete_ = false;
            return;
        }
        node = states_.add(place, zone, origin, depth);
        steps_begun_ |= std::uint64_t{1} << place.step;
        if (is_guided) {
            if (open_.size() <= depth + rest) open_.resize(depth + rest + 1);
            open_[depth + rest].push_back(node);
        }
    }
    if (precision().keeps_edges && origin.parent != kNone) edges_.add({origin.parent, node, origin.group});
}

void Explorer::visit_plain(Node node) {
    const Place here = states_.place(node);
    const ImageSet permitted = allowed(here);
    for (const Group& group : machine().groups(here.step, !here.runs, here.counter == 0)) {
        if ((group.images & permitted).none()) continue;
        const std::uint8_t next_motors = scans_.next_motors(here, group);
        if (first_uses_[group.number] == kNone && next_motors != 0) first_uses_[group.number] = node;
        Place to = scans_.landing(here, group);
        hits_.judge(node, here, group, to.view(), permitted);
        const bool runs = to.runs;
        scans_.each_count(to, [&](Place there) {
            for (unsigned next = next_motors; next != 0; next &= next - 1) {
                there.motor = static_cast<Place::Motor>(std::countr_zero(next));
                there.runs = runs;
                if (runs) add(there, {}, {node, group.number, 0});
                there.runs = false;
                add(there, {}, {node, group.number, 0});
            }
        });
    }
}

void Explorer::visit(Node node) {
    const Place here = place(node);
    const Zone zone = states_.zone(node);
    const ImageSet permitted = allowed(here);
    const bool is_late = scans_.is_late(zone);
    for (const Group& group : machine().groups(here.step, !here.runs, here.counter == 0)) {
        const ImageSet images = group.images & permitted;
        if (images.none() || (is_late && !group.in_pos && !group.disturbs)) continue;
        if (first_uses_[group.number] == kNone) first_uses_[group.number] = node;
        const View view = view_after(here, group);
        hits_.judge(node, here, group, view, permitted);
        const auto split = scans_.parts(here, view, images);
        note_missed(here, zone, node, group, view, split, images);
        for (std::size_t p = 0; p < split.size(); ++p) {
            if (split[p].images.none()) continue;
            bool misses = false;
            scans_.each(
                here, zone, group, split[p],
                [&](const Place& place_there, const Zone& zone_there) {
                    scans_.each_count(place_there, [&](const Place& to) {
                        add(to, zone_there, {node, group.number, static_cast<std::uint8_t>(p)});
                    });
                },
                misses);
            if (misses && !missed_deadline()) missed_ = {node, &group, split[p].images};
        }
    }
}

/// A deadline that is missed by the end of the scan itself.
void Explorer::note_missed(const Place& here, const Zone& zone, Node node, const Group& group,
                           const View& view, const Successors::Parts& split, const ImageSet& images) {
    if (missed_deadline() || precision().deadline == nullptr) return;
    if (scans_.is_hold()) {
        if (!scans_.keeps_too_long(here, zone, group, view, images)) return;
        missed_ = {node, &group,
                   images & images_where(precision().deadline->then, view) &
                       images_where(precision().deadline->condition, view)};
        missed_at_end_ = true;
    } else if (here.pending && split[0].images.any() && scans_.ends_late(zone, group)) {
        missed_ = {node, &group, split[0].images};
        missed_at_end_ = true;
    }
}

}  // namespace nplc::verify
