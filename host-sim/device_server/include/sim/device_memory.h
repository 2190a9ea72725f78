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

/// What one device keeps without power, as named values.
class DeviceMemory {
  public:
    virtual ~DeviceMemory() = default;
    /// The first line of its file.
    virtual std::string heading() const = 0;
    /// How a line is written, for messages: "REGISTER = VALUE".
    virtual std::string form() const = 0;
    virtual std::vector<NamedValue> values() const = 0;
    /// How often the device has written.
    virtual std::uint32_t writes() const = 0;
    /// A value to restore; false: nobody knows its name, or it is out of range.
    virtual bool take(const NamedValue& value) = 0;
    /// Puts all that was taken into the device.
    virtual void restore() = 0;
};

/// Devices' memories in text files: a first line that says what it is, then a line `NAME = VALUE` each, in
/// decimal; `#` begins a comment. A file appears whole or stays as it was.
class MemoryFiles {
  public:
    /// Restores what is there; a file that is not there is no error, but it must be possible to write it. An
    /// empty `file` keeps nothing; a further unit's has its address behind it. Answers what went wrong, in
    /// one line, or nothing.
    std::string add(const std::string& file, int address, std::unique_ptr<DeviceMemory> memory);
    /// Saves what has changed. Answers what went wrong.
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
