#include "monitor.h"

#include "walk.h"

namespace nplc::verify {
namespace {

using Memory = std::uint16_t;

/// Images of a scan that break the property, and what is remembered after the others.
struct Step {
    ImageSet breaking;
    ImageSet first;   ///< after which bit 0 is remembered
    ImageSet second;  ///< bit 1
};

Step step_of(const Property& property, const View& before, const View& after, Memory memory) {
    const ImageSet c = images_where(property.condition, after);
    const ImageSet d = images_where(property.then, after);
    const auto remembered = [](bool bit) { return bit ? ~ImageSet{} : ImageSet{}; };
    const ImageSet first = remembered((memory & 1U) != 0);
    const ImageSet second = remembered((memory & 2U) != 0);
    switch (property.form) {
        case Form::only_after:
            return {c & ~d & ~first, first | d, {}};
        case Form::stays: {
            const ImageSet within = (first | c) & ~d;
            return {within & ~images_where(property.third, after), within, {}};
        }
        case Form::changes_only_in:
            return {(c ^ first) & ~d & ~second, c, d};
        case Form::scan_ends:
            return {images_where(property.condition, before) & ~d, {}, {}};
        case Form::followed_by:
            return {first & d & ~images_where(property.third, after), c, {}};
        default:
            return {};
    }
}

/// Before the first scan: inputs off, step 0, all else 0.
Memory at_power_up(const Property& property) {
    if (property.form != Form::changes_only_in) return 0;
    return static_cast<Memory>((holds(property.condition, 0, {}) ? 1U : 0U) |
                               (holds(property.then, 0, {}) ? 2U : 0U));
}

}  // namespace

bool is_remembered(Form form) {
    return form >= Form::only_after;
}

std::optional<std::vector<CourseScan>> breaking_course(const Explorer& explorer, const Property& property) {
    std::optional<std::vector<CourseScan>> course;
    Walk walk(explorer, at_power_up(property));
    walk.all([&](const Explorer::Edge& edge, const ImageSet& images, Memory memory, const auto& go_on,
                 const auto& show) {
        if (course) return;
        const Place from = explorer.place(edge.from);
        const View after = explorer.view_after(from, explorer.group_of(edge));
        const Step step = step_of(property, Explorer::view_of(from), after, memory);
        if ((images & step.breaking).any()) {
            course = show(images & step.breaking);
            return;
        }
        go_on(images & ~step.first & ~step.second, 0);
        go_on(images & step.first & ~step.second, 1);
        go_on(images & ~step.first & step.second, 2);
        go_on(images & step.first & step.second, 3);
    });
    return course;
}

}  // namespace nplc::verify
