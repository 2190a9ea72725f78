#include "registers/family.h"

/// JVL's MAC motors: they execute a sequence's orders directly.
namespace nplc::registers {

const DriveFamily& jvl_family();

namespace {

class JvlFamily final : public DriveFamily {
  public:
    std::string_view name() const override { return "JVL"; }
    std::span<const DriveModel> models() const override;
    bool is_translated() const override { return false; }
};

constinit const JvlFamily kFamily;

constexpr DriveModel model(Model map, std::string_view name) {
    return {&kFamily, static_cast<std::uint8_t>(map), 0, map, name, name};
}

constexpr DriveModel kModels[] = {model(Model::mac50, "MAC50"), model(Model::mac95, "MAC95"),
                                  model(Model::mac140, "MAC140"), model(Model::mac141, "MAC141"),
                                  model(Model::mac800, "MAC800")};

std::span<const DriveModel> JvlFamily::models() const {
    return kModels;
}

}  // namespace

const DriveFamily& jvl_family() {
    return kFamily;
}

}  // namespace nplc::registers
