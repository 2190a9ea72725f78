#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "lsp/features.h"
#include "lsp/verifier.h"
#include "lsp/workspace.h"

namespace nplc::seqc::lsp {

/// The language server without streams and threads: messages in, messages out, in order. Its answers depend
/// on the present texts only, not on the sequence of edits.
class Server {
  public:
    using Send = std::function<void(const Json&)>;

    explicit Server(Send send);

    void receive(const Json& message);
    /// Input that was no JSON object.
    void malformed(const std::string& problem);
    /// To be called when no message is pending: publishes the diagnostics of changed texts.
    void catch_up();
    /// The client has cancelled a request that has not been received yet.
    void cancelled(const Json& message);

    /// Changed programs and property files that need verification, once each.
    std::vector<VerifyJob> take_jobs();
    void verified(const VerifyOutcome& outcome);

    bool ended() const { return exit_code_.has_value(); }
    int exit_code() const { return exit_code_.value_or(1); }

  private:
    void request(const Json& id, const std::string& method, const Json& params);
    Json answer(const std::string& method, const Json& params);
    void notification(const std::string& method, const Json& params);
    Json initialize(const Json& params);
    Json execute(const Json& params);
    void did_open(const Json& params);
    void did_change(const Json& params);
    void did_close(const Json& params);
    void configure(const Json& settings);
    void publish(Document& document);
    void publish_others(const std::string& program, std::map<std::string, Json> lists);
    Json others_of(const std::string& uri) const;
    std::optional<VerifyJob> job_of(const Document& document);
    void keep(VerifyOutcome outcome, const Document& document);
    Json lenses(const Json& params);
    void notify(const std::string& method, Json params);
    void respond(const Json& id, Json result);
    void refuse(const Json& id, int code, const std::string& message);

    Send send_;
    Workspace workspace_;
    Handlers handlers_;
    std::map<std::string, VerifyOutcome> verdicts_;  ///< by URI, for the present text
    std::set<std::string> unverified_;
    /// Diagnostics of included files, by their URI and that of the program.
    std::map<std::string, std::map<std::string, Json>> others_;
    bool initialized_ = false;
    bool shut_down_ = false;
    bool verifies_ = true;
    bool refreshes_lenses_ = false;  ///< the client requests lenses again on a refresh request
    unsigned asked_ = 0;             ///< requests to the client
    std::optional<int> exit_code_;
};

}  // namespace nplc::seqc::lsp
