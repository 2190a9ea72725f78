#include "hal_linux/background_storage.h"

#include <csignal>
#include <cstring>

#include "storage_bounds.h"

namespace nplc::hal_linux {
namespace {

using ports::StorageState;

/// It may be locked in memory, so no more than needed.
constexpr std::size_t kStackBytes = std::size_t{128} * 1024;

/// 0, or errno.
int start_thread(pthread_t& thread, void* (*run)(void*), void* argument) {
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
    return result;
}

}  // namespace

BackgroundStorage::BackgroundStorage(ports::Storage& target) : target_(target), geometry_(target.geometry()) {
    bytes_.reserve(geometry_.program_page);
}

BackgroundStorage::Opened BackgroundStorage::open(ports::Storage& target) {
    std::unique_ptr<BackgroundStorage> made(new BackgroundStorage(target));
    const int error = start_thread(made->thread_, &run, made.get());
    if (error != 0) return {nullptr, std::string("no thread for the storage: ") + std::strerror(error)};
    made->has_thread_ = true;
    return {std::move(made), {}};
}

BackgroundStorage::~BackgroundStorage() {
    if (!has_thread_) return;
    state_.wait(StorageState::busy);
    begin(Work::end, 0);
    pthread_join(thread_, nullptr);
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
    work_ = work;
    address_ = address;
    state_ = StorageState::busy;
    begun_.release();
}

void* BackgroundStorage::run(void* self) {
    static_cast<BackgroundStorage*>(self)->work_on();
    return nullptr;
}

void BackgroundStorage::work_on() {
    for (;;) {
        begun_.acquire();
        if (work_ == Work::end) return;
        const base::Status status = carry_out();
        state_ =
            status && target_.state() == StorageState::ready ? StorageState::ready : StorageState::failed;
        state_.notify_one();
    }
}

base::Status BackgroundStorage::carry_out() {
    return work_ == Work::erase ? target_.erase(address_) : target_.program(address_, bytes_);
}

}  // namespace nplc::hal_linux
