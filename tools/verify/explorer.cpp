#include "explorer.h"

#include <algorithm>
#include <array>

namespace nplc::verify {
namespace {

/// A line that works no more is known as lost by then, whatever was to be sent.
constexpr std::int32_t kUntilLost = 300;

ImageSet images_with(unsigned bits, unsigned levels) {
    ImageSet set;
    for (unsigned image = 0; image < 256; ++image) set[image] = (image & bits) == levels;
    return set;
}

const ImageSet& images_of_error() {
    static const ImageSet set = images_with(sequencer::kError, sequencer::kError);
    return set;
}
const ImageSet& images_of_lost_link() {
    static const ImageSet set = images_with(sequencer::kError | sequencer::kInPos, sequencer::kError);
    return set;
}

constexpr unsigned kCounterBit = 15;
constexpr unsigned kPlainBits = 11;  ///< of a place under `any`: step, outputs, timer
constexpr std::size_t kMostEdges = 10'000'000;
constexpr std::size_t kMostDense = std::size_t{1} << 24U;

}  // namespace

std::size_t Explorer::dense_index(std::uint64_t packed) const {
    if (machine_.assume() == Assume::driver) return packed;
    return (packed & ((1U << kPlainBits) - 1)) | (packed >> kCounterBit << kPlainBits);
}

Explorer::Node& Explorer::slot(std::uint64_t packed) {
    if (!dense_.empty()) return dense_[dense_index(packed)];
    return sparse_.try_emplace(packed, kNone).first->second;
}

Explorer::Node Explorer::slot_value(std::uint64_t packed) const {
    if (!dense_.empty()) return dense_[dense_index(packed)];
    const auto found = sparse_.find(packed);
    return found == sparse_.end() ? kNone : found->second;
}

ImageSet Explorer::allowed(const Place& place) const {
    const ImageSet& permitted = machine_.permitted();
    if (machine_.assume() == Assume::any) return permitted;
    if (place.motor == Place::Motor::lost) return images_of_lost_link() & permitted;
    if (place.motor == Place::Motor::error || place.error_comes) return images_of_error() & permitted;
    return permitted;
}

View Explorer::view_after(const Place& place, const Group& group) const {
    sequencer::State state{place.step, place.outputs, std::uint16_t{place.runs}, place.counter};
    sequencer::apply(group.pending, state);
    const bool moving =
        machine_.tells_motion() && motion_after(place.motion, group.in_pos, group.orders) != Motion::none;
    return {state.step, state.outputs, state.timer == 0, state.counter == 0, moving};
}

bool Explorer::is_idle(const Place& place, const Group& group) const {
    if (group.sends || (place.motion == Motion::to_place && group.in_pos)) return false;
    sequencer::State state{place.step, place.outputs, std::uint16_t{place.runs}, place.counter};
    return !sequencer::apply(group.pending, state);
}

/// The place right after the scan; the motor as the images' ERROR leaves it, not lost.
Place Explorer::after(const Place& place, const Group& group) const {
    sequencer::State state{place.step, place.outputs, std::uint16_t{place.runs}, place.counter};
    sequencer::apply(group.pending, state);
    Place next;
    next.step = state.step;
    next.outputs = state.outputs;
    next.runs = state.timer != 0;
    next.counter = state.counter;
    if (machine_.tells_motion()) next.motion = motion_after(place.motion, group.in_pos, group.orders);
    if (machine_.assume() == Assume::driver && (group.images & images_of_error()).any() &&
        !group.resets_error)
        next.motor = Place::Motor::error;
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

Bounds Explorer::delay_of(const Place& place, const Group& group, const Place& next) const {
    if (machine_.assume() == Assume::any) return {0, kEndless};
    if (is_idle(place, group)) return {0, kEndless};
    const auto most = static_cast<std::int32_t>(group.delay.most);
    if (next.error_comes) return {0, most + kUntilLost};
    const bool error = (group.images & images_of_error()).any();
    if (error || group.delay.least < group.delay.end) return {0, most};
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
    return next.motor == Place::Motor::lost ? images & images_of_lost_link() : images;
}

template <class Each>
void Explorer::successors(const Place& place, const Zone& zone, const Group& group, const Part& part,
                          Each&& each, bool& misses) const {
    const Place next = after(place, group);
    Zone now = zone;
    if (part.begins || (place.pending && !part.pending)) now.begin_deadline();
    if (group.pending.timer_preset != 0 && precision_.times_timer) now.preset(group.pending.timer_preset);
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
        later.elapse(delay, part.pending);
        if (precision_.times_timer && next.runs && delay.most >= kEndless &&
            machine_.assume() == Assume::driver) {
            later.left.least = std::max(later.left.least, 1 - std::int32_t{Machine::kMostIdle});
            later.tighten();
        }
        if (part.pending) {
            const auto limit = static_cast<std::int32_t>(precision_.deadline->within_ms);
            if (!is_hold()) {
                if (later.passed.most > limit) misses = true;
                later.passed.most = std::min(later.passed.most, limit);
            }
        }
        const auto hand_out = [&](bool runs, bool is_over) {
            Zone there = later;
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
                there.left = {};
                there.sum = there.passed;
            }
            there.tighten();
            if (there.empty()) return;
            if (!runs) there.stop_timer();
            if (is_over) there.cut_passed(static_cast<std::int32_t>(precision_.deadline->within_ms));
            to.runs = runs;
            each(to, there);
        };
        for (const bool is_over : {false, true}) {
            if (is_over && !(is_hold() && part.pending)) continue;
            if (next.runs) hand_out(true, is_over);
            hand_out(false, is_over);
        }
    };
    const bool stays_lost = place.motor == Place::Motor::lost && next.motor == Place::Motor::error;
    if (!stays_lost) let_pass(next);
    if (machine_.assume() == Assume::any) return;
    if (next.motor == Place::Motor::error && precision_.knows_lost_link &&
        place.motor != Place::Motor::error) {
        Place lost = next;
        lost.motor = Place::Motor::lost;
        let_pass(lost);
    }
    if (next.motor == Place::Motor::free && group.sends) {
        Place cut = next;
        cut.error_comes = true;
        let_pass(cut);
    }
}

