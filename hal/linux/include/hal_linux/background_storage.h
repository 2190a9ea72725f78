#pragma once

#include <pthread.h>

#include <atomic>
#include <vector>

#include "ports/storage.h"

namespace nplc::hal_linux {

/// A storage with slow operations, such as a file on a memory card: each operation runs in its own thread, so
/// `program` and `erase` return at once, and state() is `busy` until the thread is done (`failed` if no
/// thread can be created). The thread has no real-time priority and receives no signals.
class BackgroundStorage final : public ports::Storage {
  public:
    /// `target` must not be used otherwise until this is destroyed.
    explicit BackgroundStorage(ports::Storage& target);
    /// Waits for the operation in progress.
    ~BackgroundStorage();
    BackgroundStorage(const BackgroundStorage&) = delete;
    BackgroundStorage& operator=(const BackgroundStorage&) = delete;

    ports::StorageGeometry geometry() const override { return geometry_; }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override;
    /// The bytes are copied.
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override;
    base::Status erase(std::uint32_t address) override;
    ports::StorageState state() override { return state_; }

  private:
    enum class Work : std::uint8_t { program, erase };

    static void* run(void* self);
    void begin(Work work, std::uint32_t address);
    void join();
    base::Status carry_out();

    ports::Storage& target_;
    const ports::StorageGeometry geometry_;
    pthread_t thread_{};
    bool has_thread_ = false;
    /// The following members belong to the thread while the state is `busy`, and to the caller otherwise.
    std::atomic<ports::StorageState> state_{ports::StorageState::ready};
    Work work_ = Work::program;
    std::uint32_t address_ = 0;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace nplc::hal_linux
