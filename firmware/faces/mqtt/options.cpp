#include "mqtt/options.h"

#include <algorithm>
#include <cctype>

namespace nplc::mqtt {

bool is_topic_part(const std::string& text) {
    constexpr std::size_t kLongest = 64;
    return !text.empty() && text.size() <= kLongest &&
           text.find_first_of(std::string("+/#\0", 4)) == std::string::npos;
}

bool Options::may_set(std::string_view set_point) const {
    const auto is_same = [set_point](const std::string& name) {
        return name == "*" || std::equal(name.begin(), name.end(), set_point.begin(), set_point.end(),
                                         [](unsigned char a, unsigned char b) {
                                             return std::tolower(a) == std::tolower(b);
                                         });
    };
    return std::any_of(set_points.begin(), set_points.end(), is_same);
}

}  // namespace nplc::mqtt
