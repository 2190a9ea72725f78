#include "shrink.h"

#include <algorithm>
#include <array>

namespace nplc::soak {
namespace {

using namespace std::chrono_literals;

Course shifted_to_begin(Course course) {
    if (course.empty()) return course;
    const Time earlier = course.front().at - kFirst;
    for (Disturbance& what : course) what.at -= earlier;
    return course;
}

/// The last 4, 8, 16, ... of them, from the beginning on.
Course tail_that_fails(const Course& course, const Fails& fails) {
    for (std::size_t count = 4; count < course.size(); count *= 2) {
        const Course tail =
            shifted_to_begin({course.end() - static_cast<std::ptrdiff_t>(count), course.end()});
        if (fails(tail)) return tail;
    }
    return course;
}

Course without(const Course& course, std::size_t begin, std::size_t end) {
    Course rest(course.begin(), course.begin() + static_cast<std::ptrdiff_t>(begin));
    rest.insert(rest.end(), course.begin() + static_cast<std::ptrdiff_t>(end), course.end());
    return rest;
}

/// One part of `parts` left out, if it can be.
bool leave_out(Course& course, std::size_t parts, const Fails& fails) {
    const std::size_t size = (course.size() + parts - 1) / parts;
    for (std::size_t begin = 0; begin < course.size(); begin += size) {
        const Course rest = without(course, begin, std::min(begin + size, course.size()));
        if (!fails(rest)) continue;
        course = rest;
        return true;
    }
    return false;
}

void leave_out_what_is_not_needed(Course& course, const Fails& fails) {
    std::size_t parts = 2;
    while (!course.empty()) {
        if (leave_out(course, parts, fails)) {
            parts = std::max<std::size_t>(parts - 1, 2);
        } else if (parts >= course.size()) {
            return;
        } else {
            parts = std::min(2 * parts, course.size());
        }
    }
}

/// The pause before `which` no longer than `longest`.
Course with_pause(const Course& course, std::size_t which, Time longest) {
    const Time before = which == 0 ? Time(0) : course[which - 1].at;
    const Time earlier = course[which].at - before - longest;
    Course result = course;
    for (std::size_t i = which; earlier > Time(0) && i < result.size(); ++i) result[i].at -= earlier;
    return result;
}

/// All at once: what is played often had better be short.
void cap_pauses(Course& course, const Fails& fails) {
    for (const Time longest : {1s, 5s, 15s}) {
        Course shorter = course;
        for (std::size_t i = 0; i < shorter.size(); ++i) shorter = with_pause(shorter, i, longest);
        if (shorter == course || !fails(shorter)) continue;
        course = shorter;
        return;
    }
}

void shorten_pauses(Course& course, const Fails& fails) {
    constexpr std::array<Time, 9> kPauses{1ms, 10ms, 50ms, 200ms, 500ms, 1s, 2s, 5s, 15s};
    for (std::size_t i = 0; i < course.size(); ++i) {
        for (const Time pause : kPauses) {
            const Course shorter = with_pause(course, i, pause);
            if (shorter == course) break;
            if (!fails(shorter)) continue;
            course = shorter;
            break;
        }
    }
}

}  // namespace

Course shrink(const Course& course, const Fails& fails) {
    Course shortest = tail_that_fails(course, fails);
    cap_pauses(shortest, fails);
    leave_out_what_is_not_needed(shortest, fails);
    shorten_pauses(shortest, fails);
    leave_out_what_is_not_needed(shortest, fails);
    return shortest;
}

}  // namespace nplc::soak
