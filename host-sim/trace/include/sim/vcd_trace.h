#pragma once

#include <map>
#include <optional>

#include "sim/names.h"
#include "sim/output_file.h"
#include "sim/snapshot.h"

namespace nplc::sim {

/// The trace as a value change dump (IEEE 1364), in microseconds, for GTKWave and its like. Signals have the
/// program's names (IN0, OUT0 and step numbers without any). `step_name` and `command` are GTKWave's string
/// variables; `command` falls back to "-" one millisecond after the command was given, so that two equal ones
/// can be told apart.
class VcdTrace {
  public:
    /// `comment` stands in the header.
    VcdTrace(const std::string& path, const Names& names, const std::string& comment = {});

    /// Times must not fall.
    void observe(const Snapshot& snapshot);
    /// `end`: the last instant that was watched.
    void finish(Time end);

  private:
    void header(const std::string& comment);
    void at(Time time);
    /// Writes `value` under `name` if it is not what the file says already.
    void put(const std::string& name, const std::string& value);
    void fall_back(Time time);

    OutputFile file_;
    Names names_;
    std::map<std::string, std::string> values_;
    std::optional<std::int64_t> written_us_;
    std::int64_t now_us_ = 0;
    std::optional<Time> command_until_;
};

}  // namespace nplc::sim
