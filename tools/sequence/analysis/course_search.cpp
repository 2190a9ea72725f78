#include "course_search.h"

#include "walk.h"

namespace nplc::verify {
namespace {

/// The first scan that has wanted images ends the course.
template <class Wanted>
std::optional<Way> first_way(const Explorer& explorer, Excluded& excluded, const Wanted& wanted) {
    std::optional<Way> way;
    Walk walk(explorer, &excluded);
    walk.begin_at_power_up(0);
    walk.all([&](const Walk::Scan& scan) {
        if (way) return;
        const ImageSet images = wanted(scan);
        if (images.any()) {
            way = Way{.scans = scan.course(images)};
        } else {
            scan.go_on(0);
        }
    });
    return way;
}

/// What a scan does to a deadline.
struct Lateness {
    ImageSet pending;  ///< images after which it runs
    ImageSet other;
    ImageSet late;  ///< images with which the property breaks, if the time has passed
};

Lateness lateness_of(const Property& property, const View& view, const ImageSet& images, bool is_pending) {
    const ImageSet then = images_where(property.then, view);
    const ImageSet condition = images_where(property.condition, view);
    if (property.form == Form::never_while)
        return {images & then, images & ~then, is_pending ? images & then & condition : ImageSet{}};
    const ImageSet pending = images & ~then & (is_pending ? ~ImageSet{} : condition);
    return {pending, images & ~pending, pending};
}

Way late(std::vector<CourseScan> scans, const Property& property) {
    const bool is_hold = property.form == Form::never_while;
    Overdue overdue{.from = scans.size() - 1,
                    .to = is_hold ? scans.size() - 1 : scans.size(),
                    .more_than_ms = property.within_ms - (is_hold ? 1U : 0U)};
    while (!scans[overdue.from].begins) --overdue.from;
    return {.scans = std::move(scans), .overdue = overdue};
}

}  // namespace

std::optional<Way> way_to_target(const Explorer& explorer, const Target& target, Excluded& excluded) {
    return first_way(explorer, excluded, [&](const Walk::Scan& scan) {
        const Place& from = explorer.place(scan.edge.from);
        return scan.images() & target.images(explorer.view_after(from, explorer.group_of(scan.edge)));
    });
}

std::optional<Way> way_to_stuck(const Explorer& explorer, const Stuck& stuck, Excluded& excluded) {
    return first_way(explorer, excluded, [&](const Walk::Scan& scan) {
        const bool is_there = scan.edge.from == stuck.node && scan.edge.group == stuck.group->number &&
                              explorer.place(scan.edge.to).counter == stuck.counter;
        return is_there ? scan.images() & stuck.images : ImageSet{};
    });
}

std::optional<Way> late_way(const Explorer& explorer, const Property& property, bool cuts,
                            Excluded& excluded) {
    std::optional<Way> way;
    Walk walk(explorer, &excluded);
    walk.begin_at_power_up(0);
    walk.all([&](const Walk::Scan& scan) {
        const bool is_cut = explorer.place(scan.edge.to).motor == Place::Motor::cut;
        if (way || (is_cut && !cuts)) return;
        const View view = explorer.view_after(explorer.place(scan.edge.from), explorer.group_of(scan.edge));
        const bool is_pending = scan.memory != 0;
        const Lateness does = lateness_of(property, view, scan.images(), is_pending);
        if (does.late.any() && scan.may_miss(!is_pending)) {
            std::vector<CourseScan> scans = scan.course(does.late);
            scans.back().begins = !is_pending;
            way = late(std::move(scans), property);
            return;
        }
        scan.go_on(does.pending, 1);
        scan.go_on(does.other, 0);
    });
    return way;
}

}  // namespace nplc::verify