Explorer::Node Explorer::find(const Place& place, const Zone& zone) const {
    Node node = slot_value(place.packed());
    if (!uses_zones_) return node;
    while (node != kNone && !zone.within(zones_[node])) node = same_place_[node];
    return node;
}

void Explorer::add(const Place& place, const Zone& zone, const Origin& origin, Node from) {
    Node node = find(place, zone);
    if (node == kNone) {
        if (places_.size() >= precision_.most_states) {
            complete_ = false;
            return;
        }
        node = static_cast<Node>(places_.size());
        Node& first = slot(place.packed());
        places_.push_back(place.packed());
        origins_.push_back(origin);
        if (uses_zones_) {
            zones_.push_back(zone);
            same_place_.push_back(first);
        }
        first = node;
        steps_begun_ |= std::uint64_t{1} << place.step;
    }
    if (!precision_.keeps_edges || from == kNone || !has_all_edges_) return;
    has_all_edges_ = edges_.size() < kMostEdges;
    edges_.push_back({from, node, origin.group});
}

void Explorer::explore(const std::vector<Target>& targets) {
    uses_zones_ = precision_.times_timer || precision_.deadline != nullptr;
    hits_.assign(targets.size(), {});
    judged_.assign(machine_.group_count(), {});
    const unsigned bits = machine_.assume() == Assume::driver ? kCounterBit : kPlainBits;
    const std::size_t dense = (machine_.greatest_counter() + std::size_t{1}) << bits;
    if (dense <= kMostDense && !machine_.tells_motion()) dense_.assign(dense, kNone);
    add({}, {}, {}, kNone);
    for (Node node = 0; node < places_.size(); ++node) {
        first_edge_.push_back(static_cast<std::uint32_t>(edges_.size()));
        visit(node, targets);
        if (missed_deadline()) return;
    }
    first_edge_.push_back(static_cast<std::uint32_t>(edges_.size()));
}

