#include "macreg/midi/path_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/csv_row.h"
#include "macreg/midi/values.h"
#include "registers/midi_scale.h"
#include "text/text.h"

namespace nplc::macreg::midi {
namespace {

using spelling::trimmed;

constexpr std::string_view kBlanks = " \t\r\"";  // some spreadsheets quote cells
constexpr std::int64_t kTicksPerMicrosecond = reg::kTicksPerSecond / 1'000'000;

class Reader {
  public:
    explicit Reader(const Scale& scale) : scale_(scale) {}

    void take(std::string_view line, unsigned number) {
        number_ = number;
        line = trimmed(line.substr(0, line.find('#')), kBlanks);
        if (base::is_blank_row(line)) return;
        auto cells = spelling::split(line, line.find(';') != std::string_view::npos ? ';' : ',');
        for (std::string_view& cell : cells) cell = trimmed(cell, kBlanks);
        if (!has_heading_) return heading(cells);
        if (!units_.empty()) row(cells);
    }

    PathFile finish() {
        if (file_.problems.empty() && file_.path.size() < 2)
            file_.problems.emplace_back("it has fewer than two points");
        return std::move(file_);
    }

  private:
    void wrong(const std::string& what) {
        file_.problems.push_back(fmt::format("line {}: {}", number_, what));
    }

    void heading(const std::vector<std::string_view>& cells) {
        has_heading_ = true;
        if (!cells[0].starts_with("time") || cells.size() < 2)
            return wrong("begin with the heading: time,0 [inc],1 [inc] for the axes with addresses 0 and 1");
        for (std::size_t i = 1; i < cells.size(); ++i) {
            const std::size_t bracket = cells[i].find('[');
            const auto address = read_address(cells[i].substr(0, bracket));
            if (!address) {
                wrong(fmt::format("'{}' is no axis: write its address, 0 to 127, and [inc] or [rev]",
                                  cells[i]));
                file_.addresses.push_back(0xFF);
                units_.emplace_back();
                continue;
            }
            if (std::find(file_.addresses.begin(), file_.addresses.end(), *address) != file_.addresses.end())
                wrong(fmt::format("axis {} stands there twice", *address));
            file_.addresses.push_back(*address);
            const std::string_view unit =
                bracket == std::string_view::npos ? "" : cells[i].substr(bracket + 1);
            units_.emplace_back(trimmed(unit.substr(0, unit.find(']'))));
        }
    }

    void row(const std::vector<std::string_view>& cells) {
        if (cells.size() != units_.size() + 1)
            return wrong(fmt::format("{} cells, and the heading has {}", cells.size(), units_.size() + 1));
        midi_client::Waypoint point;
        const TypedNumber time = typed_time(cells[0]);
        if (!time.error.empty()) return wrong(time.error);
        point.ticks = time.value * kTicksPerMicrosecond;
        if (file_.path.empty() && point.ticks != 0) return wrong("the first point's time is 0");
        if (!file_.path.empty() && point.ticks <= file_.path.back().ticks)
            return wrong("its time is not later than the one before");
        for (std::size_t i = 0; i < units_.size(); ++i) {
            const TypedNumber position = typed_position(std::string(cells[i + 1]) + units_[i], scale_.model);
            if (!position.error.empty()) return wrong(position.error);
            point.positions.push_back(position.value);
        }
        file_.path.push_back(std::move(point));
    }

    const Scale& scale_;
    PathFile file_;
    std::vector<std::string> units_;
    unsigned number_ = 0;
    bool has_heading_ = false;
};

}  // namespace

PathFile read_path(std::string_view text, const Scale& scale) {
    Reader reader(scale);
    unsigned number = 0;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        reader.take(text.substr(0, end), ++number);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return reader.finish();
}

}  // namespace nplc::macreg::midi
