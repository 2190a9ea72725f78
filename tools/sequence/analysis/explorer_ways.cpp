#include <algorithm>
#include <span>
#include <vector>

#include "explorer.h"

namespace nplc::verify {

const Explorer::Edge& Explorer::first_edge_with(const Group& group) const {
    const std::span<const Edge> own = edges_from(first_use(group));
    return *std::find_if(own.begin(), own.end(),
                         [&](const Edge& edge) { return edge.group == group.number; });
}

const EdgesBack& Explorer::edges_back() {
    if (!back_) back_.emplace(edges(), size());
    return *back_;
}

CourseScan Explorer::scan_of(const Place& place, const Group& group, const ImageSet& images) const {
    CourseScan scan;
    scan.place = place;
    scan.group = &group;
    scan.images = images;
    scan.view = view_after(place, group);
    scan.idle = scans_.is_idle(place, group);
    const Place next = scans_.after(place, group);
    scan.counter = next.counter;
    scan.delay = scans_.delay_of(place, group, next);
    return scan;
}

std::vector<CourseScan> Explorer::course_to_node(Node node) const {
    std::vector<CourseScan> course;
    for (; states_.origin(node).parent != kNone; node = states_.origin(node).parent) {
        const States::Origin& origin = states_.origin(node);
        const Place& from = place(origin.parent);
        const Place& to = place(node);
        const Group& group = machine().group(origin.group);
        const auto split = scans_.parts(from, view_after(from, group), group.images & allowed(from));
        CourseScan scan = scan_of(from, group, Successors::narrowed(split[origin.part].images, to));
        scan.counter = to.counter;
        scan.delay = scans_.delay_of(from, group, to);
        scan.next_runs = to.runs;
        course.push_back(scan);
    }
    std::reverse(course.begin(), course.end());
    return course;
}

CourseScan Explorer::scan_of(const Edge& edge, const ImageSet& images) const {
    CourseScan scan = scan_of(place(edge.from), group_of(edge), images);
    scan.counter = place(edge.to).counter;
    scan.delay = scans_.delay_of(place(edge.from), group_of(edge), place(edge.to));
    scan.next_runs = place(edge.to).runs;
    return scan;
}

std::vector<CourseScan> Explorer::course_to(std::size_t target) const {
    const Hit& hit = hits_[target];
    if (!hit.found()) return {};
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

}  // namespace nplc::verify
