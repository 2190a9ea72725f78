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
    std::string primary_host{};    ///< empty: published for any host
    base::Milliseconds period{1'000};
    std::size_t store = 10'000;  ///< values stored while the broker or the primary host is offline
    std::vector<registers::gateway::Command> commands{};  ///< accepted commands
    std::vector<std::string> set_points{};  ///< names of the settable ones (case-insensitive); "*": all
    bool recipes = false;                   ///< may be loaded
    base::Milliseconds command_age{1'000};  ///< maximum age by its timestamp
    deployment::Settings orders{};          ///< signed orders, and reports besides Sparkplug
    /// A one-line message for the operator; an error or news. From the face's thread.
    std::function<void(bool is_error, const std::string&)> tell{};

    bool takes_anything() const { return !commands.empty() || !set_points.empty() || recipes; }
    bool may_set(std::string_view set_point) const;
};

/// A valid level of a topic: not empty, no + / or #, at most 64 characters.
bool is_topic_part(const std::string& text);

}  // namespace nplc::mqtt
