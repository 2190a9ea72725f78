#include "mqtt/client.h"

#include <fmt/format.h>
#include <mosquitto.h>
#include <poll.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <set>

#include "attempts.h"
#include "broker/session.h"
#include "edge_node.h"
#include "hal_linux/quiet_thread.h"
#include "hal_linux/steady_clock.h"
#include "hal_linux/wakeup.h"
#include "order_node.h"

namespace nplc::mqtt {
namespace {

constexpr int kLookMilliseconds = 50;
constexpr int kKeepAliveSeconds = 10;
constexpr base::Milliseconds kBetweenQuestions{2'000};
/// Connection timeout.
constexpr base::Milliseconds kPatience{10'000};
/// If a loop pass is late by more than this, the process was halted, and received messages may be as old.
constexpr base::Milliseconds kHalted{500};

}  // namespace

/// The thread's main loop.
class Client::Loop {
  public:
    Loop(Options options, const faces::Axes& axes)
        : options_(std::move(options)), node_(options_, axes, bell_), orders_(options_, axes, bell_) {}
    Loop(const Loop&) = delete;
    Loop& operator=(const Loop&) = delete;

    /// One-line error if they cannot be read.
    std::string read_secrets() {
        broker::Secrets secrets = broker::read_secrets(options_);
        password_ = std::move(secrets.password);
        return std::move(secrets.error);
    }
    void run();
    void end() {
        ends_ = true;
        wakeup_.ring();
    }

  private:
    Moment moment() { return {.now = clock_.now(), .milliseconds = hal_linux::calendar_milliseconds()}; }
    std::string set_up();
    void connect();
    void look();
    void leave();
    void lose(const std::string& why);
    std::string reason_of(int code) const;
    void ask();
    void tell(bool is_error, const std::string& text) const {
        if (options_.tell) options_.tell(is_error, text);
    }
    bool publish(const std::string& topic, const std::string& payload);
    OrderNode::Link link_of_orders();

    static Loop& of(void* self) { return *static_cast<Loop*>(self); }
    static void on_connect(mosquitto*, void* self, int code);
    static void on_subscribe(mosquitto*, void* self, int id, int count, const int* granted);
    static void on_log(mosquitto*, void* self, int level, const char* text);
    static void on_message(mosquitto*, void* self, const mosquitto_message* message);

    broker::Library library_;
    Options options_;
    std::string password_;
    hal_linux::SteadyClock clock_;
    hal_linux::Wakeup wakeup_;
    faces::Bell bell_{[this] { wakeup_.ring(); }};
    EdgeNode node_;
    OrderNode orders_;
    std::set<int> order_questions_;  ///< its subscriptions without an answer yet
    broker::Session session_{nullptr, ::mosquitto_destroy};
    base::Instant begun_{};   ///< start of the connection
    base::Instant looked_{};  ///< start of the last pass
    bool is_late_ = false;    ///< messages may have been delayed
    bool has_heard_ = false;  ///< a message was received in this pass
    Attempts attempts_{fmt::format("nanoplc-{}-{}", options_.group, options_.node)};
    bool is_subscribed_ = false;
    int question_ = 0;  ///< message id whose acknowledgement confirms earlier messages; 0: none
    base::Instant asked_{};
    std::string refusal_;  ///< the broker's reason
    std::atomic<bool> ends_{false};
};

/// Empty, or the library's error.
std::string Client::Loop::set_up() {
    mosquitto* const session = session_.get();
    ::mosquitto_connect_callback_set(session, on_connect);
    ::mosquitto_subscribe_callback_set(session, on_subscribe);
    ::mosquitto_message_callback_set(session, on_message);
    ::mosquitto_log_callback_set(session, on_log);
    if (std::string error = broker::set_secrets(session, options_, password_); !error.empty()) return error;
    const std::string death = node_.death_payload(moment().milliseconds);
    const int code = ::mosquitto_will_set(session, node_.death_topic().c_str(),
                                          static_cast<int>(death.size()), death.data(), 1, false);
    return code == MOSQ_ERR_SUCCESS ? std::string() : broker::reason_of(code);
}

void Client::Loop::connect() {
    begun_ = clock_.now();
    node_.begin_session();
    refusal_.clear();
    is_subscribed_ = false;
    question_ = 0;
    order_questions_.clear();
    session_ = broker::new_session(attempts_.name(), this);
    if (!session_) return lose("no memory");
    if (const std::string error = set_up(); !error.empty()) return lose(error);
    const int code =
        ::mosquitto_connect_async(session_.get(), options_.host.c_str(), options_.port, kKeepAliveSeconds);
    if (code != MOSQ_ERR_SUCCESS) lose(reason_of(code));
}

/// The error text of the broker or the library, if any.
std::string Client::Loop::reason_of(int code) const {
    return refusal_.empty() ? broker::reason_of(code) : refusal_;
}

void Client::Loop::lose(const std::string& why) {
    session_.reset();
    node_.disconnected();
    orders_.disconnected();
    is_subscribed_ = false;
    const std::string text = attempts_.lost(
        clock_.now(),
        fmt::format("no connection to {}:{}: {}; tries again", options_.host, options_.port, why),
        !refusal_.empty());
    if (!text.empty()) tell(true, text);
}

/// Orderly disconnect with an explicit death message: the broker then does not publish the will.
void Client::Loop::leave() {
    if (!session_) return;
    const std::string death = node_.death_payload(moment().milliseconds);
    ::mosquitto_publish(session_.get(), nullptr, node_.death_topic().c_str(), static_cast<int>(death.size()),
                        death.data(), 0, false);
    ::mosquitto_disconnect(session_.get());
    session_.reset();
    node_.disconnected();
    orders_.disconnected();
}

void Client::Loop::run() {
    looked_ = clock_.now();
    while (!ends_) {
        if (!session_ && attempts_.is_due(clock_.now())) connect();
        if (session_) {
            look();
        } else {
            pollfd waits{.fd = wakeup_.descriptor(), .events = POLLIN, .revents = 0};
            ::poll(&waits, 1, kLookMilliseconds);
            wakeup_.drain();
        }
        node_.tick(moment(),
                   [this](const auto& topic, const auto& payload) { return publish(topic, payload); });
        orders_.tick(moment(), link_of_orders());
        if (!session_ || !node_.wants_to_leave()) continue;
        tell(false, fmt::format("the primary host {} is offline; values are kept until it is back",
                                options_.primary_host));
        leave();
        attempts_.left(clock_.now());
    }
    leave();
}

void Client::Loop::look() {
    looked_ = clock_.now();
    has_heard_ = false;
    const int code = ::mosquitto_loop(session_.get(), kLookMilliseconds, 1);
    const base::Instant now = clock_.now();
    if (now - looked_ > base::Milliseconds(kLookMilliseconds) + kHalted)
        is_late_ = true;
    else if (!has_heard_)
        is_late_ = false;
    if (code != MOSQ_ERR_SUCCESS) return lose(reason_of(code));
    if (!is_subscribed_ && now - begun_ > kPatience) return lose("the broker does not answer");
    if (attempts_.lasts(now))
        tell(false, fmt::format("the connection to {}:{} lasts again", options_.host, options_.port));
    ask();
}

/// The answer to a subscription confirms that all earlier messages have arrived: data are sent with quality
/// 0, as required by Sparkplug, and are not acknowledged.
void Client::Loop::ask() {
    const base::Instant now = clock_.now();
    if (!is_subscribed_ || question_ != 0 || !node_.store().wants_asking() ||
        now - asked_ < kBetweenQuestions)
        return;
    asked_ = now;
    node_.store().ask();
    if (::mosquitto_subscribe(session_.get(), &question_, node_.subscriptions().front().c_str(), 1) !=
        MOSQ_ERR_SUCCESS)
        question_ = 0;
}

bool Client::Loop::publish(const std::string& topic, const std::string& payload) {
    return session_ &&
           ::mosquitto_publish(session_.get(), nullptr, topic.c_str(), static_cast<int>(payload.size()),
                               payload.data(), 0, false) == MOSQ_ERR_SUCCESS;
}

OrderNode::Link Client::Loop::link_of_orders() {
    return {.publish =
                [this](const std::string& topic, const std::string& payload) {
                    return session_ && ::mosquitto_publish(session_.get(), nullptr, topic.c_str(),
                                                           static_cast<int>(payload.size()), payload.data(),
                                                           1, true) == MOSQ_ERR_SUCCESS;
                },
            .subscribe =
                [this](const std::string& topic) {
                    int id = 0;
                    const bool is_asked =
                        session_ &&
                        ::mosquitto_subscribe(session_.get(), &id, topic.c_str(), 1) == MOSQ_ERR_SUCCESS;
                    if (is_asked) order_questions_.insert(id);
                    return is_asked;
                },
            .unsubscribe =
                [this](const std::string& topic) {
                    return session_ && ::mosquitto_unsubscribe(session_.get(), nullptr, topic.c_str()) ==
                                           MOSQ_ERR_SUCCESS;
                }};
}

void Client::Loop::on_connect(mosquitto* session, void* self, int code) {
    Loop& loop = of(self);
    if (code != 0) {
        loop.refusal_ = ::mosquitto_connack_string(code);
        return;
    }
    for (const std::string& topic : loop.node_.subscriptions())
        ::mosquitto_subscribe(session, &loop.question_, topic.c_str(), 1);
}

/// TLS errors from the library's log. The first line says the most.
void Client::Loop::on_log(mosquitto* session, void* self, int level, const char* text) {
    std::string& refusal = of(self).refusal_;
    if (level == MOSQ_LOG_ERR && refusal.empty()) refusal = broker::explained(session, text);
}

/// The answer to the last subscription: all are complete.
void Client::Loop::on_subscribe(mosquitto*, void* self, int id, int count, const int* granted) {
    Loop& loop = of(self);
    constexpr int kRefused = 128;
    if (loop.order_questions_.erase(id) != 0) {
        if (count > 0 && granted[0] >= kRefused)
            loop.tell(true, "the broker does not let us read orders, or the pieces of their tables");
        return;
    }
    if (count > 0 && granted[0] >= kRefused) {
        loop.refusal_ = "the broker does not let us subscribe to commands";
        ::mosquitto_disconnect(loop.session_.get());
        return;
    }
    if (id != loop.question_) return;
    loop.question_ = 0;
    if (loop.is_subscribed_) return loop.node_.store().confirm();
    loop.is_subscribed_ = true;
    loop.node_.connected();
    loop.orders_.connected();
    if (!loop.attempts_.made(loop.clock_.now())) return;
    loop.tell(false, fmt::format("connected to {}:{}, as node {} of group {}", loop.options_.host,
                                 loop.options_.port, loop.options_.node, loop.options_.group));
}

void Client::Loop::on_message(mosquitto*, void* self, const mosquitto_message* message) {
    Loop& loop = of(self);
    loop.has_heard_ = true;
    const Moment moment = loop.moment();
    const std::string_view payload{static_cast<const char*>(message->payload),
                                   static_cast<std::size_t>(message->payloadlen)};
    if (loop.orders_.receive(message->topic, payload, moment)) return;
    const bool is_late =
        loop.is_late_ || moment.now - loop.looked_ > base::Milliseconds(kLookMilliseconds) + kHalted;
    loop.node_.receive({.topic = message->topic,
                        .payload = payload,
                        .is_retained = message->retain,
                        .arrived = is_late ? base::Instant{} : loop.looked_},
                       moment);
}

Client::Client() = default;

Client::Opened Client::open(const Options& options, const faces::Axes& axes) {
    std::unique_ptr<Client> client(new Client);
    client->loop_ = std::make_unique<Loop>(options, axes);
    if (std::string error = client->loop_->read_secrets(); !error.empty()) return {nullptr, error};
    client->thread_ = hal_linux::start_quiet_thread([loop = client->loop_.get()] { loop->run(); });
    return {std::move(client), {}};
}

Client::~Client() {
    if (!thread_.joinable()) return;
    loop_->end();
    thread_.join();
}

}  // namespace nplc::mqtt
