#include "error_ways.h"

#include <array>
#include <span>

#include "walk.h"

namespace nplc::verify {

ErrorWays::ErrorWays(const Explorer& explorer, const Target& target)
    : explorer_(explorer), target_(target), can_(explorer.size()) {
    const ImageSet& error = images_of_error();
    scans_.reserve(explorer.edges().size());
    for (const Explorer::Edge& edge : explorer.edges()) {
        const ImageSet images = explorer.images_of(edge);
        const View view = explorer.view_after(explorer.place(edge.from), explorer.group_of(edge));
        const ImageSet hits = images & target.images(view);
        const auto hit = [&](bool in_error) {
            return (in_error ? hits & error : hits & ~error).any() ? bit(in_error) : 0U;
        };
        scans_.push_back({.calm = (images & ~error).any(),
                          .error = (images & error).any(),
                          .hits = static_cast<std::uint8_t>(hit(false) | hit(true))});
    }
    while (sweep()) {
    }
    find_stuck();
}

bool ErrorWays::sweep() {
    bool changed = false;
    for (std::size_t i = scans_.size(); i-- > 0;) {
        const Explorer::Edge& edge = explorer_.edges()[i];
        const Scan& scan = scans_[i];
        const bool calm = (scan.hits & bit(false)) != 0 || (scan.calm && can(edge.to, false));
        const bool in_error = (scan.hits & bit(true)) != 0 || (scan.error && can(edge.to, true));
        const auto now =
            static_cast<std::uint8_t>(can_[edge.from] | (calm ? 3U : 0U) | (in_error ? bit(true) : 0U));
        changed = changed || now != can_[edge.from];
        can_[edge.from] = now;
    }
    return changed;
}

/// Whether the timer still runs when the next scan begins is a matter of time: of these edges one with a way
/// is enough. What becomes of the motor is not the course's choice.
void ErrorWays::find_stuck() {
    const std::span<const Explorer::Edge> edges = explorer_.edges();
    stuck_.assign(edges.size(), 0);
    for (std::size_t first = 0; first < edges.size();) {
        const std::uint16_t counter = explorer_.place(edges[first].to).counter;
        std::array<std::uint8_t, 4> way_out{};
        const auto motor_after = [&](const Explorer::Edge& edge) {
            const Place::Motor then = explorer_.place(edge.to).motor;
            return static_cast<std::size_t>(then == Place::Motor::cut ? Place::Motor::free : then);
        };
        std::size_t end = first;
        for (; end < edges.size() && edges[end].from == edges[first].from &&
               edges[end].group == edges[first].group && explorer_.place(edges[end].to).counter == counter;
             ++end)
            way_out[motor_after(edges[end])] |= can_[edges[end].to];
        for (; first < end; ++first)
            stuck_[first] = static_cast<std::uint8_t>(~unsigned{way_out[motor_after(edges[first])]} & 3U);
    }
}

std::optional<std::vector<CourseScan>> ErrorWays::course_to_only_by_error(Excluded* excluded) const {
    std::optional<std::vector<CourseScan>> course;
    Walk walk(explorer_, excluded);
    walk.begin_at_power_up(0);
    walk.all([&](const Walk::Scan& scan) {
        if (course) return;
        const std::uint8_t stuck = stuck_[static_cast<std::size_t>(&scan.edge - explorer_.edges().data())];
        if (stuck != 0) {
            const View view =
                explorer_.view_after(explorer_.place(scan.edge.from), explorer_.group_of(scan.edge));
            ImageSet outside = scan.images() & ~target_.images(view);
            if (target_.from != nullptr) outside &= images_where(*target_.from, view);
            if ((stuck & bit(false)) == 0) outside &= images_of_error();
            if ((stuck & bit(true)) == 0) outside &= ~images_of_error();
            if (outside.any()) {
                course = scan.course(outside);
                return;
            }
        }
        scan.go_on(0);
    });
    return course;
}

}  // namespace nplc::verify
