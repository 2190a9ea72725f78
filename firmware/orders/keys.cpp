#include "orders/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace nplc::orders {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPublic = "nanoplc-public-key";
constexpr std::string_view kSecret = "nanoplc-secret-key";
constexpr std::size_t kLongestKeyFile = 256;
constexpr std::size_t kMostKeys = 100;

std::string write_key(std::string_view word, const std::string& name, std::span<const std::uint8_t> key) {
    return fmt::format("{} {} {}\n", word, name, hex(key));
}

/// The key's name; empty if the text is no such file.
std::optional<std::string> read_key(std::string_view word, std::string_view text,
                                    std::span<std::uint8_t> key) {
    const std::size_t begin = word.size() + 1;
    const std::size_t digits = 2 * key.size();
    if (text.size() < begin + 1 + 1 + digits + 1 || !text.starts_with(word) || text[word.size()] != ' ')
        return std::nullopt;
    const std::size_t end = text.size() - 1 - digits - 1;
    const std::string_view name = text.substr(begin, end - begin);
    if (text[end] != ' ' || text.back() != '\n' || !is_key_name(name) ||
        !read_hex(text.substr(end + 1, digits), key))
        return std::nullopt;
    return std::string(name);
}

TrustedKeys failed(const std::string& path, const std::string& why) {
    return {.error = fmt::format("{}: {}; no order is taken until it is mended", path, why)};
}

std::string read_first(const fs::path& path, bool& is_read) {
    std::ifstream file(path, std::ios::binary);
    std::string text(kLongestKeyFile, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    is_read = file.is_open() && !file.bad();
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

}  // namespace

bool is_key_name(std::string_view name) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    return !name.empty() && name.size() <= 32 && name.find_first_not_of(kLetters) == std::string_view::npos;
}

std::string write_public(const TrustedKey& key) {
    return write_key(kPublic, key.name, key.key);
}

std::string write_secret(const std::string& name, const Seed& seed) {
    return write_key(kSecret, name, seed);
}

std::optional<TrustedKey> read_public(std::string_view text) {
    TrustedKey key;
    auto name = read_key(kPublic, text, key.key);
    if (!name) return std::nullopt;
    key.name = std::move(*name);
    return key;
}

std::optional<SecretKey> read_secret(std::string_view text) {
    SecretKey key;
    auto name = read_key(kSecret, text, key.seed);
    if (!name) return std::nullopt;
    key.name = std::move(*name);
    return key;
}

const TrustedKey* TrustedKeys::find(const PublicKey& key) const {
    const auto place =
        std::find_if(keys.begin(), keys.end(), [&](const auto& one) { return one.key == key; });
    return place == keys.end() ? nullptr : &*place;
}

TrustedKeys read_trusted(const std::string& folder) {
    TrustedKeys trusted;
    std::error_code error;
    std::vector<fs::path> files;
    for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
         entry.increment(error)) {
        if (entry->path().extension() == ".pub") files.push_back(entry->path());
    }
    if (error) return failed(folder, error.message());
    if (files.size() > kMostKeys) return failed(folder, fmt::format("has more than {} keys", kMostKeys));
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        if (!fs::is_regular_file(file, error)) return failed(file, "is no file");
        bool is_read = false;
        const std::string text = read_first(file, is_read);
        if (!is_read) return failed(file, "cannot be read; the service's user must be let read it");
        auto key = read_public(text);
        if (!key) return failed(file, "is no public key of `nanofleet keys`");
        trusted.keys.push_back(std::move(*key));
    }
    return trusted;
}

}  // namespace nplc::orders
