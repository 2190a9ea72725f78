#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace nplc::sim::fmu {

/// Memory that can be copied as a whole and restored at the same address, so that every pointer in it stays
/// valid: a simulation whose allocations are all in it is saved and restored without knowledge of its types.
/// Not for alignments above that of std::max_align_t.
class Arena {
  public:
    Arena() = default;
    Arena(const Arena&) = delete;
    Arena& operator=(const Arena&) = delete;

    /// Throws std::bad_alloc.
    void* take(std::size_t bytes);
    void give_back(void* taken);

  private:
    static constexpr std::size_t kClasses = 48;  // block sizes, powers of two
    struct Block {
        Block* next;
    };
    struct Books {
        std::array<Block*, kClasses> free{};
        std::size_t chunk = 0;  // chunks behind this one are unused
        std::size_t used = 0;   // of that chunk
    };
    struct Chunk {
        std::unique_ptr<std::byte[]> bytes;
        std::size_t size;
    };

  public:
    class Image {
        friend class Arena;
        Books books;
        std::vector<std::vector<std::byte>> chunks;
    };
    Image image() const;
    /// `image` must be of this arena.
    void restore(const Image& image);

  private:
    void* carve(std::size_t bytes);
    std::size_t used_of(std::size_t chunk) const;

    Books books_;
    std::vector<Chunk> chunks_;  // their addresses do not change until the arena is destroyed
};

/// While it exists, allocations of this thread come from `arena`. Memory from it, or from elsewhere, may be
/// freed at any time while the arena exists.
class AllocateIn {
  public:
    explicit AllocateIn(Arena& arena);
    AllocateIn(const AllocateIn&) = delete;
    AllocateIn& operator=(const AllocateIn&) = delete;
    ~AllocateIn();

  private:
    Arena* before_;
};

}  // namespace nplc::sim::fmu
