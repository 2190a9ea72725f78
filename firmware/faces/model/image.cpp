#include "faces/image.h"

#include <cstring>
#include <string_view>
#include <thread>
#include <type_traits>

#include "faces/image_board.h"
#include "registers/settings.h"

namespace nplc::faces {
namespace {

constexpr std::array<std::string_view, kMotorItems> kRegisters{
    "P_IST",  "V_IST",  "ERR_STAT", "MODE_REG", "VF_OUT", "I2T",
    "I2TLIM", "FLWERR", "P_SOLL",   "V_SOLL",   "T_SOLL", "DEGC",
};

}  // namespace

registers::Model model_of(const AxisImage& image) {
    const bool is_800 = image.setting(registers::gateway::Setting::motor_is_mac800) != 0 &&
                        image.setting(registers::gateway::Setting::motor_kind) == 0;
    return is_800 ? registers::Model::mac800 : registers::Model::mac140;
}

const registers::Register* register_of(MotorItem item, registers::Model model) {
    return registers::find(model, kRegisters[static_cast<std::size_t>(item)]);
}

/// A reader that reads any word of an image also reads that the write has begun.
void ImageBoard::put(const AxisImage& image) {
    std::array<std::uint64_t, kWords> words{};
    static_assert(std::is_trivially_copyable_v<AxisImage>);
    std::memcpy(words.data(), &image, sizeof image);
    const std::uint64_t turn = turn_.load(std::memory_order_relaxed);
    turn_.store(turn + 1, std::memory_order_relaxed);
    for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
    turn_.store(turn + 2, std::memory_order_release);
    number_.store(image.number, std::memory_order_release);
}

AxisImage ImageBoard::get() const {
    std::array<std::uint64_t, kWords> words{};
    for (;;) {
        const std::uint64_t before = turn_.load(std::memory_order_acquire);
        for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
        const std::uint64_t after = turn_.load(std::memory_order_relaxed);
        if (before == after && before % 2 == 0) break;
        std::this_thread::yield();
    }
    AxisImage image;
    std::memcpy(static_cast<void*>(&image), words.data(), sizeof image);
    return image;
}

}  // namespace nplc::faces
