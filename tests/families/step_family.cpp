#include "registers/family.h"

namespace nplc::registers {

const DriveFamily& step_family();

namespace {

constexpr std::uint32_t kBauds[] = {9'600};

/// STEP1: a step drive on an ASCII line, which goes to positions and stops.
class StepFamily final : public DriveFamily {
  public:
    std::string_view name() const override { return "ASCII"; }
    std::span<const DriveModel> models() const override;
    std::span<const std::uint32_t> bauds() const override { return kBauds; }

    /// Bits 6..5 are the mode, 4..0 a selection or a number (001 §5.2.1.4).
    Refusal refuses_command(const DriveModel&, std::uint8_t command) const override {
        constexpr unsigned kInit = 0;
        constexpr unsigned kPosition = 2;
        constexpr unsigned kNumber = 3;
        const unsigned mode = command >> 5U;
        const unsigned low = command & 0x1FU;
        const bool is_known = mode == kInit || (mode == kPosition && low < 8) || (mode == kNumber && low < 2);
        return is_known ? Refusal() : "a STEP1 only stops, goes to P1 to P8, and resets its error";
    }
    Refusal refuses_write(const DriveModel&, std::uint8_t reg, bool longword, std::uint32_t) const override {
        const bool is_place = reg >= P1 && reg < V1 && (reg - P1) % 2 == 0 && longword;
        return is_place || reg == MODE_REG ? Refusal() : "a STEP1 has no registers but P1 to P8";
    }
};

constinit const StepFamily kFamily;
constexpr DriveModel kModels[] = {{.family = &kFamily,
                                   .index = 0,
                                   .motor_kind = 4,
                                   .map = Model::mac140,
                                   .name = "STEP1",
                                   .program_name = "STEP1"}};

std::span<const DriveModel> StepFamily::models() const {
    return kModels;
}

}  // namespace

const DriveFamily& step_family() {
    return kFamily;
}

}  // namespace nplc::registers