void Explorer::visit(Node node, const std::vector<Target>& targets) {
    const Place here = place(node);
    const Zone zone = uses_zones_ ? zones_[node] : Zone{};
    const ImageSet permitted = allowed(here);
    const auto groups = machine_.groups(here.step, !here.runs, here.counter == 0);
    const std::size_t first = machine_.first_group(here.step, !here.runs, here.counter == 0);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const Group& group = groups[i];
        const ImageSet images = group.images & permitted;
        if (images.none()) continue;
        const auto index = static_cast<std::uint16_t>(i);
        const View view = view_after(here, group);
        if (!targets.empty()) {
            const std::size_t surroundings = (group.pending.has_output ? 0U : here.outputs) |
                                             (view.timer_zero ? 16U : 0U) | (view.counter_zero ? 32U : 0U) |
                                             (static_cast<unsigned>(here.motor) << 6U) |
                                             (here.error_comes ? 256U : 0U) | (view.moving ? 512U : 0U);
            auto seen = judged_[first + i][surroundings];
            if (!seen) judge(node, index, group, images, view, targets);
            seen = true;
        }
        const auto split = parts(here, view, images);
        if (is_hold() && !missed_deadline() && keeps_too_long(here, zone, group, view, images)) {
            missed_ = {node, index,
                       images & images_where(precision_.deadline->then, view) &
                           images_where(precision_.deadline->condition, view)};
            missed_at_end_ = true;
        }
        if (!is_hold() && here.pending && split[0].images.any() && ends_late(zone, group) &&
            !missed_deadline()) {
            missed_ = {node, index, split[0].images};
            missed_at_end_ = true;
        }
        for (std::size_t p = 0; p < split.size(); ++p) {
            if (split[p].images.none()) continue;
            bool misses = false;
            successors(
                here, zone, group, split[p],
                [&](const Place& place_there, const Zone& zone_there) {
                    add(place_there, zone_there, {node, index, static_cast<std::uint8_t>(p)}, node);
                },
                misses);
            if (misses && !missed_deadline()) missed_ = {node, index, split[p].images};
        }
    }
}

void Explorer::judge(Node node, std::uint16_t index, const Group& /*group*/, const ImageSet& images,
                     const View& view, const std::vector<Target>& targets) {
    for (std::size_t t = 0; t < targets.size(); ++t) {
        if (hits_[t].node != kNone) continue;
        const ImageSet wanted = targets[t].images(view) & images;
        if (wanted.any()) hits_[t] = {node, index, wanted};
    }
}

CourseScan Explorer::scan_of(const Place& place, std::uint16_t index, const ImageSet& images) const {
    const Group& group = machine_.groups(place.step, !place.runs, place.counter == 0)[index];
    CourseScan scan;
    scan.place = place;
    scan.group = &group;
    scan.images = images;
    scan.view = view_after(place, group);
    scan.idle = is_idle(place, group);
    scan.delay = delay_of(place, group, after(place, group));
    return scan;
}

std::vector<CourseScan> Explorer::course_to_node(Node node) const {
    std::vector<CourseScan> course;
    for (; origins_[node].parent != kNone; node = origins_[node].parent) {
        const Origin& origin = origins_[node];
        const Place from = place(origin.parent);
        const Place to = place(node);
        const Group& group = machine_.groups(from.step, !from.runs, from.counter == 0)[origin.group];
        const auto split = parts(from, view_after(from, group), group.images & allowed(from));
        CourseScan scan = scan_of(from, origin.group, narrowed(split[origin.part].images, to));
        scan.delay = delay_of(from, group, to);
        course.push_back(scan);
    }
    std::reverse(course.begin(), course.end());
    return course;
}

CourseScan Explorer::scan_of(const Edge& edge, const ImageSet& images) const {
    CourseScan scan = scan_of(place(edge.from), edge.group, images);
    scan.delay = delay_of(place(edge.from), group_of(edge), place(edge.to));
    return scan;
}

