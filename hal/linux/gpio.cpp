#include "hal_linux/gpio.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

#include "gpio_chip.h"

namespace nplc::hal_linux {
namespace {

struct Place {
    std::string chip;
    unsigned offset = 0;
    std::string problem{};
};

std::string path_of(const std::string& chip) {
    return chip.starts_with('/') ? chip : "/dev/" + chip;
}

/// By name, or CHIP:OFFSET; a line's name may have a colon in it too.
Place place_of(const std::string& where) {
    if (where.empty()) return {{}, 0, "no line is named; write gpiochip0:17 or a line's name"};
    const std::size_t colon = where.rfind(':');
    unsigned offset = 0;
    const char* end = where.data() + where.size();
    const bool has_offset = colon != std::string::npos && colon > 0 &&
                            std::from_chars(where.data() + colon + 1, end, offset).ptr == end &&
                            colon + 1 < where.size();
    if (const auto found = has_offset ? std::nullopt : find_line(where)) return {found->chip, found->offset};
    if (!has_offset)
        return {
            {},
            0,
            "no chip has a line of the name '" + where + "'; `gpioinfo` lists them, or write gpiochip0:17"};
    Place place{path_of(where.substr(0, colon)), offset};
    int error = 0;
    const unsigned count = lines_of(place.chip, error);
    if (error == ENOENT)
        place.problem = "there is no " + place.chip + "; `gpiodetect` lists the chips";
    else if (error == EACCES)
        place.problem = "you may not use " + place.chip + "; join the group that may (often gpio)";
    else if (error != 0)
        place.problem = place.chip + ": " + std::strerror(error);
    else if (offset >= count)
        place.problem = place.chip + " has lines 0 to " + std::to_string(count - 1);
    return place;
}

std::string refusal(const ChipWanted& wanted, const ChipRequested& answer) {
    const std::string line = wanted.chip + ":" + std::to_string(wanted.lines[answer.line].offset);
    if (answer.error == EBUSY)
        return "a line of " + wanted.chip + " is in use by another program or driver; `gpioinfo` names it";
    return line + ": " + std::strerror(answer.error);
}

}  // namespace

struct GpioBits::Part {
    ChipWanted wanted{};
    std::vector<std::size_t> bits{};  ///< of each line
    std::unique_ptr<ChipRequest> request{};

    unsigned of(unsigned levels) const {
        unsigned own = 0;
        for (std::size_t i = 0; i < bits.size(); ++i) own |= ((levels >> bits[i]) & 1U) << i;
        return own;
    }
    unsigned from(unsigned own) const {
        unsigned levels = 0;
        for (std::size_t i = 0; i < bits.size(); ++i) levels |= ((own >> i) & 1U) << bits[i];
        return levels;
    }
};

GpioBits::Part& GpioBits::part_of(std::vector<Part>& parts, const std::string& chip,
                                  const std::string& consumer) {
    for (Part& part : parts) {
        if (part.wanted.chip == chip) return part;
    }
    Part& part = parts.emplace_back();
    part.wanted.chip = chip;
    part.wanted.consumer = consumer;
    return part;
}

GpioBits::GpioBits() = default;
GpioBits::~GpioBits() = default;

std::string GpioBits::take(const Wanted& wanted) {
    std::vector<Part> parts;
    for (std::size_t bit = 0; bit < wanted.lines.size(); ++bit) {
        const auto& line = wanted.lines[bit];
        if (!line) continue;
        const Place place = place_of(line->where);
        if (!place.problem.empty()) return place.problem;
        Part& part = part_of(parts, place.chip, wanted.consumer);
        for (const ChipLine& other : part.wanted.lines) {
            if (other.offset == place.offset) return line->where + " is named twice";
        }
        part.wanted.lines.push_back({place.offset, line->active_low, line->bias});
        part.bits.push_back(bit);
    }
    for (Part& part : parts) {
        if (wanted.outputs) part.wanted.outputs = part.of(*wanted.outputs);
        ChipRequested answer = request_lines(part.wanted);
        if (answer.request == nullptr) return refusal(part.wanted, answer);
        part.request = std::move(answer.request);
    }
    parts_ = std::move(parts);
    return {};
}

std::optional<std::uint8_t> GpioBits::levels() {
    unsigned all = 0;
    for (Part& part : parts_) {
        const std::optional<unsigned> own = part.request->levels();
        if (!own) return std::nullopt;
        all |= part.from(*own);
    }
    return static_cast<std::uint8_t>(all);
}

bool GpioBits::set(std::uint8_t levels) {
    bool all = true;
    for (Part& part : parts_) all = part.request->set(part.of(levels)) && all;
    return all;
}

std::vector<int> GpioBits::descriptors() const {
    std::vector<int> all;
    for (const Part& part : parts_) {
        const std::vector<int> own = part.request->descriptors();
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

void GpioBits::take_edges() {
    for (Part& part : parts_) part.request->take_edges();
}

std::uint8_t GpioInputs::read() {
    const std::optional<std::uint8_t> levels = bits_.levels();
    lost_ = lost_ || !levels;
    return lost_ ? 0 : *levels;
}

}  // namespace nplc::hal_linux
