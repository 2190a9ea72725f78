#include "hal_linux/background_storage.h"

#include <csignal>
#include <utility>

#include "storage_bounds.h"

namespace nplc::hal_linux {
namespace {

using ports::StorageState;

/// It may be locked in memory, so it is kept small.
constexpr std::size_t kStackBytes = std::size_t{128} * 1024;

bool start_thread(pthread_t& thread, void* (*run)(void*), void* argument) {
    constexpr sched_param kNoPriority{};
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStackBytes);
    pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
    pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
    pthread_attr_setschedparam(&attributes, &kNoPriority);
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const int result = pthread_create(&thread, &attributes, run, argument);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    pthread_attr_destroy(&attributes);
    return result == 0;
}

}  // namespace

BackgroundStorage::BackgroundStorage(ports::Storage& target) : target_(target), geometry_(target.geometry()) {
    bytes_.reserve(geometry_.program_page);
}

BackgroundStorage::~BackgroundStorage() {
    join();
}

base::Status BackgroundStorage::read(std::uint32_t address, std::span<std::uint8_t> out) {
    if (state_ == StorageState::busy) return base::Error::busy;
    return target_.read(address, out);
}

base::Status BackgroundStorage::program(std::uint32_t address, std::span<const std::uint8_t> bytes) {
    if (!may_program(geometry_, address, bytes.size())) return base::Error::bad_geometry;
    if (state_ == StorageState::busy) return base::Error::busy;
    bytes_.assign(bytes.begin(), bytes.end());
    begin(Work::program, address);
    return {};
}

base::Status BackgroundStorage::erase(std::uint32_t address) {
    if (!may_erase(geometry_, address)) return base::Error::bad_geometry;
    if (state_ == StorageState::busy) return base::Error::busy;
    begin(Work::erase, address);
    return {};
}

void BackgroundStorage::begin(Work work, std::uint32_t address) {
    join();
    work_ = work;
    address_ = address;
    state_ = StorageState::busy;
    has_thread_ = start_thread(thread_, &run, this);
    if (!has_thread_) state_ = StorageState::failed;
}

void BackgroundStorage::join() {
    if (std::exchange(has_thread_, false)) pthread_join(thread_, nullptr);
}

void* BackgroundStorage::run(void* self) {
    auto& storage = *static_cast<BackgroundStorage*>(self);
    const base::Status status = storage.carry_out();
    const bool is_done = status && storage.target_.state() == StorageState::ready;
    storage.state_ = is_done ? StorageState::ready : StorageState::failed;
    return nullptr;
}

base::Status BackgroundStorage::carry_out() {
    return work_ == Work::erase ? target_.erase(address_) : target_.program(address_, bytes_);
}

}  // namespace nplc::hal_linux
