#include "ways_back.h"

#include <algorithm>
#include <array>
#include <span>

namespace nplc::verify {
namespace {

/// Those where a scan of the target can begin.
std::vector<Explorer::Node> nodes_before(const Explorer& explorer, const Target& target) {
    enum : std::uint8_t { kUnknown, kCannot, kCan };
    std::vector<std::array<std::uint8_t, kSurroundings>> known(explorer.machine().all_groups().size());
    std::vector<Explorer::Node> nodes;
    for (Explorer::Node node = 0; node < explorer.size(); ++node) {
        const Place& here = explorer.place(node);
        for (const Group& group : explorer.machine().groups(here.step, !here.runs, here.counter == 0)) {
            const View view = explorer.view_after(here, group);
            std::uint8_t& can = known[group.number][surroundings_of(here, group, view)];
            if (can == kUnknown) {
                const ImageSet images = group.images & explorer.allowed(here);
                can = images.any() && (images & target.images(view)).any() ? kCan : kCannot;
            }
            if (can == kCannot) continue;
            nodes.push_back(node);
            break;
        }
    }
    return nodes;
}

}  // namespace

std::vector<std::uint32_t> distances_to(Explorer& explorer, const Target& target) {
    const EdgesBack& back = explorer.edges_back();
    std::vector<std::uint32_t> distances(explorer.size(), kFar);
    std::vector<Explorer::Node> open = nodes_before(explorer, target);
    for (const Explorer::Node node : open) distances[node] = 1;
    for (std::size_t i = 0; i < open.size(); ++i) {
        const Explorer::Node node = open[i];
        for (const Explorer::Node from : back.to(node)) {
            if (distances[from] != kFar) continue;
            distances[from] = distances[node] + 1;
            open.push_back(from);
        }
    }
    return distances;
}

ScanKeys scans_of(const Explorer& explorer) {
    ScanKeys scans;
    for (const Explorer::Edge& edge : explorer.edges())
        scans.insert(scan_key(explorer.place(edge.from), edge.group));
    return scans;
}

Stuck same_scan(const Explorer& explorer, const Place& place, const Stuck& stuck) {
    const std::uint64_t key = scan_key(place, stuck.group->number);
    const auto& edges = explorer.edges();
    const auto found = std::find_if(edges.begin(), edges.end(), [&](const Explorer::Edge& edge) {
        return scan_key(explorer.place(edge.from), edge.group) == key;
    });
    return found == edges.end() ? Stuck{} : Stuck{found->from, stuck.group, stuck.images, stuck.counter};
}

Stuck first_stuck(const Explorer& explorer, const Target& target, const std::vector<std::uint32_t>& distances,
                  const ScanKeys* only) {
    for (Explorer::Node node = 0; node < explorer.size(); ++node) {
        const std::span<const Explorer::Edge> edges = explorer.edges_from(node);
        for (std::size_t first = 0; first < edges.size();) {
            const Group& group = explorer.group_of(edges[first]);
            std::array<bool, 4> there{};
            std::array<bool, 4> way_out{};
            const std::uint16_t counter = explorer.place(edges[first].to).counter;
            const auto is_same = [&](const Explorer::Edge& edge) {
                return edge.group == group.number && explorer.place(edge.to).counter == counter;
            };
            std::size_t end = first;
            for (; end < edges.size() && is_same(edges[end]); ++end) {
                const Place::Motor then = explorer.place(edges[end].to).motor;
                const auto motor =
                    static_cast<std::size_t>(then == Place::Motor::cut ? Place::Motor::free : then);
                there[motor] = true;
                if (distances[edges[end].to] != kFar) way_out[motor] = true;
            }
            first = end;
            if (there == way_out) continue;
            const Place& here = explorer.place(node);
            if (only != nullptr && !only->contains(scan_key(here, group.number))) continue;
            const View view = explorer.view_after(here, group);
            ImageSet images = group.images & explorer.allowed(here) & ~target.images(view);
            if (target.from != nullptr) images &= images_where(*target.from, view);
            const bool only_lost = there[0] == way_out[0] && there[1] == way_out[1];
            if (only_lost) images &= images_of_lost_link();
            if (images.any()) return {node, &group, images, counter};
        }
    }
    return {};
}

std::vector<CourseScan> course_to(const Explorer& explorer, const Stuck& stuck) {
    std::vector<CourseScan> course = explorer.course_to_node(stuck.node);
    course.push_back(explorer.scan_of(explorer.place(stuck.node), *stuck.group, stuck.images));
    course.back().counter = stuck.counter;
    return course;
}

}  // namespace nplc::verify
