#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.h"
#include "broker/options.h"
#include "deployment/settings.h"
#include "registers/vocabulary.h"

namespace nplc::mqtt {

struct Options : broker::Options {
    std::string group = "nanoplc";
    std::string node = "nanoplc";  ///< this process; each axis is one of its devices
    std::string primary_host{};    ///< empty: everybody is told
    base::Milliseconds period{1'000};
    std::size_t store = 10'000;  ///< values kept while the broker or the primary host is away
    std::vector<registers::gateway::Command> commands{};  ///< that are taken
    std::vector<std::string> set_points{};  ///< names of those that may be set (case counts not); "*": all
    bool recipes = false;                   ///< may be loaded
    base::Milliseconds command_age{5'000};  ///< an older one, by its timestamp, is not
    deployment::Settings orders{};          ///< signed ones, and reports beside Sparkplug
    /// One line for the user; an error, or news. From the face's thread.
    std::function<void(bool is_error, const std::string&)> tell{};

    bool takes_anything() const { return !commands.empty() || !set_points.empty() || recipes; }
    bool may_set(std::string_view set_point) const;
};

/// What is a part of a topic: not empty, no + / or #, 64 characters at the most.
bool is_topic_part(const std::string& text);

}  // namespace nplc::mqtt
