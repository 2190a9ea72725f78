#include "arena.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>

namespace nplc::sim::fmu {
namespace {

constexpr std::size_t kChunk = std::size_t{256} * 1024;
constexpr std::size_t kLeastBlock = 32;

/// Header in front of each block that take() returns.
struct alignas(std::max_align_t) Head {
    std::size_t size_class;
};

}  // namespace

void* Arena::take(std::size_t bytes) {
    if (bytes > std::size_t{1} << (kClasses - 2)) throw std::bad_alloc();
    const std::size_t block = std::bit_ceil(std::max(bytes + sizeof(Head), kLeastBlock));
    const auto size_class = static_cast<std::size_t>(std::countr_zero(block));
    void* place = books_.free[size_class];
    if (place == nullptr) {
        place = carve(block);
    } else {
        books_.free[size_class] = books_.free[size_class]->next;
    }
    return new (place) Head{size_class} + 1;
}

void Arena::give_back(void* taken) {
    Head* head = static_cast<Head*>(taken) - 1;
    const std::size_t size_class = head->size_class;
    books_.free[size_class] = new (head) Block{books_.free[size_class]};
}

void* Arena::carve(std::size_t bytes) {
    while (books_.chunk < chunks_.size() && chunks_[books_.chunk].size - books_.used < bytes) {
        ++books_.chunk;
        books_.used = 0;
    }
    if (books_.chunk == chunks_.size()) {
        const std::size_t size = std::max(bytes, kChunk);
        chunks_.push_back({std::make_unique<std::byte[]>(size), size});
    }
    std::byte* place = chunks_[books_.chunk].bytes.get() + books_.used;
    books_.used += bytes;
    return place;
}

std::size_t Arena::used_of(std::size_t chunk) const {
    return chunk == books_.chunk ? books_.used : chunks_[chunk].size;
}

Arena::Image Arena::image() const {
    Image image;
    image.books = books_;
    for (std::size_t i = 0; i < chunks_.size() && i <= books_.chunk; ++i) {
        const std::byte* bytes = chunks_[i].bytes.get();
        image.chunks.emplace_back(bytes, bytes + used_of(i));
    }
    return image;
}

void Arena::restore(const Image& image) {
    books_ = image.books;
    for (std::size_t i = 0; i < image.chunks.size(); ++i) {
        const std::vector<std::byte>& bytes = image.chunks[i];
        if (!bytes.empty()) std::memcpy(chunks_[i].bytes.get(), bytes.data(), bytes.size());
    }
}

}  // namespace nplc::sim::fmu
