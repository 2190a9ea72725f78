#include "hal_linux/gpio.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>

#include "gpio_chip.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;

struct Place {
    std::string chip;
    unsigned offset = 0;
    std::string problem{};
};

/// Some boards have links with a chip's older names.
std::string path_of(const std::string& chip) {
    const std::string path = chip.starts_with('/') ? chip : "/dev/" + chip;
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    return error ? path : real.string();
}

std::vector<std::string> chips() {
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator entry("/dev", error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (name.starts_with("gpiochip") && !entry->is_symlink(error)) found.push_back(entry->path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::string trouble_with(const std::string& chip, int error) {
    if (error == ENOENT) return "there is no " + chip + "; `gpiodetect` lists the chips";
    if (error == EACCES || error == EPERM)
        return "you may not use " + chip + "; join the group that may (often gpio)";
    if (error == ENOTTY || error == ENODEV || error == EINVAL) return chip + " is not a GPIO chip";
    return chip + ": " + std::strerror(error);
}

/// CHIP:OFFSET, or empty.
std::optional<Place> numbered(const std::string& where) {
    const std::size_t colon = where.rfind(':');
    if (colon == std::string::npos || colon == 0 || colon + 1 == where.size()) return std::nullopt;
    unsigned offset = 0;
    const char* end = where.data() + where.size();
    if (std::from_chars(where.data() + colon + 1, end, offset).ptr != end) return std::nullopt;
    return Place{path_of(where.substr(0, colon)), offset};
}

Place named(const std::string& name) {
    std::vector<Place> found;
    std::string refused;
    for (const std::string& chip : chips()) {
        int error = 0;
        const std::vector<LineInfo> lines = lines_of(chip, error);
        if (error == EACCES || error == EPERM) refused = trouble_with(chip, error);
        for (unsigned i = 0; i < lines.size(); ++i) {
            if (lines[i].name == name) found.push_back({chip, i});
        }
    }
    if (found.size() == 1) return found[0];
    if (found.size() > 1)
        return {{},
                0,
                "more than one line has the name '" + name + "': " + found[0].chip + ":" +
                    std::to_string(found[0].offset) + " and " + found[1].chip + ":" +
                    std::to_string(found[1].offset) + "; write one of these instead"};
    if (!refused.empty()) return {{}, 0, refused};
    return {
        {}, 0, "no chip has a line of the name '" + name + "'; `gpioinfo` lists them, or write gpiochip0:17"};
}

/// A line's name may end in a colon and digits too, so text that names no existing chip is looked up as a
/// line name.
Place place_of(const std::string& where) {
    if (where.empty()) return {{}, 0, "no line is named; write gpiochip0:17 or a line's name"};
    std::optional<Place> place = numbered(where);
    if (!place) return named(where);
    int error = 0;
    const std::size_t count = lines_of(place->chip, error).size();
    if (error == ENOENT) {
        if (Place other = named(where); other.problem.empty()) return other;
    }
    if (error != 0)
        place->problem = trouble_with(place->chip, error);
    else if (place->offset >= count)
        place->problem = place->chip + " has the lines 0 to " + std::to_string(count - 1) + ", not " +
                         std::to_string(place->offset);
    return *place;
}

std::string name_of(const ChipWanted& wanted, std::size_t line) {
    return wanted.chip + ":" + std::to_string(wanted.lines[line].offset);
}

std::string refusal(const ChipWanted& wanted, const ChipRequested& answer) {
    int error = 0;
    const std::vector<LineInfo> lines = lines_of(wanted.chip, error);
    for (std::size_t i = 0; answer.error == EBUSY && i < wanted.lines.size(); ++i) {
        const unsigned offset = wanted.lines[i].offset;
        if (offset < lines.size() && lines[offset].used)
            return name_of(wanted, i) + " is in use by '" + lines[offset].consumer +
                   "'; end that program, or free the line of that driver";
    }
    return name_of(wanted, answer.line) + ": " + std::strerror(answer.error);
}

}  // namespace

FoundLine find_line(const std::string& where) {
    const Place place = place_of(where);
    if (!place.problem.empty()) return {.problem = place.problem};
    return {.place = place.chip + ":" + std::to_string(place.offset)};
}

struct GpioBits::Part {
    ChipWanted wanted{};
    std::vector<std::size_t> bits{};  ///< of each line
    std::unique_ptr<ChipRequest> request{};
    std::size_t descriptors = 0;

    unsigned of(unsigned levels) const {
        unsigned own = 0;
        for (std::size_t i = 0; i < bits.size(); ++i) own |= ((levels >> bits[i]) & 1U) << i;
        return own;
    }
    unsigned from(unsigned own) const {
        unsigned levels = 0;
        for (; own != 0; own &= own - 1)
            levels |= 1U << bits[static_cast<std::size_t>(std::countr_zero(own))];
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
    if (wanted.lines.size() > kMostLines) return "at most 8 lines can be had at once";
    parts_.clear();
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
        part.descriptors = part.request->descriptors().size();
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

std::optional<std::uint8_t> GpioBits::take_edges(std::size_t descriptor, std::uint8_t before) {
    for (Part& part : parts_) {
        if (descriptor >= part.descriptors) {
            descriptor -= part.descriptors;
            continue;
        }
        const Edges edges = part.request->take_edges(descriptor);
        if (!edges.all) return std::nullopt;
        return static_cast<std::uint8_t>((before & ~part.from(edges.lines)) | part.from(edges.levels));
    }
    return std::nullopt;
}

void GpioInputs::look() {
    const std::optional<std::uint8_t> levels = bits_.levels();
    lost_ = lost_ || !levels;
    levels_ = lost_ ? 0 : *levels;
}

void GpioInputs::look_at(std::size_t descriptor) {
    const std::optional<std::uint8_t> levels = bits_.take_edges(descriptor, levels_);
    if (!levels || lost_) return look();
    levels_ = *levels;
}

}  // namespace nplc::hal_linux
