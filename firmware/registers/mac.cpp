#include "registers/mac.h"

#include "registers/names.h"
#include "registers/scale.h"
#include "tables.h"

namespace nplc::registers {
namespace {

struct ModelName {
    Model model;
    std::string_view name;
};

constexpr ModelName kModels[] = {
    {Model::mac50, "MAC50"},   {Model::mac95, "MAC95"},   {Model::mac140, "MAC140"},
    {Model::mac141, "MAC141"}, {Model::mac800, "MAC800"},
};

/// Up to this number a register has the same meaning on every motor, whatever its name.
constexpr std::uint8_t kLastCommon = 88;

const Register* find_in(std::span<const Register> map, std::string_view name) {
    for (const Register& entry : map) {
        if (same_name(entry.name, name)) return &entry;
    }
    return nullptr;
}

}  // namespace

std::span<const Register> map_of(Model model) {
    return model == Model::mac800 ? mac800_map() : small_map();
}

const Register* find(Model model, std::uint8_t number) {
    for (const Register& entry : map_of(model)) {
        if (entry.number == number) return &entry;
    }
    return nullptr;
}

const Register* find(Model model, std::string_view name) {
    if (const Register* entry = find_in(map_of(model), name)) return entry;
    if (model != Model::mac800) return nullptr;
    const Register* common = find_in(small_map(), name);
    return common != nullptr && common->number <= kLastCommon ? find(model, common->number) : nullptr;
}

Scale scale_of(Model model) {
    const ExactScale exact = exact_scale_of(model);
    const auto [samples, seconds] = exact.samples_per_second;
    return {.counts_per_rev = static_cast<std::int32_t>(exact.counts_per_rev),
            .samples_per_second = static_cast<double>(samples) / static_cast<double>(seconds)};
}

std::optional<Model> model_of(std::string_view name) {
    for (const ModelName& entry : kModels) {
        if (same_name(entry.name, name)) return entry.model;
    }
    return std::nullopt;
}

std::string_view name_of(Model model) {
    for (const ModelName& entry : kModels) {
        if (entry.model == model) return entry.name;
    }
    return {};
}

}  // namespace nplc::registers
