#include "nanofleet/broker.h"

#include <fmt/format.h>
#include <mosquitto.h>
#include <poll.h>
#include <unistd.h>

#include <map>
#include <set>

#include "broker/session.h"
#include "command_line/program.h"

namespace nplc::nanofleet {
namespace {

using command_line::Failure;

constexpr int kKeepAliveSeconds = 30;
constexpr int kFirstTries = 100;  ///< of 50 ms each, to connect first
constexpr int kPiece = 50;
/// Topics per subscription: a broker limits the message length.
constexpr std::size_t kMostTopics = 100;

}  // namespace

class Broker::Session {
  public:
    Session(const broker::Options& options, Take take);

    void subscribe(const std::vector<std::string>& topics);
    void publish(const std::string& topic, const std::string& payload);
    void serve(int milliseconds);
    std::size_t unconfirmed() const { return unconfirmed_.size(); }
    bool is_connected() const { return is_connected_; }
    bool is_denied() const { return is_denied_; }

  private:
    void set_up(const broker::Options& options, const std::string& password);
    void connected();
    void send_subscriptions(std::size_t from);
    void send(const std::string& topic, const std::string& payload);

    static Session& of(void* self) { return *static_cast<Session*>(self); }
    static void on_connect(mosquitto*, void* self, int code);
    static void on_subscribe(mosquitto*, void* self, int id, int count, const int* granted);
    static void on_publish(mosquitto*, void* self, int id) { of(self).unconfirmed_.erase(id); }
    static void on_message(mosquitto*, void* self, const mosquitto_message* message);
    static void on_log(mosquitto*, void* self, int level, const char* text);

    broker::Library library_;
    Take take_;
    broker::Session handle_;
    bool is_connected_ = false;
    bool is_denied_ = false;
    std::string refusal_;  ///< reported by the broker or the library
    std::vector<std::string> topics_;
    std::map<std::string, std::string> published_;
    std::set<int> unconfirmed_;
};

Broker::Session::Session(const broker::Options& options, Take take)
    : take_(std::move(take)), handle_(broker::new_session(fmt::format("nanofleet-{}", ::getpid()), this)) {
    const std::string where = fmt::format("{}:{}", options.host, options.port);
    if (!handle_) throw Failure(command_line::kNoAnswer, where + ": no memory");
    const broker::Secrets secrets = broker::read_secrets(options);
    if (!secrets.error.empty()) throw command_line::UserError(secrets.error);
    set_up(options, secrets.password);
    const auto fail = [&](const std::string& why) {
        throw Failure(command_line::kNoAnswer,
                      fmt::format("{}: no connection: {}", where, refusal_.empty() ? why : refusal_));
    };
    const int code =
        ::mosquitto_connect(handle_.get(), options.host.c_str(), options.port, kKeepAliveSeconds);
    if (code != MOSQ_ERR_SUCCESS) fail(broker::reason_of(code));
    for (int i = 0; i < kFirstTries && !is_connected_ && refusal_.empty(); ++i) {
        command_line::look_for_interruption();
        const int looped = ::mosquitto_loop(handle_.get(), kPiece, 1);
        if (looped != MOSQ_ERR_SUCCESS) fail(broker::reason_of(looped));
    }
    if (!is_connected_) fail("the broker does not answer");
}

void Broker::Session::set_up(const broker::Options& options, const std::string& password) {
    mosquitto* const handle = handle_.get();
    ::mosquitto_connect_callback_set(handle, on_connect);
    ::mosquitto_subscribe_callback_set(handle, on_subscribe);
    ::mosquitto_publish_callback_set(handle, on_publish);
    ::mosquitto_message_callback_set(handle, on_message);
    ::mosquitto_log_callback_set(handle, on_log);
    if (const std::string why = broker::set_secrets(handle, options, password); !why.empty())
        throw command_line::UserError(
            fmt::format("{}:{}: the secrets are not taken: {}", options.host, options.port, why));
}

void Broker::Session::connected() {
    is_connected_ = true;
    unconfirmed_.clear();
    send_subscriptions(0);
    for (const auto& [topic, payload] : published_) send(topic, payload);
}

void Broker::Session::send_subscriptions(std::size_t from) {
    for (std::size_t i = from; i < topics_.size(); i += kMostTopics) {
        std::vector<char*> some;
        for (std::size_t j = i; j < std::min(i + kMostTopics, topics_.size()); ++j)
            some.push_back(topics_[j].data());
        int id = 0;
        if (::mosquitto_subscribe_multiple(handle_.get(), &id, static_cast<int>(some.size()), some.data(), 1,
                                           0, nullptr) == MOSQ_ERR_SUCCESS)
            unconfirmed_.insert(id);
    }
}

void Broker::Session::send(const std::string& topic, const std::string& payload) {
    int id = 0;
    if (::mosquitto_publish(handle_.get(), &id, topic.c_str(), static_cast<int>(payload.size()),
                            payload.data(), 1, true) == MOSQ_ERR_SUCCESS)
        unconfirmed_.insert(id);
}

void Broker::Session::subscribe(const std::vector<std::string>& topics) {
    const std::size_t from = topics_.size();
    topics_.insert(topics_.end(), topics.begin(), topics.end());
    if (is_connected_) send_subscriptions(from);
}

void Broker::Session::publish(const std::string& topic, const std::string& payload) {
    published_[topic] = payload;
    if (is_connected_) send(topic, payload);
}

void Broker::Session::serve(int milliseconds) {
    if (::mosquitto_loop(handle_.get(), milliseconds, 1) == MOSQ_ERR_SUCCESS) return;
    is_connected_ = false;
    pollfd nobody{.fd = -1, .events = 0, .revents = 0};
    ::poll(&nobody, 1, milliseconds);
    ::mosquitto_reconnect(handle_.get());
}

void Broker::Session::on_connect(mosquitto*, void* self, int code) {
    if (code == 0)
        of(self).connected();
    else
        of(self).refusal_ = ::mosquitto_connack_string(code);
}

void Broker::Session::on_subscribe(mosquitto*, void* self, int id, int count, const int* granted) {
    constexpr int kRefused = 128;
    of(self).unconfirmed_.erase(id);
    for (int i = 0; i < count; ++i) of(self).is_denied_ |= granted[i] >= kRefused;
}

void Broker::Session::on_message(mosquitto*, void* self, const mosquitto_message* message) {
    of(self).take_(message->topic, {static_cast<const char*>(message->payload),
                                    static_cast<std::size_t>(message->payloadlen)});
}

void Broker::Session::on_log(mosquitto* session, void* self, int level, const char* text) {
    std::string& refusal = of(self).refusal_;
    if (level == MOSQ_LOG_ERR && refusal.empty()) refusal = broker::explained(session, text);
}

Broker::Broker(const broker::Options& options, Take take)
    : session_(std::make_unique<Session>(options, std::move(take))) {}
Broker::~Broker() = default;
void Broker::subscribe(const std::vector<std::string>& topics) {
    session_->subscribe(topics);
}
void Broker::publish(const std::string& topic, const std::string& payload) {
    session_->publish(topic, payload);
}
void Broker::serve(int milliseconds) {
    session_->serve(milliseconds);
}
std::size_t Broker::unconfirmed() const {
    return session_->unconfirmed();
}
bool Broker::is_connected() const {
    return session_->is_connected();
}
bool Broker::is_denied() const {
    return session_->is_denied();
}

}  // namespace nplc::nanofleet