std::vector<CourseScan> Explorer::course_to(std::size_t target) const {
    const Hit& hit = hits_[target];
    if (hit.node == kNone) return {};
    std::vector<CourseScan> course = course_to_node(hit.node);
    course.push_back(scan_of(place(hit.node), hit.group, hit.images));
    return course;
}

std::vector<CourseScan> Explorer::course_to_missed_deadline() const {
    if (!missed_deadline()) return {};
    std::vector<CourseScan> course = course_to_node(missed_.node);
    course.push_back(scan_of(place(missed_.node), missed_.group, missed_.images));
    if (missed_at_end_ && course.size() > 1 && course[course.size() - 2].delay.most < kEndless)
        course[course.size() - 2].delay.most += static_cast<std::int32_t>(course.back().group->delay.end);
    return course;
}

bool Explorer::can_hit_from(Node node, const Target& target) const {
    const Place here = place(node);
    const ImageSet permitted = allowed(here);
    for (const Group& group : machine_.groups(here.step, !here.runs, here.counter == 0)) {
        const ImageSet images = group.images & permitted;
        if (images.any() && (images & target.images(view_after(here, group))).any()) return true;
    }
    return false;
}

std::vector<Explorer::Option> Explorer::options(Node node, const Target& target) const {
    std::vector<Option> result;
    const Place here = place(node);
    const ImageSet permitted = allowed(here);
    for (const Group& group : machine_.groups(here.step, !here.runs, here.counter == 0)) {
        Option option{.group = &group,
                      .images = group.images & permitted,
                      .hits = {},
                      .other = {},
                      .idle = is_idle(here, group),
                      .next = {}};
        if (option.images.none()) continue;
        const View view = view_after(here, group);
        option.hits = option.images & target.images(view);
        option.other = option.images & ~option.hits;
        if (target.from != nullptr) option.other &= images_where(*target.from, view);
        bool misses = false;
        successors(
            here, {}, group, Part{option.images, false, false},
            [&](const Place& to, const Zone& zone) {
                if (to.error_comes) return;
                const bool lost = to.motor == Place::Motor::lost;
                if (option.next.empty() || option.next.back().lost != lost) {
                    option.next.emplace_back();
                    option.next.back().lost = lost;
                }
                (to.runs ? option.next.back().running : option.next.back().zero) = find(to, zone);
            },
            misses);
        result.push_back(std::move(option));
    }
    return result;
}

Explorer::Stuck Explorer::first_stuck(const Target& target, const std::vector<bool>& good) const {
    for (Node node = 0; node < places_.size(); ++node) {
        const Place here = place(node);
        const Zone zone = uses_zones_ ? zones_[node] : Zone{};
        const ImageSet permitted = allowed(here);
        const auto groups = machine_.groups(here.step, !here.runs, here.counter == 0);
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const View view = view_after(here, groups[i]);
            ImageSet images = groups[i].images & permitted & ~target.images(view);
            if (target.from != nullptr) images &= images_where(*target.from, view);
            if (images.none()) continue;
            bool is_stuck = false;
            std::array<bool, 3> way_out{};
            std::array<bool, 3> there{};
            bool misses = false;
            successors(
                here, zone, groups[i], Part{images, false, false},
                [&](const Place& to, const Zone& zone_there) {
                    const Node next = find(to, zone_there);
                    const auto motor = static_cast<std::size_t>(to.motor);
                    there[motor] = true;
                    if (next == kNone || good[next]) way_out[motor] = true;
                },
                misses);
            ImageSet stuck_images = images;
            for (std::size_t motor = 0; motor < 3; ++motor) {
                if (!there[motor] || way_out[motor]) continue;
                is_stuck = true;
                if (motor == static_cast<std::size_t>(Place::Motor::lost))
                    stuck_images &= images_of_lost_link();
                break;
            }
            if (is_stuck) return {node, i, stuck_images};
        }
    }
    return {};
}

std::vector<CourseScan> Explorer::course_to(const Stuck& stuck) const {
    std::vector<CourseScan> course = course_to_node(stuck.node);
    course.push_back(scan_of(place(stuck.node), static_cast<std::uint16_t>(stuck.group), stuck.images));
    return course;
}

}  // namespace nplc::verify
