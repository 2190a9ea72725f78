#include "sparkplug.h"

#include <bit>
#include <cstring>

namespace nplc::mqtt {
namespace {

enum Wire : unsigned { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

void put_varint(std::string& out, std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) out += static_cast<char>(value | 0x80);
    out += static_cast<char>(value);
}

void put_number(std::string& out, unsigned field, std::uint64_t value) {
    put_varint(out, field << 3 | kVarint);
    put_varint(out, value);
}

void put_bytes(std::string& out, unsigned field, std::string_view bytes) {
    put_varint(out, field << 3 | kBytes);
    put_varint(out, bytes.size());
    out += bytes;
}

void put_double(std::string& out, unsigned field, double value) {
    put_varint(out, field << 3 | kFixed64);
    auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i, bits >>= 8) out += static_cast<char>(bits & 0xFF);
}

void put_value(std::string& out, const Metric& metric) {
    if (std::holds_alternative<std::monostate>(metric.value)) return put_number(out, 7, 1);  // is_null
    if (const auto* flag = std::get_if<bool>(&metric.value)) return put_number(out, 14, *flag ? 1 : 0);
    if (const auto* real = std::get_if<double>(&metric.value)) return put_double(out, 13, *real);
    if (const auto* text = std::get_if<std::string>(&metric.value)) return put_bytes(out, 15, *text);
    const auto whole = static_cast<std::uint64_t>(std::get<std::int64_t>(metric.value));
    const bool is_long = metric.type == DataType::int64 || metric.type == DataType::uint64;
    put_number(out, is_long ? 11 : 10, is_long ? whole : static_cast<std::uint32_t>(whole));
}

/// PropertySet: keys, then values in their order.
void put_properties(std::string& out, const Metric& metric) {
    std::string keys;
    std::string values;
    const auto put = [&](std::string_view key, DataType type, const auto& put_it) {
        put_bytes(keys, 1, key);
        std::string value;
        put_number(value, 1, static_cast<std::uint64_t>(type));
        put_it(value);
        put_bytes(values, 2, value);
    };
    if (!metric.unit.empty())
        put("engUnit", DataType::text, [&](std::string& value) { put_bytes(value, 8, metric.unit); });
    if (metric.lowest)
        put("engLow", DataType::real64, [&](std::string& value) { put_double(value, 6, *metric.lowest); });
    if (metric.highest)
        put("engHigh", DataType::real64, [&](std::string& value) { put_double(value, 6, *metric.highest); });
    if (metric.quality) {
        put("Quality", DataType::int32,
            [&](std::string& value) { put_number(value, 3, static_cast<std::uint32_t>(*metric.quality)); });
    }
    if (!keys.empty()) put_bytes(out, 9, keys + values);
}

std::string encode_metric(const Metric& metric) {
    std::string out;
    if (!metric.name.empty()) put_bytes(out, 1, metric.name);
    if (metric.alias) put_number(out, 2, *metric.alias);
    if (metric.timestamp) put_number(out, 3, *metric.timestamp);
    put_number(out, 4, static_cast<std::uint64_t>(metric.type));
    if (metric.is_historical) put_number(out, 5, 1);
    if (!metric.description.empty()) {
        std::string meta;
        put_bytes(meta, 8, metric.description);
        put_bytes(out, 8, meta);
    }
    put_properties(out, metric);
    put_value(out, metric);
    return out;
}

struct Field {
    unsigned number = 0;
    unsigned wire = 0;
    std::uint64_t value = 0;  ///< except for bytes
    std::string_view bytes{};
};

/// Reads field by field; fails permanently at an invalid one.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : left_(bytes) {}
    bool failed() const { return failed_; }

    std::optional<Field> next() {
        if (left_.empty() || failed_) return std::nullopt;
        Field field;
        const std::uint64_t tag = varint();
        field.number = static_cast<unsigned>(tag >> 3);
        field.wire = tag & 7;
        switch (field.wire) {
            case kVarint:
                field.value = varint();
                break;
            case kFixed64:
                field.value = fixed(8);
                break;
            case kFixed32:
                field.value = fixed(4);
                break;
            case kBytes:
                field.bytes = take(varint());
                break;
            default:
                failed_ = true;
        }
        if (failed_ || field.number == 0) {
            failed_ = true;
            return std::nullopt;
        }
        return field;
    }

  private:
    std::string_view take(std::uint64_t count) {
        if (count > left_.size()) failed_ = true;
        if (failed_) return {};
        const std::string_view taken = left_.substr(0, static_cast<std::size_t>(count));
        left_.remove_prefix(taken.size());
        return taken;
    }
    std::uint64_t fixed(std::size_t size) {
        std::uint64_t value = 0;
        unsigned shift = 0;
        for (const char byte : take(size)) {
            value |= std::uint64_t{static_cast<unsigned char>(byte)} << shift;
            shift += 8;
        }
        return value;
    }
    std::uint64_t varint() {
        std::uint64_t value = 0;
        for (unsigned shift = 0; shift < 64; shift += 7) {
            const std::string_view byte = take(1);
            if (failed_) return 0;
            value |= std::uint64_t{static_cast<unsigned char>(byte[0]) & 0x7FU} << shift;
            if ((static_cast<unsigned char>(byte[0]) & 0x80U) == 0) return value;
        }
        failed_ = true;
        return 0;
    }

    std::string_view left_;
    bool failed_ = false;
};

void take_field(Metric& metric, const Field& field) {
    switch (field.number) {
        case 1:
            metric.name = std::string(field.bytes);
            break;
        case 2:
            metric.alias = field.value;
            break;
        case 3:
            metric.timestamp = field.value;
            break;
        case 4:
            metric.type = static_cast<DataType>(field.value);
            break;
        case 5:
            metric.is_historical = field.value != 0;
            break;
        case 10:
            metric.value =
                metric.type == DataType::int32
                    ? std::int64_t{static_cast<std::int32_t>(static_cast<std::uint32_t>(field.value))}
                    : static_cast<std::int64_t>(field.value);
            break;
        case 11:
            metric.value = static_cast<std::int64_t>(field.value);
            break;
        case 12:
            metric.value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(field.value)));
            break;
        case 13:
            metric.value = std::bit_cast<double>(field.value);
            break;
        case 14:
            metric.value = field.value != 0;
            break;
        case 15:
            metric.value = std::string(field.bytes);
            break;
        default:
            break;
    }
}

}  // namespace

std::string encode(const Payload& payload) {
    std::string out;
    if (payload.timestamp) put_number(out, 1, *payload.timestamp);
    for (const Metric& metric : payload.metrics) put_bytes(out, 2, encode_metric(metric));
    if (payload.seq) put_number(out, 3, *payload.seq);
    return out;
}

std::optional<Payload> decode(std::string_view bytes) {
    Payload payload;
    Reader reader(bytes);
    while (const auto field = reader.next()) {
        if (field->number == 1) payload.timestamp = field->value;
        if (field->number == 3) payload.seq = field->value;
        if (field->number != 2) continue;
        Reader inner(field->bytes);
        Metric metric;
        while (const auto part = inner.next()) take_field(metric, *part);
        if (inner.failed()) return std::nullopt;
        payload.metrics.push_back(std::move(metric));
    }
    if (reader.failed()) return std::nullopt;
    return payload;
}

}  // namespace nplc::mqtt
