#pragma once

#include <array>
#include <functional>
#include <string>

#include "base/time.h"

namespace nplc::metrics {

/// A client of the metrics server: one request, one answer, then the connection is closed.
class HttpClient {
  public:
    static constexpr base::Milliseconds kPatience{
        10'000};  ///< timeout of the request, and of sending the answer

    /// Owns the descriptor.
    HttpClient(int descriptor, base::Instant now) : descriptor_(descriptor), began_(now) {}
    ~HttpClient();
    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;

    int descriptor() const { return descriptor_; }
    short events() const;
    /// To be called after poll(): reads the request or continues the answer.
    void serve(short events, base::Instant now);
    base::Instant ends() const { return began_ + kPatience; }
    bool is_gone() const { return is_gone_; }
    /// The request is for the metrics, to be passed to answer().
    bool wants_metrics() const { return wants_metrics_; }
    void answer(const std::string& body);

  private:
    void read();
    void look();
    void refuse(const char* status, const char* text);
    void respond(const std::string& status, const std::string& type, const std::string& body);
    void send();

    int descriptor_;
    base::Instant began_;
    bool is_gone_ = false;
    bool wants_metrics_ = false;
    bool is_head_only_ = false;  ///< HEAD
    std::array<char, 8192> in_{};
    std::size_t have_ = 0;
    std::string out_;
};

}  // namespace nplc::metrics
