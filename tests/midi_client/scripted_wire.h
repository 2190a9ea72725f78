#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "host/byte_client.h"

namespace nplc::midi_client {

/// A line whose other end answers each message as written down, some time later.
class ScriptedWire final : public host::ByteClient {
  public:
    struct Reply {
        std::vector<std::uint8_t> bytes{};
        base::Microseconds after{5'000};
    };

    const std::string& name() const override { return name_; }
    bool write(std::span<const std::uint8_t> bytes) override {
        sent.emplace_back(bytes.begin(), bytes.end());
        if (script.empty()) return open;
        const Reply reply = script.front();
        script.pop_front();
        for (const std::uint8_t byte : reply.bytes) coming_.push_back({now_ + reply.after, byte});
        return open;
    }
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        if (!open) return std::nullopt;
        if (coming_.empty() || coming_.front().first > now_ + wait) {
            now_ += wait;
            return 0;
        }
        now_ = std::max(now_, coming_.front().first);
        std::size_t count = 0;
        while (count < out.size() && !coming_.empty() && coming_.front().first <= now_) {
            out[count++] = coming_.front().second;
            coming_.pop_front();
        }
        return count;
    }
    base::Instant now() const override { return now_; }

    std::deque<Reply> script;
    std::vector<std::vector<std::uint8_t>> sent;
    bool open = true;

  private:
    std::string name_ = "script:line";
    base::Instant now_{};
    std::deque<std::pair<base::Instant, std::uint8_t>> coming_;
};

}  // namespace nplc::midi_client
