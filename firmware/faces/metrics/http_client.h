#pragma once

#include <array>
#include <functional>
#include <string>

#include "base/time.h"

namespace nplc::metrics {

/// A client of the metrics' server: the head of one request in, one answer out, then it is let go.
class HttpClient {
  public:
    static constexpr base::Milliseconds kPatience{
        10'000};  ///< for its request, and for it to take its answer

    /// Owns the descriptor.
    HttpClient(int descriptor, base::Instant now) : descriptor_(descriptor), began_(now) {}
    ~HttpClient();
    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;

    int descriptor() const { return descriptor_; }
    short events() const;
    /// After poll(): reads what has come, or sends on.
    void serve(short events, base::Instant now);
    base::Instant ends() const { return began_ + kPatience; }
    bool is_gone() const { return is_gone_; }
    /// Its request asks for the metrics, which answer() then gives it.
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
