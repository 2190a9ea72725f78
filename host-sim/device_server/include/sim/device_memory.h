#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nplc::sim {

struct NamedValue {
    std::string name;
    std::int64_t value = 0;
};

/// A device's non-volatile memory, as named values.
class DeviceMemory {
  public:
    virtual ~DeviceMemory() = default;
    /// The first line of its file.
    virtual std::string heading() const = 0;
    /// Form of a line, for messages: "REGISTER = VALUE".
    virtual std::string form() const = 0;
    virtual std::vector<NamedValue> values() const = 0;
    /// Number of writes by the device.
    virtual std::uint32_t writes() const = 0;
    /// Accepts a value to restore; false: unknown name, or out of range.
    virtual bool take(const NamedValue& value) = 0;
    /// Writes all accepted values into the device.
    virtual void restore() = 0;
};

/// Device memories in text files: a first line that identifies the file, then one line `NAME = VALUE` each,
/// in decimal; `#` begins a comment. A file is replaced atomically.
class MemoryFiles {
  public:
    /// Restores an existing file; a missing file is no error, but it must be writable. An empty `file`
    /// disables storing; the file of a further unit has its address appended. Returns a one-line error, or an
    /// empty text.
    std::string add(const std::string& file, int address, std::unique_ptr<DeviceMemory> memory);
    /// Saves changes. Returns an error, or an empty text.
    std::string save_changed();

  private:
    struct File {
        std::string path;
        std::unique_ptr<DeviceMemory> memory;
        std::uint32_t written = 0;
    };
    std::vector<File> files_;
};

}  // namespace nplc::sim
