#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "explorer.h"

namespace nplc::verify {

const Explorer::Edge& Explorer::first_edge_with(const Group& group) const {
    const std::span<const Edge> own = edges_from(first_use(group));
    return *std::find_if(own.begin(), own.end(),
                         [&](const Edge& edge) { return edge.group == group.number; });
}

/// Those where a scan of the target can begin.
std::vector<Explorer::Node> Explorer::nodes_before(const Target& target) const {
    enum : std::uint8_t { kUnknown, kCannot, kCan };
    std::vector<std::array<std::uint8_t, kSurroundings>> known(machine_.all_groups().size());
    std::vector<Node> nodes;
    for (Node node = 0; node < places_.size(); ++node) {
        const Place& here = places_[node];
        for (const Group& group : machine_.groups(here.step, !here.runs, here.counter == 0)) {
            const View view = view_of(landing(here, group));
            std::uint8_t& can = known[group.number][surroundings_of(here, group, view)];
            if (can == kUnknown) {
                const ImageSet images = group.images & allowed(here);
                can = images.any() && (images & target.images(view)).any() ? kCan : kCannot;
            }
            if (can == kCannot) continue;
            nodes.push_back(node);
            break;
        }
    }
    return nodes;
}

void Explorer::find_edges_back() {
    if (!back_.empty() || edges_.empty()) return;
    first_back_.assign(places_.size() + 1, 0);
    for (const Edge& edge : edges_) ++first_back_[edge.to + 1];
    for (std::size_t i = 1; i < first_back_.size(); ++i) first_back_[i] += first_back_[i - 1];
    back_.resize(edges_.size());
    std::vector<std::uint32_t> next(first_back_.begin(), first_back_.end());
    for (const Edge& edge : edges_) back_[next[edge.to]++] = edge.from;
}

std::vector<std::uint32_t> Explorer::distances_to(const Target& target) {
    find_edges_back();
    std::vector<std::uint32_t> distances(places_.size(), kFar);
    std::vector<Node> open = nodes_before(target);
    for (const Node node : open) distances[node] = 1;
    for (std::size_t i = 0; i < open.size() && !back_.empty(); ++i) {
        const Node node = open[i];
        for (std::uint32_t k = first_back_[node]; k < first_back_[node + 1]; ++k) {
            if (distances[back_[k]] != kFar) continue;
            distances[back_[k]] = distances[node] + 1;
            open.push_back(back_[k]);
        }
    }
    return distances;
}

CourseScan Explorer::scan_of(const Place& place, const Group& group, const ImageSet& images) const {
    CourseScan scan;
    scan.place = place;
    scan.group = &group;
    scan.images = images;
    scan.view = view_after(place, group);
    scan.idle = is_idle(place, group);
    const Place next = after(place, group);
    scan.counter = next.counter;
    scan.delay = delay_of(place, group, next);
    return scan;
}

std::vector<CourseScan> Explorer::course_to_node(Node node) const {
    std::vector<CourseScan> course;
    for (; origins_[node].parent != kNone; node = origins_[node].parent) {
        const Origin& origin = origins_[node];
        const Place& from = place(origin.parent);
        const Place& to = place(node);
        const Group& group = machine_.group(origin.group);
        const auto split = parts(from, view_after(from, group), group.images & allowed(from));
        CourseScan scan = scan_of(from, group, narrowed(split[origin.part].images, to));
        scan.counter = to.counter;
        scan.delay = delay_of(from, group, to);
        scan.next_runs = to.runs;
        course.push_back(scan);
    }
    std::reverse(course.begin(), course.end());
    return course;
}

CourseScan Explorer::scan_of(const Edge& edge, const ImageSet& images) const {
    CourseScan scan = scan_of(place(edge.from), group_of(edge), images);
    scan.counter = place(edge.to).counter;
    scan.delay = delay_of(place(edge.from), group_of(edge), place(edge.to));
    scan.next_runs = place(edge.to).runs;
    return scan;
}

std::vector<CourseScan> Explorer::course_to(std::size_t target) const {
    const Hit& hit = hits_[target];
    if (hit.node == kNone) return {};
    std::vector<CourseScan> course = course_to_node(hit.node);
    course.push_back(scan_of(place(hit.node), *hit.group, hit.images));
    return course;
}

std::vector<CourseScan> Explorer::course_to_missed_deadline() const {
    if (!missed_deadline()) return {};
    std::vector<CourseScan> course = course_to_node(missed_.node);
    course.push_back(scan_of(place(missed_.node), *missed_.group, missed_.images));
    if (missed_at_end_ && course.size() > 1 && course[course.size() - 2].delay.most < kEndless)
        course[course.size() - 2].delay.most += static_cast<std::int32_t>(course.back().group->delay.end);
    return course;
}

Explorer::Scans Explorer::scans() const {
    Scans scans;
    for (const Edge& edge : edges_) scans.insert(scan_key(place(edge.from), edge.group));
    return scans;
}

Explorer::Stuck Explorer::same_scan(const Place& place, const Stuck& stuck) const {
    const std::uint64_t key = scan_key(place, stuck.group->number);
    const auto found = std::find_if(edges_.begin(), edges_.end(), [&](const Edge& edge) {
        return scan_key(places_[edge.from], edge.group) == key;
    });
    return found == edges_.end() ? Stuck{} : Stuck{found->from, stuck.group, stuck.images, stuck.counter};
}

Explorer::Stuck Explorer::first_stuck(const Target& target, const std::vector<std::uint32_t>& distances,
                                      const Scans* only) const {
    for (Node node = 0; node < places_.size(); ++node) {
        const std::span<const Edge> edges = edges_from(node);
        for (std::size_t first = 0; first < edges.size();) {
            const Group& group = group_of(edges[first]);
            std::array<bool, 4> there{};
            std::array<bool, 4> way_out{};
            const std::uint16_t counter = places_[edges[first].to].counter;
            const auto is_same = [&](const Edge& edge) {
                return edge.group == group.number && places_[edge.to].counter == counter;
            };
            std::size_t end = first;
            for (; end < edges.size() && is_same(edges[end]); ++end) {
                const Place::Motor then = places_[edges[end].to].motor;
                const auto motor =
                    static_cast<std::size_t>(then == Place::Motor::cut ? Place::Motor::free : then);
                there[motor] = true;
                if (distances[edges[end].to] != kFar) way_out[motor] = true;
            }
            first = end;
            if (there == way_out) continue;
            const Place& here = places_[node];
            if (only != nullptr && !only->contains(scan_key(here, group.number))) continue;
            const View view = view_after(here, group);
            ImageSet images = group.images & allowed(here) & ~target.images(view);
            if (target.from != nullptr) images &= images_where(*target.from, view);
            const bool only_lost = there[0] == way_out[0] && there[1] == way_out[1];
            if (only_lost) images &= images_of_lost_link();
            if (images.any()) return {node, &group, images, counter};
        }
    }
    return {};
}

std::vector<CourseScan> Explorer::course_to(const Stuck& stuck) const {
    std::vector<CourseScan> course = course_to_node(stuck.node);
    course.push_back(scan_of(place(stuck.node), *stuck.group, stuck.images));
    course.back().counter = stuck.counter;
    return course;
}

}  // namespace nplc::verify
