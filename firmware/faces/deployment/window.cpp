#include <fmt/format.h>

#include <array>
#include <ctime>

#include "deployment/settings.h"

namespace nplc::deployment {
namespace {

constexpr int kMinutesOfHour = 60;

/// "04:30".
std::optional<int> read_time(std::string_view text) {
    constexpr std::string_view kForm = "00:00";
    if (text.size() != kForm.size() || text[2] != ':') return std::nullopt;
    std::array<int, 5> digits{};
    for (const std::size_t i : {0U, 1U, 3U, 4U}) {
        digits[i] = text[i] - '0';
        if (digits[i] < 0 || digits[i] > 9) return std::nullopt;
    }
    const int hour = 10 * digits[0] + digits[1];
    const int minute = 10 * digits[3] + digits[4];
    if (hour > 23 || minute > 59) return std::nullopt;
    return kMinutesOfHour * hour + minute;
}

}  // namespace

bool Window::contains(std::uint64_t milliseconds) const {
    const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
    std::tm local{};
    if (::localtime_r(&seconds, &local) == nullptr) return false;
    const int minute = kMinutesOfHour * local.tm_hour + local.tm_min;
    return begin < end ? minute >= begin && minute < end : minute >= begin || minute < end;
}

std::string Window::text() const {
    return fmt::format("{:02}:{:02}-{:02}:{:02}", begin / kMinutesOfHour, begin % kMinutesOfHour,
                       end / kMinutesOfHour, end % kMinutesOfHour);
}

std::optional<Window> read_window(std::string_view text) {
    constexpr std::size_t kTime = 5;
    if (text.size() != 2 * kTime + 1 || text[kTime] != '-') return std::nullopt;
    const auto begin = read_time(text.substr(0, kTime));
    const auto end = read_time(text.substr(kTime + 1));
    if (!begin || !end || *begin == *end) return std::nullopt;
    return Window{*begin, *end};
}

}  // namespace nplc::deployment
