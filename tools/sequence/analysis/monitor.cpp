#include "monitor.h"

#include <unordered_map>

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

/// What a property's conditions take, by what a scan ends in.
class Conditions {
  public:
    struct Images {
        ImageSet first, then, third;
    };

    explicit Conditions(const Property& property) : property_(property) {}

    const Images& in(const View& view) {
        const std::uint32_t key = view.step | (std::uint32_t{view.outputs} << 6U) |
                                  (view.timer_zero ? 1U << 10U : 0U) | (view.counter_zero ? 1U << 11U : 0U) |
                                  (view.moving ? 1U << 12U : 0U);
        const auto [found, is_new] = known_.try_emplace(key);
        if (is_new) {
            found->second = {images_where(property_.condition, view), images_where(property_.then, view),
                             images_where(property_.third, view)};
        }
        return found->second;
    }

  private:
    const Property& property_;
    std::unordered_map<std::uint32_t, Images> known_;
};

Step step_of(Form form, const ImageSet& begun, const Conditions::Images& ended, Memory memory) {
    const ImageSet& c = ended.first;
    const ImageSet& d = ended.then;
    const auto remembered = [](bool bit) { return bit ? ~ImageSet{} : ImageSet{}; };
    const ImageSet first = remembered((memory & 1U) != 0);
    const ImageSet second = remembered((memory & 2U) != 0);
    switch (form) {
        case Form::only_after:
            return {c & ~d & ~first, first | d, {}};
        case Form::stays: {
            const ImageSet within = (first | c) & ~d;
            return {within & ~ended.third, within, {}};
        }
        case Form::changes_only_in:
            return {(c ^ first) & ~d & ~second, c, d};
        case Form::scan_ends:
            return {begun & ~d, {}, {}};
        case Form::followed_by:
            return {first & d & ~ended.third, c, {}};
        case Form::only_from:
            return {c & ~begun & ~first, first | begun, {}};
        case Form::only_after_both: {
            const ImageSet both = first | (second & ended.third);
            return {c & ~both, both, d};
        }
        default:
            return {};
    }
}

/// The images at a scan's beginning for which the condition of the form holds.
ImageSet begun_in(Form form, Conditions& conditions, const View& before) {
    if (form == Form::scan_ends) return conditions.in(before).first;
    return form == Form::only_from ? conditions.in(before).then : ImageSet{};
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

std::optional<std::vector<CourseScan>> breaking_course(const Explorer& explorer, const Property& property,
                                                       Excluded* excluded) {
    std::optional<std::vector<CourseScan>> course;
    Conditions conditions(property);
    Walk walk(explorer, excluded);
    walk.begin_at_power_up(at_power_up(property));
    walk.all([&](const Walk::Scan& scan) {
        if (course) return;
        const Place& from = explorer.place(scan.edge.from);
        const ImageSet begun = begun_in(property.form, conditions, from.view());
        const View after = explorer.view_after(from, explorer.group_of(scan.edge));
        const Step step = step_of(property.form, begun, conditions.in(after), scan.memory);
        const ImageSet images = scan.images();
        if ((images & step.breaking).any()) {
            course = scan.course(images & step.breaking);
            return;
        }
        scan.go_on(images & ~step.first & ~step.second, 0);
        scan.go_on(images & step.first & ~step.second, 1);
        scan.go_on(images & ~step.first & step.second, 2);
        scan.go_on(images & step.first & step.second, 3);
    });
    return course;
}

}  // namespace nplc::verify
