#pragma once

#include <memory>
#include <string>

#include "ports/storage.h"

namespace nplc::hal_linux {

/// A file in the place of flash of any sizes. Each operation is on the disk when it ends (fdatasync), so a
/// power cut leaves what a cut in flash would: the bytes of one operation in doubt. One program at a time
/// holds the file.
class FileStorage : public ports::Storage {
  public:
    struct Opened {
        std::unique_ptr<FileStorage> storage;
        std::string error;  ///< what went wrong and what to do, in one line; empty when it was opened
    };
    /// A file that is not there is made, whole or not at all, of bytes FFh.
    static Opened open(const std::string& path, const ports::StorageGeometry& geometry);

    virtual ~FileStorage() = default;
    FileStorage(const FileStorage&) = delete;
    FileStorage& operator=(const FileStorage&) = delete;

  protected:
    FileStorage() = default;
};

}  // namespace nplc::hal_linux
