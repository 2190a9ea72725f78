#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "faces/command.h"
#include "request.h"
#include "set_point_feed.h"

namespace nplc::panel {

struct SetPointsRead;

/// A client's request about set-points and recipes, as a sequence of writes to SET_POINT_WRITE; the gateway
/// checks range and unit, and its refusals are reported with the value's name and limits.
class SetPointWork {
  public:
    /// `do`: set_points, and recipe except for its export.
    static SetPointsRead read(const Request& request, const SetPointFeed& feed);
    /// The recipes as a file, or an error.
    static SetPointsRead export_to(const Request& request, const SetPointFeed& feed, std::string& file);

    /// The next command, if none is in progress.
    std::optional<faces::Command> next(base::Instant now);
    /// The desk's id of the command from next().
    void submitted(std::uint32_t command) { command_ = command; }
    bool is_of(std::uint32_t command) const { return is_waiting_ && command_ == command; }
    void ended(const faces::Completion& completion);

    bool is_over() const { return result_ != faces::Result::done || done_ == requests_.size(); }
    std::uint64_t request() const { return request_; }
    faces::Result result() const { return result_; }
    std::uint16_t detail() const { return detail_; }
    /// Reason of a refusal, or what was done.
    std::string text() const;
    /// The change as a scenario action: `set Length := 25 mm and Pieces := 5`; empty if no value was set.
    const std::string& action() const { return action_; }

  private:
    explicit SetPointWork(const Request& request, const faces::SetPointBook& book)
        : request_(*request.id), book_(book) {}
    static SetPointsRead change(const Request& request, const SetPointFeed& feed);
    static SetPointsRead import_from(const Request& request, const SetPointFeed& feed);
    static SetPointsRead one_recipe(const Request& request, const SetPointFeed& feed);

    std::uint64_t request_;
    faces::SetPointBook book_;
    std::vector<std::vector<std::uint8_t>> requests_;
    std::vector<std::string> names_;  ///< of imported recipes, one per request
    std::string action_;
    std::size_t done_ = 0;
    std::uint32_t command_ = 0;
    bool is_waiting_ = false;
    faces::Result result_ = faces::Result::done;
    std::uint16_t detail_ = 0;
};

struct SetPointsRead {
    std::optional<SetPointWork> work{};
    bool is_message = true;  ///< false: the message itself is invalid
    std::string error{};     ///< one line; empty if there is none
};

}  // namespace nplc::panel
