#include <gpiod.h>

#include <array>
#include <cerrno>

#include "gpio_chip.h"

namespace nplc::hal_linux {
namespace {

template <class T, void (*kFree)(T*)>
struct Free {
    void operator()(T* object) const { kFree(object); }
};
template <class T, void (*kFree)(T*)>
using Owned = std::unique_ptr<T, Free<T, kFree>>;

using Chip = Owned<gpiod_chip, gpiod_chip_close>;
using ChipInfo = Owned<gpiod_chip_info, gpiod_chip_info_free>;
using Info = Owned<gpiod_line_info, gpiod_line_info_free>;
using Settings = Owned<gpiod_line_settings, gpiod_line_settings_free>;
using LineConfig = Owned<gpiod_line_config, gpiod_line_config_free>;
using RequestConfig = Owned<gpiod_request_config, gpiod_request_config_free>;
using LineRequest = Owned<gpiod_line_request, gpiod_line_request_release>;
using Events = Owned<gpiod_edge_event_buffer, gpiod_edge_event_buffer_free>;

using Values = std::array<gpiod_line_value, kMostLines>;

gpiod_line_value value_of(unsigned levels, std::size_t bit) {
    return ((levels >> bit) & 1U) != 0 ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}

gpiod_line_bias bias_of(GpioBias bias) {
    switch (bias) {
        case GpioBias::off:
            return GPIOD_LINE_BIAS_DISABLED;
        case GpioBias::pull_up:
            return GPIOD_LINE_BIAS_PULL_UP;
        case GpioBias::pull_down:
            return GPIOD_LINE_BIAS_PULL_DOWN;
        case GpioBias::as_is:
            break;
    }
    return GPIOD_LINE_BIAS_AS_IS;
}

bool add(gpiod_line_config* config, const ChipLine& line, const ChipWanted& all, std::size_t bit) {
    const Settings settings(gpiod_line_settings_new());
    if (settings == nullptr) return false;
    gpiod_line_settings_set_active_low(settings.get(), line.active_low);
    bool taken = gpiod_line_settings_set_bias(settings.get(), bias_of(line.bias)) == 0;
    if (all.outputs) {
        taken = taken &&
                gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_OUTPUT) == 0 &&
                gpiod_line_settings_set_output_value(settings.get(), value_of(*all.outputs, bit)) == 0;
    } else {
        taken = taken && gpiod_line_settings_set_direction(settings.get(), GPIOD_LINE_DIRECTION_INPUT) == 0 &&
                gpiod_line_settings_set_edge_detection(settings.get(), GPIOD_LINE_EDGE_BOTH) == 0;
    }
    return taken && gpiod_line_config_add_line_settings(config, &line.offset, 1, settings.get()) == 0;
}

class Request final : public ChipRequest {
  public:
    Request(LineRequest request, const std::vector<ChipLine>& lines)
        : request_(std::move(request)), events_(gpiod_edge_event_buffer_new(kEdgesAtOnce)), lines_(lines) {}

    std::optional<unsigned> levels() override {
        Values values{};
        if (gpiod_line_request_get_values(request_.get(), values.data()) != 0) return std::nullopt;
        unsigned levels = 0;
        for (std::size_t bit = 0; bit < lines_.size(); ++bit)
            levels |= (values[bit] == GPIOD_LINE_VALUE_ACTIVE ? 1U : 0U) << bit;
        return levels;
    }

    bool set(unsigned levels) override {
        Values values{};
        for (std::size_t bit = 0; bit < lines_.size(); ++bit) values[bit] = value_of(levels, bit);
        return gpiod_line_request_set_values(request_.get(), values.data()) == 0;
    }

    std::vector<int> descriptors() const override { return {gpiod_line_request_get_fd(request_.get())}; }

    Edges take_edges(std::size_t /*descriptor*/) override {
        const int got = gpiod_line_request_read_edge_events(request_.get(), events_.get(), kEdgesAtOnce);
        if (got <= 0) return {};
        const auto count = static_cast<std::size_t>(got);
        Edges edges{.all = count < kEdgesAtOnce};
        for (std::size_t i = 0; i < count; ++i) add(edges, i);
        return edges;
    }

  private:
    void add(Edges& edges, std::size_t number) const {
        gpiod_edge_event* event = gpiod_edge_event_buffer_get_event(events_.get(), number);
        const unsigned offset = gpiod_edge_event_get_line_offset(event);
        const bool level = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
        for (std::size_t bit = 0; bit < lines_.size(); ++bit) {
            if (lines_[bit].offset != offset) continue;
            edges.lines |= 1U << bit;
            edges.levels = (edges.levels & ~(1U << bit)) | (level ? 1U : 0U) << bit;
        }
    }

    LineRequest request_;
    Events events_;
    std::vector<ChipLine> lines_;
};

std::string text(const char* words) {
    return words == nullptr ? "" : words;
}

}  // namespace

ChipRequested request_lines(const ChipWanted& wanted) {
    const Chip chip(gpiod_chip_open(wanted.chip.c_str()));
    if (chip == nullptr) return {nullptr, errno};
    const LineConfig lines(gpiod_line_config_new());
    const RequestConfig who(gpiod_request_config_new());
    if (lines == nullptr || who == nullptr) return {nullptr, ENOMEM};
    gpiod_request_config_set_consumer(who.get(), wanted.consumer.c_str());
    for (std::size_t bit = 0; bit < wanted.lines.size(); ++bit) {
        if (!add(lines.get(), wanted.lines[bit], wanted, bit)) return {nullptr, errno, bit};
    }
    LineRequest request(gpiod_chip_request_lines(chip.get(), who.get(), lines.get()));
    if (request == nullptr) return {nullptr, errno};
    return {std::make_unique<Request>(std::move(request), wanted.lines), 0};
}

std::vector<LineInfo> lines_of(const std::string& path, int& error) {
    const Chip chip(gpiod_chip_open(path.c_str()));
    const ChipInfo info(chip == nullptr ? nullptr : gpiod_chip_get_info(chip.get()));
    error = info == nullptr ? errno : 0;
    std::vector<LineInfo> all;
    for (unsigned i = 0; info != nullptr && i < gpiod_chip_info_get_num_lines(info.get()); ++i) {
        const Info line(gpiod_chip_get_line_info(chip.get(), i));
        if (line == nullptr) {
            all.push_back({});
            continue;
        }
        all.push_back({text(gpiod_line_info_get_name(line.get())), gpiod_line_info_is_used(line.get()),
                       text(gpiod_line_info_get_consumer(line.get()))});
    }
    return all;
}

}  // namespace nplc::hal_linux
