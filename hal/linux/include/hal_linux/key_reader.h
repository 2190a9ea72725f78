#pragma once

#include <chrono>
#include <memory>
#include <optional>

namespace nplc::hal_linux {

/// Single keys from standard input, without echo, while this object lives. If standard input is not a
/// terminal there are no keys. Ctrl-C still raises SIGINT. The terminal's mode is put back at the end of this
/// object's life.
class KeyReader {
  public:
    KeyReader();
    ~KeyReader();
    KeyReader(const KeyReader&) = delete;
    KeyReader& operator=(const KeyReader&) = delete;

    /// A key, or nothing after `wait` (also when a signal came, or `other`, a descriptor, is readable).
    std::optional<char> key(std::chrono::milliseconds wait, int other = -1);
    bool has_keys() const { return saved_ != nullptr; }

  private:
    struct SavedMode;
    std::unique_ptr<SavedMode> saved_;  ///< nothing when there are no keys
};

}  // namespace nplc::hal_linux
