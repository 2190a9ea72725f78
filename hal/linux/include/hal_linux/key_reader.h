#pragma once

#include <chrono>
#include <memory>
#include <optional>

namespace nplc::hal_linux {

/// Single keys from standard input, without echo, while this object lives. If standard input is not a
/// terminal there are no keys. Ctrl-C still raises SIGINT. The terminal's mode is restored by the destructor.
class KeyReader {
  public:
    KeyReader();
    ~KeyReader();
    KeyReader(const KeyReader&) = delete;
    KeyReader& operator=(const KeyReader&) = delete;

    /// A key, or empty after `wait` (also after a signal, or when the descriptor `other` is readable).
    std::optional<char> key(std::chrono::milliseconds wait, int other = -1);
    bool has_keys() const { return saved_ != nullptr; }

  private:
    struct SavedMode;
    std::unique_ptr<SavedMode> saved_;  ///< null if there are no keys
};

}  // namespace nplc::hal_linux
