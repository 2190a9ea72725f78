#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace nplc::sim::fmu {

/// Memory that can be copied as a whole and put back where it was, so that every pointer in it stays right:
/// a simulation that lies in it with all that it allocates is saved and restored without knowing what it is.
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
        std::size_t chunk = 0;  // what lies behind it is unused
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
    /// Of this arena.
    void restore(const Image& image);

  private:
    void* carve(std::size_t bytes);
    std::size_t used_of(std::size_t chunk) const;

    Books books_;
    std::vector<Chunk> chunks_;  // their bytes stay where they are until the arena goes
};

/// While it lives, what this thread allocates lies in `arena`. What was allocated there, or elsewhere, may be
/// freed at any time the arena lives.
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
