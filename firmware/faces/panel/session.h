#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "axis_feed.h"
#include "faces/upload.h"
#include "panel/web_server.h"
#include "set_point_request.h"

namespace nplc::panel {

/// Rights of a client: PROTOCOL.md, Rights.
struct Rights {
    bool read = false;
    bool operate = false;
};

/// A client's state for one axis: what was sent to it, and its requests.
struct AxisPart {
    std::unique_ptr<faces::CommandDesk::Client> desk{};   ///< from its first command on
    std::multimap<std::uint32_t, std::uint64_t> asked{};  ///< requests by the desk's ids
    std::optional<faces::Upload> upload{};
    std::uint32_t upload_id = 0;  ///< of its command in progress
    std::size_t told_bytes = 0;
    std::optional<std::pair<std::uint32_t, std::string>> names{};  ///< of the upload's table, by its CRC
    std::optional<SetPointWork> set_points{};

    std::unique_ptr<faces::AxisImage> image{};  ///< as last sent
    base::Instant told_slow{};
    std::uint32_t program = 0;
    std::uint32_t set_points_told = 0;
    std::uint32_t why = 0;
    std::uint64_t event = 0;
    std::string seat{};
};

/// A client.
struct Session {
    /// Messages per second, and burst size.
    static constexpr unsigned kMessages = 100;
    /// Then it is disconnected.
    static constexpr unsigned kMostFaults = 50;

    explicit Session(std::string peer_name, std::size_t axes) : peer(std::move(peer_name)), parts(axes) {}

    /// False: it sends too much.
    bool may_send(base::Instant now);

    std::string peer;
    Rights rights{};
    bool is_greeted = false;
    base::Instant opened{};
    base::Instant last_told{};
    unsigned faults = 0;
    unsigned wrong_secrets = 0;
    std::string simulation{};   ///< as last sent
    base::Instant told_time{};  ///< time of that
    std::vector<AxisPart> parts;

  private:
    double credit_ = kMessages;
    base::Instant credited_{};
};

}  // namespace nplc::panel
