#include <array>

#include "registers/family.h"
#include "registers/family_list.h"
#include "registers/names.h"

namespace nplc::registers {

#define NPLC_DECLARE(family) const DriveFamily& family##_family();
NPLC_FAMILIES(NPLC_DECLARE)
#undef NPLC_DECLARE

namespace {

template <typename Predicate>
const DriveModel* first_model(Predicate is_wanted) {
    for (const DriveFamily* family : families()) {
        for (const DriveModel& model : family->models()) {
            if (is_wanted(model)) return &model;
        }
    }
    return nullptr;
}

}  // namespace

std::span<const DriveFamily* const> families() {
#define NPLC_ADDRESS(family) &family##_family(),
    static const std::array kAll{NPLC_FAMILIES(NPLC_ADDRESS)};
#undef NPLC_ADDRESS
    return kAll;
}

const DriveModel* find_drive(std::string_view name) {
    return first_model([name](const DriveModel& model) { return same_name(model.name, name); });
}

const DriveModel* find_drive_of_program(std::string_view name) {
    return first_model([name](const DriveModel& model) {
        return same_name(model.program_name, name) ||
               (!model.program_alias.empty() && same_name(model.program_alias, name));
    });
}

const DriveModel* drive_of_kind(std::uint32_t motor_kind) {
    return first_model([motor_kind](const DriveModel& model) { return model.motor_kind == motor_kind; });
}

}  // namespace nplc::registers
