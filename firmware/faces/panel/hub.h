#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "axis_feed.h"
#include "panel/panel.h"
#include "ports/clock.h"
#include "request.h"
#include "session.h"

namespace nplc::panel {

/// Connects clients and axes: greets, sends updates, handles requests. On the server's thread.
class Hub final : public WebHandler {
  public:
    Hub(const PanelOptions& options, const std::vector<PanelAxis>& axes, SymbolShelf* symbols,
        Simulation* simulation, ports::Clock& clock);

    /// To be called first.
    void serve(WebServer& server);

    void opened(ClientId client, const std::string& peer) override;
    void received(ClientId client, std::string_view text) override;
    void closed(ClientId client) override { sessions_.erase(client); }
    bool may_go(ClientId client) override;
    void tick() override;

  private:
    using Json = nlohmann::ordered_json;

    // hub.cpp
    void greet(ClientId client, Session& session);
    void tell(ClientId client, Session& session, base::Instant now);
    void tell_axis(ClientId client, Session& session, std::size_t index, base::Instant now);
    void tell_seat(ClientId client, AxisPart& part, AxisFeed& feed);
    void tell_simulation(ClientId client, Session& session, base::Instant now);
    void tell_ages(ClientId client, Session& session, base::Instant now);
    void send(ClientId client, Session& session, std::string text);
    std::string hello(ClientId client, const Session& session) const;

    // hub_set_points.cpp
    void ask_set_points(ClientId client, Session& session, std::size_t axis, const Request& request);
    void go_on_with_set_points(ClientId client, AxisPart& part, base::Instant now);

    // hub_requests.cpp
    void handle(ClientId client, Session& session, const Request& request);
    bool allows(ClientId client, Session& session, const Request& request, bool is_stop);
    void login(ClientId client, Session& session, const Request& request);
    void simulate(ClientId client, Session& session, const Request& request);
    void begin_upload(ClientId client, Session& session, const Request& request);
    void watch_time(base::Instant now);
    /// What is received now may have waited while the process was halted.
    bool is_late() const { return looked_ < halted_until_; }
    void submit(ClientId client, Session& session, std::size_t axis, const Request& request);
    bool join(ClientId client, Session& session, std::size_t axis);
    std::optional<std::size_t> axis_of(const Request& request) const;
    void serve_desk(ClientId client, Session& session, std::size_t index, base::Instant now);
    void keep_names(ClientId client, AxisPart& part, std::size_t index, base::Instant now);
    void go_on_with_upload(ClientId client, Session& session, std::size_t index, base::Instant now);
    void finish_upload(ClientId client, Session& session, std::size_t index);
    void answer(ClientId client, const Request& request, std::string_view result, const std::string& text);
    void answer_completion(ClientId client, std::uint64_t request, const faces::Completion& completion);

    const PanelOptions& options_;
    std::vector<AxisFeed> feeds_;
    SymbolShelf* symbols_;
    Simulation* simulation_;
    ports::Clock& clock_;
    faces::Bell bell_;
    WebServer* server_ = nullptr;
    base::Instant looked_{};  ///< the last time that it ran
    base::Instant halted_until_{};
    std::map<ClientId, Session> sessions_;
};

}  // namespace nplc::panel
