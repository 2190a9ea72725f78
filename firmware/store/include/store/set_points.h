#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "registers/set_points.h"
#include "store/slots.h"

/// The values of set-points and the recipes of them, as they are stored: all of it one content of a slot, so
/// that a power cut leaves the old or the new one whole.
namespace nplc::store {

#ifndef NPLC_RECIPES
#define NPLC_RECIPES 8
#endif
inline constexpr std::size_t kRecipes = NPLC_RECIPES;
inline constexpr std::size_t kRecipeNameBytes = 16;

/// A value of a set-point, whatever table has it.
struct KeptValue {
    std::uint32_t name_hash = 0;
    std::int32_t value = 0;
    std::uint8_t unit = 0;
};

/// Up to 16 values in the bytes that are stored.
class ValueSet {
  public:
    static constexpr std::size_t kValueBytes = 9;
    static constexpr std::size_t kBytes = registers::set_points::kMost * kValueBytes;

    explicit ValueSet(std::uint8_t* bytes) : bytes_(bytes) {}
    void clear();
    /// No room beyond kMost.
    void add(const KeptValue& value);
    /// The value of this entry if it has one of the same name and unit within the range.
    bool find(const registers::set_points::Entry& entry, std::int32_t& value) const;
    void copy_from(const ValueSet& other);
    bool is_empty() const { return read(0).name_hash == 0; }
    const std::uint8_t* bytes() const { return bytes_; }

  private:
    KeptValue read(std::size_t index) const;
    std::uint8_t* bytes_;
};

/// All that is stored, in the bytes of the store.
class SetPointImage {
  public:
    static constexpr std::size_t kHeaderBytes = 8;
    static constexpr std::size_t kRecipeBytes = kRecipeNameBytes + ValueSet::kBytes;
    static constexpr std::size_t kBytes = kHeaderBytes + ValueSet::kBytes + kRecipes * kRecipeBytes;

    SetPointImage() { clear(); }
    void clear();
    /// Its bytes are those of this firmware.
    bool is_sound() const;
    std::span<std::uint8_t> bytes() { return bytes_; }

    ValueSet wanted() { return ValueSet(&bytes_[kHeaderBytes]); }
    /// Of the recipe that was loaded last, 1 and on; 0: none.
    std::uint8_t active() const { return bytes_[2]; }
    void set_active(std::uint8_t recipe) { bytes_[2] = recipe; }
    /// `recipe` 1 to kRecipes. Without a name there is none.
    std::span<std::uint8_t> recipe(std::size_t recipe) {
        return std::span(bytes_).subspan(kHeaderBytes + ValueSet::kBytes + (recipe - 1) * kRecipeBytes,
                                         kRecipeBytes);
    }
    bool has_recipe(std::size_t number) { return recipe(number)[0] != 0; }
    /// The recipe of this name, ended by 0; of an empty name the first one that is free. Case counts not. 0:
    /// there is none.
    std::uint8_t recipe_named(const std::uint8_t* name);
    ValueSet values_of(std::size_t number) { return ValueSet(recipe(number).data() + kRecipeNameBytes); }

  private:
    std::array<std::uint8_t, kBytes> bytes_;
};

/// The image in two slots of its own, written as a whole.
class SetPointStore {
  public:
    SetPointStore(ports::Storage& storage, const Area& area)
        : slots_(storage, area, Kind::set_points, content_) {}

    /// For the start-up. Error damaged: what was stored is not whole, and an older image or none stands in.
    base::Status mount();
    SetPointImage& image() { return image_; }
    /// What was changed in image() since is dropped. Errors as mount(), then it is empty.
    base::Status drop_changes();

    /// Begins to store image(); poll() until phase() is `done` or `failed`, and leave it alone.
    base::Status save() { return slots_.begin(); }
    void poll();
    base::Instant next_poll(base::Instant now) {
        return slots_.phase() == Phase::receiving ? now : slots_.next_poll(now);
    }
    Phase phase() const { return slots_.phase(); }
    base::Error error() const { return slots_.error(); }
    bool is_saving() const {
        return phase() == Phase::erasing || phase() == Phase::receiving || phase() == Phase::closing;
    }

  private:
    AnyContent content_;
    Slots slots_;
    SetPointImage image_;
};

}  // namespace nplc::store
