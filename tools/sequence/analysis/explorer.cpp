#include "explorer.h"

#include <algorithm>
#include <array>
#include <bit>

namespace nplc::verify {
namespace {

using Motor = Place::Motor;

/// By this time a failed line is reported as lost, whatever was pending.
constexpr std::int32_t kUntilLost = 300;

/// For explorations with times: comparisons of zones; a look-up costs as much as kLookUp of them.
constexpr std::uint64_t kMostWork = 25'000'000;
constexpr std::uint64_t kLookUp = 10;
constexpr std::size_t kMostEdges = 6'000'000;
constexpr std::size_t kMostDense = std::size_t{1} << 24U;

constexpr std::uint8_t bit_of(Motor motor) {
    return static_cast<std::uint8_t>(1U << static_cast<unsigned>(motor));
}

}  // namespace

Explorer::Explorer(const Machine& machine, const Precision& precision)
    : machine_(machine), precision_(precision) {
    allowed_.fill(machine.permitted());
    if (machine.assume() == Assume::any) return;
    for (const Motor motor : {Motor::error, Motor::cut})
        allowed_[static_cast<std::size_t>(motor)] &= images_of_error();
    allowed_[static_cast<std::size_t>(Motor::lost)] &= images_of_lost_link();
}

Explorer::Node& Explorer::slot(const Place& place) {
    if (dense_) return dense_[dense_index(place)];
    return sparse_.try_emplace(place.packed(), 0).first->second;
}

Explorer::Node Explorer::slot_value(const Place& place) const {
    if (dense_) return dense_[dense_index(place)] - 1;
    const auto found = sparse_.find(place.packed());
    return found == sparse_.end() ? kNone : found->second - 1;
}

/// After a scan of the group.
Motion Explorer::motion_of(const Place& place, const Group& group) const {
    if (!machine_.tells_motion()) return Motion::none;
    return motion_after(place.motion, {group.in_pos, group.disturbs}, group.outcome.orders);
}

bool Explorer::is_idle(const Place& place, const Group& group) const {
    return !group.outcome.sends() && group.outcome.timer == 0 &&
           landing(place, group).packed() == place.packed();
}

/// The place right after the scan; the motor as the images' ERROR leaves it, not lost.
Place Explorer::after(const Place& place, const Group& group) const {
    Place next = landing(place, group);
    next.motor = group.error && !group.resets_error ? Motor::error : Motor::free;
    next.pending = false;
    return next;
}

std::array<Explorer::Part, 2> Explorer::parts(const Place& place, const View& view,
                                              const ImageSet& images) const {
    if (precision_.deadline == nullptr) return {Part{images, false, false}, Part{}};
    const ImageSet kept = images_where(precision_.deadline->then, view);
    if (is_hold()) return {Part{images & ~kept, false, false}, Part{images & kept, !place.pending, true}};
    if (place.pending) return {Part{images & kept, false, false}, Part{images & ~kept, false, true}};
    const ImageSet begun = images_where(precision_.deadline->condition, view) & ~kept;
    return {Part{images & ~begun, false, false}, Part{images & begun, true, true}};
}

bool Explorer::may_wait_for_line(Motor motor) const {
    return motor == Motor::cut || (precision_.waits_for_line && motor != Motor::free);
}

std::int32_t Explorer::most_idle(Motor motor) const {
    return std::int32_t{Machine::kMostIdle} + (may_wait_for_line(motor) ? kUntilLost : 0);
}

Bounds Explorer::delay_of(const Place& place, const Group& group, const Place& next) const {
    if (machine_.assume() == Assume::any) return {0, kEndless};
    if (is_idle(place, group)) return {0, kEndless};
    const auto most = static_cast<std::int32_t>(group.delay.most);
    if (may_wait_for_line(next.motor)) return {0, most + kUntilLost};
    if (group.error || group.delay.least < group.delay.end) return {0, most};
    return {static_cast<std::int32_t>(group.delay.least - group.delay.end), most};
}

/// Whether a scan that meets the deadline when it begins may end after it.
bool Explorer::ends_late(const Zone& zone, const Group& group) const {
    if (machine_.assume() == Assume::any || group.delay.end == 0) return false;
    return std::int64_t{zone.passed.most} + group.delay.end > precision_.deadline->within_ms;
}

/// Whether what NEVER .. WHILE forbids holds after the scan, and WHILE's condition may have held for the
/// time.
bool Explorer::keeps_too_long(const Place& place, const Zone& zone, const Group& group, const View& view,
                              const ImageSet& images) const {
    const Property& hold = *precision_.deadline;
    const std::uint32_t end = machine_.assume() == Assume::any ? 0 : group.delay.end;
    return place.pending && std::int64_t{zone.passed.most} + end >= hold.within_ms &&
           (images & images_where(hold.then, view) & images_where(hold.condition, view)).any();
}

/// The images of a scan after which `next` can be.
ImageSet Explorer::narrowed(const ImageSet& images, const Place& next) const {
    return next.motor == Motor::lost ? images & images_of_lost_link() : images;
}

template <class Each>
void Explorer::successors(const Place& place, const Zone& zone, const Group& group, const Part& part,
                          Each&& each, bool& misses) const {
    const Place next = after(place, group);
    Zone now = zone;
    if (part.begins || (place.pending && !part.pending)) now.begin_deadline();
    const bool moves = times_moves_ && is_timed(next.motion);
    if (times_moves_ && (!moves || begins_move(group.outcome.orders))) now.begin_move();
    if (group.outcome.timer != 0 && precision_.times_timer) {
        const PresetRange times = machine_.times_of(group.outcome.timer);
        now.preset(times.least, times.most);
    }
    const auto let_pass = [&](Place to) {
        if (!narrowed(part.images, to).any() || allowed(to).none()) return;
        to.pending = part.pending;
        if (!uses_zones_) {
            if (next.runs) each(to, now);
            to.runs = false;
            each(to, now);
            return;
        }
        const Bounds delay = delay_of(place, group, to);
        Zone later = now;
        later.elapse(delay, part.pending, moves);
        if (delay.most >= kEndless && machine_.assume() == Assume::driver) {
            // Scans repeat meanwhile, and the first with a new image is not idle
            if (precision_.times_timer && next.runs)
                later.left.least = std::max(later.left.least, 1 - most_idle(next.motor));
            if (moves) later.moved.most = std::min(later.moved.most, longest_move() + most_idle(next.motor));
            later.tighten(times_moves_);
        }
        if (part.pending) {
            const auto limit = static_cast<std::int32_t>(precision_.deadline->within_ms);
            if (!is_hold()) {
                if (later.passed.most > limit) misses = true;
                later.passed.most = std::min(later.passed.most, limit);
            }
        }
        const auto hand_out = [&](bool runs, bool is_over, bool is_late) {
            Zone there = later;
            if (is_late) {
                there.moved.least = std::max(there.moved.least, longest_move() + 1);
            } else if (moves) {
                there.moved.most = std::min(there.moved.most, longest_move());
            }
            if (is_hold() && part.pending) {
                const auto limit = static_cast<std::int32_t>(precision_.deadline->within_ms);
                if (is_over) {
                    there.passed.least = std::max(there.passed.least, limit);
                } else {
                    there.passed.most = std::min(there.passed.most, limit - 1);
                }
            }
            if (precision_.times_timer && next.runs) {
                if (runs) {
                    there.left.least = std::max(there.left.least, 1);
                } else {
                    there.left.most = std::min(there.left.most, 0);
                }
            } else {
                there.stop_timer();
            }
            there.tighten(times_moves_);
            if (there.empty()) return;
            if (!runs) there.stop_timer();
            if (is_over) there.cut_passed(static_cast<std::int32_t>(precision_.deadline->within_ms));
            if (is_late) there.cut_moved(longest_move() + 1);
            to.runs = runs;
            each(to, there);
        };
        for (const bool is_late : {false, true}) {
            if (is_late && !moves) continue;
            for (const bool is_over : {false, true}) {
                if (is_over && !(is_hold() && part.pending)) continue;
                if (next.runs) hand_out(true, is_over, is_late);
                hand_out(false, is_over, is_late);
            }
        }
    };
    const bool stays_lost = place.motor == Motor::lost && next.motor == Motor::error;
    if (!stays_lost) let_pass(next);
    if (machine_.assume() == Assume::any) return;
    if (next.motor == Motor::error && precision_.knows_lost_link && place.motor != Motor::error) {
        Place lost = next;
        lost.motor = Motor::lost;
        let_pass(lost);
    }
    if (next.motor == Motor::free && group.outcome.sends()) {
        Place cut = next;
        cut.motor = Motor::cut;
        let_pass(cut);
    }
}

/// The same as `after` and `successors` say, for every place at once.
void Explorer::find_next_motors() {
    const bool driver = machine_.assume() == Assume::driver;
    for (const Group& group : machine_.all_groups()) {
        auto& motors = next_motors_.emplace_back();
        for (const Motor motor : {Motor::free, Motor::error, Motor::lost, Motor::cut}) {
            const ImageSet images = group.images & allowed_[static_cast<std::size_t>(motor)];
            if (images.none() || (!driver && motor != Motor::free)) continue;
            std::uint8_t& next = motors[static_cast<std::size_t>(motor)];
            const bool shows_error = group.error && !group.resets_error;
            if (!(shows_error && motor == Motor::lost))
                next |= bit_of(shows_error ? Motor::error : Motor::free);
            const bool may_be_lost = (images & images_of_lost_link()).any();
            if (shows_error && precision_.knows_lost_link && motor != Motor::error && may_be_lost)
                next |= bit_of(Motor::lost);
            if (driver && !shows_error && group.outcome.sends()) next |= bit_of(Motor::cut);
            for (const Motor then : {Motor::free, Motor::error, Motor::lost, Motor::cut}) {
                if (allowed_[static_cast<std::size_t>(then)].none())
                    next &= static_cast<std::uint8_t>(~bit_of(then));
            }
        }
    }
}

Explorer::Node Explorer::find(const Place& place, const Zone& zone) const {
    Node node = slot_value(place);
    if (!uses_zones_) return node;
    while (node != kNone && !zone.within(zones_[node])) {
        node = same_place_[node];
        ++work_;
    }
    return node;
}

/// Whether known nodes include all times that can have passed; if not, they are added.
bool Explorer::is_covered(const Place& place, const Bounds& passed) {
    std::vector<Bounds>& parts = covered_[place.packed()];
    const auto first = std::find_if(parts.begin(), parts.end(),
                                    [&](const Bounds& part) { return part.most >= passed.least - 1; });
    if (first != parts.end() && passed.within(*first)) return true;
    Bounds joined = passed;
    auto end = first;
    for (; end != parts.end() && end->least <= passed.most + 1; ++end)
        joined = {std::min(joined.least, end->least), std::max(joined.most, end->most)};
    parts.insert(parts.erase(first, end), joined);
    return false;
}

void Explorer::add(const Place& place, const Zone& zone, const Origin& origin) {
    const std::uint32_t depth = origin.parent == kNone ? 0 : depths_[origin.parent] + 1;
    if (uses_zones_) work_ += kLookUp;
    const bool is_line =
        precision_.deadline != nullptr && zone.left == Bounds{} && !(times_moves_ && is_timed(place.motion));
    if (is_line && is_covered(place, zone.passed)) return;
    Node node = is_line ? kNone : find(place, zone);
    if (precision_.guide != nullptr) {
        while (node != kNone && (depths_[node] > depth || !zone.within(zones_[node])))
            node = same_place_[node];
    }
    if (node == kNone) {
        const std::uint32_t rest = precision_.guide != nullptr ? distance(place) : 0;
        if (rest == kFar) return;
        if (places_.size() >= precision_.most_states || is_worn_out()) {
            complete_ = false;
            return;
        }
        node = static_cast<Node>(places_.size());
        Node& first = slot(place);
        places_.push_back(place);
        origins_.push_back(origin);
        depths_.push_back(depth);
        if (uses_zones_) {
            zones_.push_back(zone);
            same_place_.push_back(first - 1);
        }
        first = node + 1;
        steps_begun_ |= std::uint64_t{1} << place.step;
        if (precision_.guide != nullptr) {
            if (open_.size() <= depth + rest) open_.resize(depth + rest + 1);
            open_[depth + rest].push_back(node);
        }
    }
    if (!precision_.keeps_edges || origin.parent == kNone || !has_all_edges_) return;
    has_all_edges_ = edges_.size() < kMostEdges;
    if (has_all_edges_) {
        edges_.push_back({origin.parent, node, origin.group});
    } else {
        edges_ = {};
    }
}

std::uint32_t Explorer::distance(const Place& place) const {
    const Node node = precision_.guide->slot_value(place);
    return node == kNone ? kFar : (*precision_.distances)[node];
}

/// The shortest course through a node is never longer than through one that follows, so the first hit is of
/// the shortest course.
void Explorer::explore_guided(const std::vector<Target>& targets) {
    for (std::size_t length = 0; length < open_.size(); ++length) {
        for (std::size_t i = 0; i < open_[length].size(); ++i) {
            visit(open_[length][i], targets);
            if (hit(0) || is_worn_out()) return;
        }
    }
}

bool Explorer::is_worn_out() {
    if (work_ < kMostWork) return false;
    complete_ = false;
    return true;
}

/// Enough for most tables: memory is committed only where it is written.
void Explorer::reserve() {
    constexpr std::size_t kNodes = std::size_t{1} << 17U;
    constexpr std::size_t kEdges = std::size_t{1} << 20U;
    places_.reserve(kNodes);
    origins_.reserve(kNodes);
    depths_.reserve(kNodes);
    if (uses_zones_) zones_.reserve(kNodes);
    if (precision_.keeps_edges) edges_.reserve(kEdges);
}

void Explorer::explore(const std::vector<Target>& targets) {
    uses_zones_ = precision_.times_timer || precision_.deadline != nullptr;
    times_moves_ = uses_zones_ && machine_.move_ms() != 0;
    hits_.assign(targets.size(), {});
    judged_.assign(machine_.all_groups().size(), {});
    first_uses_.assign(machine_.all_groups().size(), kNone);
    const unsigned bits = Place::kPlainBits + (precision_.deadline != nullptr ? 1U : 0U);
    const std::size_t dense = (machine_.greatest_counter() + std::size_t{1}) << bits;
    if (dense <= kMostDense && !machine_.tells_motion())
        dense_.reset(static_cast<Node*>(std::calloc(dense, sizeof(Node))));
    find_next_motors();
    reserve();
    add({}, {}, {});
    if (precision_.guide != nullptr) return explore_guided(targets);
    for (Node node = 0; node < places_.size(); ++node) {
        first_edge_.push_back(static_cast<std::uint32_t>(edges_.size()));
        if (uses_zones_) {
            visit(node, targets);
        } else {
            visit_plain(node, targets);
        }
        if (missed_deadline() || is_worn_out()) return;
    }
    first_edge_.push_back(static_cast<std::uint32_t>(edges_.size()));
}

/// The place after a scan of a group, before any time passes; the motor is unchanged.
Place Explorer::landing(const Place& here, const Group& group) const {
    sequencer::State state{here.step, here.outputs, std::uint16_t{here.runs}, here.counter};
    group.outcome.apply(state);
    Place to = here;
    to.step = state.step;
    to.outputs = state.outputs;
    to.runs = state.timer != 0;
    to.counter = state.counter;
    to.motion = motion_of(here, group);
    return to;
}

void Explorer::visit_plain(Node node, const std::vector<Target>& targets) {
    const Place here = places_[node];
    const auto motor = static_cast<std::size_t>(here.motor);
    for (const Group& group : machine_.groups(here.step, !here.runs, here.counter == 0)) {
        if ((group.images & allowed_[motor]).none()) continue;
        const std::uint8_t next_motors = next_motors_[group.number][motor];
        if (first_uses_[group.number] == kNone && next_motors != 0) first_uses_[group.number] = node;
        Place to = landing(here, group);
        if (!targets.empty()) judge(node, group, view_of(to), targets);
        const bool runs = to.runs;
        each_count(to, [&](Place there) {
            for (unsigned next = next_motors; next != 0; next &= next - 1) {
                there.motor = static_cast<Motor>(std::countr_zero(next));
                there.runs = runs;
                if (runs) add(there, {}, {node, group.number, 0});
                there.runs = false;
                add(there, {}, {node, group.number, 0});
            }
        });
    }
}

void Explorer::visit(Node node, const std::vector<Target>& targets) {
    const Place here = place(node);
    const Zone zone = zones_[node];
    const ImageSet permitted = allowed(here);
    const bool is_late = times_moves_ && zone.moved.least > longest_move();
    for (const Group& group : machine_.groups(here.step, !here.runs, here.counter == 0)) {
        const ImageSet images = group.images & permitted;
        if (images.none() || (is_late && !group.in_pos && !group.disturbs)) continue;
        if (first_uses_[group.number] == kNone) first_uses_[group.number] = node;
        const View view = view_after(here, group);
        if (!targets.empty()) judge(node, group, view, targets);
        const auto split = parts(here, view, images);
        note_missed(here, zone, node, group, view, split, images);
        for (std::size_t p = 0; p < split.size(); ++p) {
            if (split[p].images.none()) continue;
            bool misses = false;
            successors(
                here, zone, group, split[p],
                [&](const Place& place_there, const Zone& zone_there) {
                    each_count(place_there, [&](const Place& to) {
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
                           const View& view, const std::array<Part, 2>& split, const ImageSet& images) {
    if (missed_deadline() || precision_.deadline == nullptr) return;
    if (is_hold()) {
        if (!keeps_too_long(here, zone, group, view, images)) return;
        missed_ = {node, &group,
                   images & images_where(precision_.deadline->then, view) &
                       images_where(precision_.deadline->condition, view)};
        missed_at_end_ = true;
    } else if (here.pending && split[0].images.any() && ends_late(zone, group)) {
        missed_ = {node, &group, split[0].images};
        missed_at_end_ = true;
    }
}

const std::vector<Explorer::Wanted>& Explorer::wanted_in(const View& view,
                                                         const std::vector<Target>& targets) {
    const std::uint32_t key = view.step | (std::uint32_t{view.outputs} << 6U) |
                              (view.timer_zero ? 1U << 10U : 0U) | (view.counter_zero ? 1U << 11U : 0U) |
                              (view.moving ? 1U << 12U : 0U);
    const auto [found, is_new] = wanted_.try_emplace(key);
    if (!is_new) return found->second;
    for (std::size_t target = 0; target < targets.size(); ++target) {
        const ImageSet images = targets[target].images(view);
        if (images.any()) found->second.push_back({target, images});
    }
    return found->second;
}

void Explorer::judge(Node node, const Group& group, const View& view, const std::vector<Target>& targets) {
    const Place& here = places_[node];
    auto seen = judged_[group.number][surroundings_of(here, group, view)];
    if (seen) return;
    seen = true;
    for (const Wanted& wanted : wanted_in(view, targets)) {
        if (hits_[wanted.target].node != kNone) continue;
        const ImageSet images = wanted.images & group.images & allowed(here);
        if (images.any()) hits_[wanted.target] = {node, &group, images};
    }
}

}  // namespace nplc::verify
