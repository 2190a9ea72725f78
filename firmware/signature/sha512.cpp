#include "signature/sha512.h"

#include <bit>

namespace nplc::signature {
namespace {

constexpr std::array<std::uint64_t, 80> kRounds{
    0x428A2F98D728AE22, 0x7137449123EF65CD, 0xB5C0FBCFEC4D3B2F, 0xE9B5DBA58189DBBC, 0x3956C25BF348B538,
    0x59F111F1B605D019, 0x923F82A4AF194F9B, 0xAB1C5ED5DA6D8118, 0xD807AA98A3030242, 0x12835B0145706FBE,
    0x243185BE4EE4B28C, 0x550C7DC3D5FFB4E2, 0x72BE5D74F27B896F, 0x80DEB1FE3B1696B1, 0x9BDC06A725C71235,
    0xC19BF174CF692694, 0xE49B69C19EF14AD2, 0xEFBE4786384F25E3, 0x0FC19DC68B8CD5B5, 0x240CA1CC77AC9C65,
    0x2DE92C6F592B0275, 0x4A7484AA6EA6E483, 0x5CB0A9DCBD41FBD4, 0x76F988DA831153B5, 0x983E5152EE66DFAB,
    0xA831C66D2DB43210, 0xB00327C898FB213F, 0xBF597FC7BEEF0EE4, 0xC6E00BF33DA88FC2, 0xD5A79147930AA725,
    0x06CA6351E003826F, 0x142929670A0E6E70, 0x27B70A8546D22FFC, 0x2E1B21385C26C926, 0x4D2C6DFC5AC42AED,
    0x53380D139D95B3DF, 0x650A73548BAF63DE, 0x766A0ABB3C77B2A8, 0x81C2C92E47EDAEE6, 0x92722C851482353B,
    0xA2BFE8A14CF10364, 0xA81A664BBC423001, 0xC24B8B70D0F89791, 0xC76C51A30654BE30, 0xD192E819D6EF5218,
    0xD69906245565A910, 0xF40E35855771202A, 0x106AA07032BBD1B8, 0x19A4C116B8D2D0C8, 0x1E376C085141AB53,
    0x2748774CDF8EEB99, 0x34B0BCB5E19B48A8, 0x391C0CB3C5C95A63, 0x4ED8AA4AE3418ACB, 0x5B9CCA4F7763E373,
    0x682E6FF3D6B2B8A3, 0x748F82EE5DEFB2FC, 0x78A5636F43172F60, 0x84C87814A1F0AB72, 0x8CC702081A6439EC,
    0x90BEFFFA23631E28, 0xA4506CEBDE82BDE9, 0xBEF9A3F7B2C67915, 0xC67178F2E372532B, 0xCA273ECEEA26619C,
    0xD186B8C721C0C207, 0xEADA7DD6CDE0EB1E, 0xF57D4F7FEE6ED178, 0x06F067AA72176FBA, 0x0A637DC5A2C898A6,
    0x113F9804BEF90DAE, 0x1B710B35131C471B, 0x28DB77F523047D84, 0x32CAAB7B40C72493, 0x3C9EBE0A15C9BEBC,
    0x431D67C49C100D4C, 0x4CC5D4BECB3E42B6, 0x597F299CFC657E2A, 0x5FCB6FAB3AD6FAEC, 0x6C44198C4A475817};

using Word = std::uint64_t;

Word load_big(const std::uint8_t* bytes) {
    Word value = 0;
    for (int i = 0; i < 8; ++i) value = (value << 8) | bytes[i];
    return value;
}

Word turned(Word value, int one, int two, int three) {
    return std::rotr(value, one) ^ std::rotr(value, two) ^ std::rotr(value, three);
}

/// The message schedule's next word; `w` holds the last 16.
Word next_word(std::array<Word, 16>& w, std::size_t round) {
    const Word a = w[(round + 1) % 16];
    const Word b = w[(round + 14) % 16];
    const Word small_0 = std::rotr(a, 1) ^ std::rotr(a, 8) ^ (a >> 7);
    const Word small_1 = std::rotr(b, 19) ^ std::rotr(b, 61) ^ (b >> 6);
    return w[round % 16] += small_0 + w[(round + 9) % 16] + small_1;
}

}  // namespace

void Sha512::work() {
    std::array<Word, 16> w;
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = load_big(&block_[8 * i]);
    std::array<Word, 8> v = state_;
    for (std::size_t round = 0; round < kRounds.size(); ++round) {
        const Word word = round < 16 ? w[round] : next_word(w, round);
        const Word choice = (v[4] & v[5]) ^ (~v[4] & v[6]);
        const Word majority = (v[0] & v[1]) ^ (v[0] & v[2]) ^ (v[1] & v[2]);
        const Word first = v[7] + turned(v[4], 14, 18, 41) + choice + kRounds[round] + word;
        const Word second = turned(v[0], 28, 34, 39) + majority;
        for (std::size_t i = 7; i > 0; --i) v[i] = v[i - 1];
        v[4] += first;
        v[0] = first + second;
    }
    for (std::size_t i = 0; i < v.size(); ++i) state_[i] += v[i];
}

void Sha512::take(std::uint8_t byte) {
    block_[bytes_ % kBlock] = byte;
    if (++bytes_ % kBlock == 0) work();
}

void Sha512::add(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) take(byte);
}

Digest512 Sha512::end() {
    constexpr std::size_t kLengthAt = kBlock - 16;
    const std::uint64_t bits = bytes_ * 8;
    take(0x80);
    while (bytes_ % kBlock != kLengthAt) take(0);
    for (int i = 0; i < 8; ++i) take(0);  // the length's upper half: there is no such memory
    for (int shift = 56; shift >= 0; shift -= 8) take(static_cast<std::uint8_t>(bits >> shift));
    Digest512 digest;
    for (std::size_t i = 0; i < digest.size(); ++i)
        digest[i] = static_cast<std::uint8_t>(state_[i / 8] >> (56 - 8 * (i % 8)));
    return digest;
}

}  // namespace nplc::signature
