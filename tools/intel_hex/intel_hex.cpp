#include "intel_hex/intel_hex.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/paths.h"
#include "host/text_file.h"

namespace nplc::intel_hex {
namespace {

constexpr std::size_t kBytesARecord = 16;
constexpr std::uint64_t kHalf = 0x10000;  // what the 16-bit address of a record reaches
constexpr std::uint64_t kEverything = 0x1'0000'0000;

enum Type : std::uint8_t { kData, kEnd, kSegment, kStartSegment, kLinear, kStartLinear };

std::string record(Type type, std::uint16_t address, std::span<const std::uint8_t> data) {
    std::vector<std::uint8_t> bytes = {static_cast<std::uint8_t>(data.size()),
                                       static_cast<std::uint8_t>(address >> 8),
                                       static_cast<std::uint8_t>(address), type};
    bytes.insert(bytes.end(), data.begin(), data.end());
    std::string text = ":";
    unsigned sum = 0;
    for (const std::uint8_t byte : bytes) {
        text += fmt::format("{:02X}", byte);
        sum += byte;
    }
    return text + fmt::format("{:02X}\n", (0x100 - (sum & 0xFF)) & 0xFF);
}

int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// Raw content has zeros, or bytes that no text has.
bool is_other_text(std::string_view content) {
    if (host::is_utf16_text(content)) return true;
    const auto is_of_text = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte == '\t' || byte == '\r' || byte == '\n' || byte == 0x1A || (byte >= ' ' && byte != 0x7F);
    };
    const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
    return std::all_of(content.begin(), content.end(), is_of_text) &&
           std::any_of(content.begin(), content.end(), is_ascii);
}

struct Block {
    std::uint64_t address;
    std::vector<std::uint8_t> bytes;
    std::size_t line;
};

class Reader {
  public:
    Image run(std::string_view text) {
        while (!text.empty() && ok()) {
            ++line_;
            const std::size_t end = std::min(text.find('\n'), text.size());
            take_line(text.substr(0, end));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        if (ok() && !ended_) fail("the end record (:00000001FF) is missing: this file is not whole");
        if (ok()) join();
        return std::move(image_);
    }

  private:
    bool ok() const { return image_.error.empty(); }
    void fail(std::string message, std::size_t line = 0) {
        if (!ok()) return;
        image_ = {};
        image_.line = line == 0 ? std::max<std::size_t>(line_, 1) : line;
        image_.error = std::move(message);
    }

    void take_line(std::string_view line) {
        const std::size_t last = line.find_last_not_of(" \t\r");
        if (last == std::string_view::npos) return;
        line = line.substr(0, last + 1);
        if (ended_) return fail("something follows the end record");
        if (line[0] != ':') return fail("a record begins with ':'");
        const auto wrong = std::find_if(line.begin() + 1, line.end(), [](char c) { return digit(c) < 0; });
        if (wrong != line.end())
            return fail(fmt::format("character {} is no hex digit", wrong - line.begin() + 1));
        take_record(line.substr(1));
    }

    void take_record(std::string_view digits) {
        std::vector<std::uint8_t> bytes;
        for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
            bytes.push_back(static_cast<std::uint8_t>(digit(digits[i]) * 16 + digit(digits[i + 1])));
        const std::size_t wanted = bytes.empty() ? 5 : bytes[0] + 5U;  // length, address, type, checksum
        if (digits.size() != 2 * wanted) {
            return fail(fmt::format("the record has {} digits where its length asks for {}", digits.size(),
                                    2 * wanted));
        }
        unsigned sum = 0;
        for (std::size_t i = 0; i + 1 < bytes.size(); ++i) sum += bytes[i];
        const unsigned checksum = (0x100 - (sum & 0xFF)) & 0xFF;
        if (bytes.back() != checksum)
            return fail(
                fmt::format("the checksum is {:02X} where the record makes {:02X}", bytes.back(), checksum));
        take(bytes[3], static_cast<std::uint16_t>(bytes[1] << 8 | bytes[2]),
             std::span(bytes).subspan(4, bytes[0]));
    }

    void take(std::uint8_t type, std::uint16_t address, std::span<const std::uint8_t> data) {
        constexpr std::array<std::size_t, 6> kLengths{0, 0, 2, 4, 2, 4};
        if (type > kStartLinear) return fail(fmt::format("there is no record type {:02X}", type));
        if (type != kData && data.size() != kLengths[type]) {
            return fail(fmt::format("a record of type {:02X} holds {} bytes, not {}", type, kLengths[type],
                                    data.size()));
        }
        if (type == kEnd) ended_ = true;
        if (type == kSegment || type == kLinear) {
            segmented_ = type == kSegment;
            base_ = static_cast<std::uint64_t>(data[0] << 8 | data[1]) << (segmented_ ? 4 : 16);
        }
        if (type == kData && !data.empty()) take_data(address, data);
    }

    void take_data(std::uint16_t address, std::span<const std::uint8_t> data) {
        const bool beyond =
            segmented_ ? address + data.size() > kHalf : base_ + address + data.size() > kEverything;
        if (beyond) return fail("the record runs over the end of its segment or of the memory");
        blocks_.push_back({base_ + address, {data.begin(), data.end()}, line_});
    }

    void join() {
        if (blocks_.empty()) return fail("there are no data records");
        std::stable_sort(blocks_.begin(), blocks_.end(),
                         [](const Block& a, const Block& b) { return a.address < b.address; });
        image_.base = static_cast<std::uint32_t>(blocks_.front().address);
        std::uint64_t next = image_.base;
        for (const Block& block : blocks_) {
            if (block.address > next) {
                return fail(fmt::format("nothing says what stands at {:X}h..{:X}h, before this record", next,
                                        block.address - 1),
                            block.line);
            }
            if (block.address < next)
                return fail(fmt::format("{:X}h is there already", block.address), block.line);
            image_.bytes.insert(image_.bytes.end(), block.bytes.begin(), block.bytes.end());
            next += block.bytes.size();
        }
    }

    Image image_;
    std::vector<Block> blocks_;
    std::uint64_t base_ = 0;
    std::size_t line_ = 0;
    bool segmented_ = false;
    bool ended_ = false;
};

}  // namespace

std::string write(std::span<const std::uint8_t> bytes, std::uint32_t base) {
    std::string text;
    std::uint64_t upper_half = 0;
    for (std::uint64_t at = base; !bytes.empty();) {
        if (at / kHalf != upper_half) {
            upper_half = at / kHalf;
            const std::array<std::uint8_t, 2> half{static_cast<std::uint8_t>(upper_half >> 8),
                                                   static_cast<std::uint8_t>(upper_half)};
            text += record(kLinear, 0, half);
        }
        const std::size_t count =
            std::min({kBytesARecord, bytes.size(), static_cast<std::size_t>(kHalf - at % kHalf)});
        text += record(kData, static_cast<std::uint16_t>(at % kHalf), bytes.first(count));
        bytes = bytes.subspan(count);
        at += count;
    }
    return text + record(kEnd, 0, {});
}

Image read(std::string_view text) {
    return Reader().run(text);
}

Image bytes_in(std::string_view file_name, std::string content) {
    Image image;
    const bool is_hex = is_file(file_name, content);
    image.is_text = !is_hex && is_other_text(content);
    if (!is_hex && !image.is_text) {
        image.bytes.assign(content.begin(), content.end());
        return image;
    }
    image.error = host::is_utf16_text(content) ? host::kUtf16Problem : host::make_text(content);
    if (image.error.empty() && is_hex) return read(content);
    if (image.error.empty()) image.error = "it is text, neither raw bytes nor Intel HEX";
    return image;
}

bool has_extension(std::string_view file_name) {
    std::string extension = host::name_of(host::path_of(file_name).extension());
    for (char& c : extension) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return extension == ".HEX" || extension == ".IHX" || extension == ".IHEX";
}

bool is_file(std::string_view file_name, std::string_view content) {
    if (has_extension(file_name)) return true;
    constexpr std::size_t kShortestRecord = 11;
    if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
    const std::string_view line = content.substr(0, content.find_first_of("\r\n"));
    return line.size() >= kShortestRecord && line[0] == ':' &&
           std::all_of(line.begin() + 1, line.end(), [](char c) { return digit(c) >= 0; });
}

}  // namespace nplc::intel_hex
