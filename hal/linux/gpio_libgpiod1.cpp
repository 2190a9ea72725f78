#include <gpiod.h>

#include <array>
#include <cerrno>
#include <cstddef>

#include "gpio_chip.h"

namespace nplc::hal_linux {
namespace {

using Chip = std::unique_ptr<gpiod_chip, decltype(&gpiod_chip_close)>;

Chip open_chip(const std::string& path) {
    return {gpiod_chip_open(path.c_str()), &gpiod_chip_close};
}

std::string text(const char* words) {
    return words == nullptr ? "" : words;
}

int flags_of(const ChipLine& line) {
    int flags = line.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
    switch (line.bias) {
        case GpioBias::as_is:
            break;
        case GpioBias::off:
            flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
            break;
        case GpioBias::pull_up:
            flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
            break;
        case GpioBias::pull_down:
            flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
            break;
    }
    return flags;
}

/// In this generation the lines of one request share their flags, so each line gets its own request.
class Request final : public ChipRequest {
  public:
    explicit Request(Chip chip) : chip_(std::move(chip)) {}
    ~Request() override {
        for (gpiod_line* line : lines_) gpiod_line_release(line);
    }

    bool add(const ChipLine& wanted, const ChipWanted& all, std::size_t bit) {
        gpiod_line* line = gpiod_chip_get_line(chip_.get(), wanted.offset);
        if (line == nullptr) return false;
        const gpiod_line_request_config config{.consumer = all.consumer.c_str(),
                                               .request_type = all.outputs
                                                                   ? GPIOD_LINE_REQUEST_DIRECTION_OUTPUT
                                                                   : GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES,
                                               .flags = flags_of(wanted)};
        const int level = all.outputs ? static_cast<int>((*all.outputs >> bit) & 1U) : 0;
        if (gpiod_line_request(line, &config, level) != 0) return false;
        lines_.push_back(line);
        return true;
    }

    std::optional<unsigned> levels() override {
        unsigned levels = 0;
        for (std::size_t bit = 0; bit < lines_.size(); ++bit) {
            const int level = gpiod_line_get_value(lines_[bit]);
            if (level < 0) return std::nullopt;
            levels |= static_cast<unsigned>(level) << bit;
        }
        return levels;
    }

    bool set(unsigned levels) override {
        bool all = true;
        for (std::size_t bit = 0; bit < lines_.size(); ++bit)
            all = gpiod_line_set_value(lines_[bit], static_cast<int>((levels >> bit) & 1U)) == 0 && all;
        return all;
    }

    std::vector<int> descriptors() const override {
        std::vector<int> all;
        for (gpiod_line* line : lines_) all.push_back(gpiod_line_event_get_fd(line));
        return all;
    }

    Edges take_edges(std::size_t descriptor) override {
        std::array<gpiod_line_event, kEdgesAtOnce> events;
        const int count = gpiod_line_event_read_multiple(lines_[descriptor], events.data(), events.size());
        if (count <= 0) return {};
        const auto got = static_cast<std::size_t>(count);
        const bool level = events[got - 1].event_type == GPIOD_LINE_EVENT_RISING_EDGE;
        return {1U << descriptor, (level ? 1U : 0U) << descriptor, got < kEdgesAtOnce};
    }

  private:
    Chip chip_;
    std::vector<gpiod_line*> lines_;
};

}  // namespace

ChipRequested request_lines(const ChipWanted& wanted) {
    Chip chip = open_chip(wanted.chip);
    if (chip == nullptr) return {nullptr, errno};
    auto request = std::make_unique<Request>(std::move(chip));
    for (std::size_t i = 0; i < wanted.lines.size(); ++i) {
        if (!request->add(wanted.lines[i], wanted, i)) return {nullptr, errno, i};
    }
    return {std::move(request), 0};
}

std::vector<LineInfo> lines_of(const std::string& path, int& error) {
    const Chip chip = open_chip(path);
    error = chip == nullptr ? errno : 0;
    std::vector<LineInfo> all;
    for (unsigned i = 0; chip != nullptr && i < gpiod_chip_num_lines(chip.get()); ++i) {
        gpiod_line* line = gpiod_chip_get_line(chip.get(), i);
        if (line == nullptr) {
            all.push_back({});
            continue;
        }
        all.push_back(
            {text(gpiod_line_name(line)), gpiod_line_is_used(line), text(gpiod_line_consumer(line))});
    }
    return all;
}

}  // namespace nplc::hal_linux
