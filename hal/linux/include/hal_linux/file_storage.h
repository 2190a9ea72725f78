#pragma once

#include <memory>
#include <string>

#include "ports/storage.h"

namespace nplc::hal_linux {

/// A file used as flash of any geometry. Each operation is on the disk when it ends (fdatasync), so after a
/// power cut, as in flash, only the bytes of one operation are undefined. One program at a time holds the
/// file.
class FileStorage : public ports::Storage {
  public:
    struct Opened {
        std::unique_ptr<FileStorage> storage;
        std::string error;  ///< the error and its remedy, one line; empty when it was opened
    };
    /// A missing file is created, atomically, filled with FFh.
    static Opened open(const std::string& path, const ports::StorageGeometry& geometry);

    /// Whether a program holds the file; a missing one is not held.
    static bool is_held(const std::string& path);

    virtual ~FileStorage() = default;
    FileStorage(const FileStorage&) = delete;
    FileStorage& operator=(const FileStorage&) = delete;

  protected:
    FileStorage() = default;
};

}  // namespace nplc::hal_linux
