#include "sim/midi_memory.h"

namespace nplc::sim {
namespace {

class Image {
  public:
    Image() { bytes_.fill(0xFF); }
    void put(std::uint32_t value, int size) {
        for (int i = size - 1; i >= 0; --i) bytes_[next_++] = static_cast<std::uint8_t>(value >> (8 * i));
    }
    const std::array<std::uint8_t, 256>& bytes() const { return bytes_; }

  private:
    std::array<std::uint8_t, 256> bytes_{};
    std::size_t next_ = 0;
};

}  // namespace

MidiMemory factory_memory(registers::midi::Model model, bool can, std::uint8_t imax) {
    MidiMemory memory;
    memory.address = can ? 1 : 0;
    memory.torque = imax;
    if (model == registers::midi::Model::mac23) memory.period = 800;
    return memory;
}

std::array<std::uint8_t, 256> eeprom_image(const MidiMemory& memory) {
    Image image;
    image.put(memory.address, 1);
    image.put(memory.baud_code, 1);
    image.put(static_cast<std::uint32_t>(memory.upper_stop), 4);
    image.put(static_cast<std::uint32_t>(memory.lower_stop), 4);
    image.put(memory.torque, 1);
    image.put(memory.period, 2);
    image.put(memory.unstall, 1);
    image.put(memory.ramp, 1);
    image.put(memory.standby ? 1 : 0, 1);
    image.put(memory.stops, 1);
    image.put(memory.tolerance, 1);
    image.put(static_cast<std::uint32_t>(memory.position), 4);
    return image.bytes();
}

}  // namespace nplc::sim
