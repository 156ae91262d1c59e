// SPDX-License-Identifier: MIT
#include "hyoryu/io/png.hpp"

#include "hyoryu/io/results.hpp"

#include <libdeflate.h>

#include <memory>
#include <string>
#include <string_view>

namespace hyoryu {

namespace {

std::string big_endian(std::uint32_t value)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(value >> shift & 0xFFU);
    }
    return bytes;
}

std::string chunk(std::string_view type, const std::string& data)
{
    const std::string body = std::string(type) + data;
    return big_endian(static_cast<std::uint32_t>(data.size())) + body +
           big_endian(libdeflate_crc32(0, body.data(), body.size()));
}

std::string compressed(const std::string& bytes)
{
    constexpr int level = 6;
    struct Freeing {
        void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
    };
    const std::unique_ptr<libdeflate_compressor, Freeing> compressor(
        libdeflate_alloc_compressor(level));
    std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                           packed.data(), packed.size()));
    return packed;
}

} // namespace

void write_png(const std::filesystem::path& file, const Pixels& pixels)
{
    std::string rows;
    const auto width = static_cast<std::size_t>(pixels.width);
    for (std::size_t k = 0; k < pixels.colour.size(); ++k) {
        if (k % width == 0) {
            rows += '\0'; // no filter
        }
        for (const std::uint8_t part : pixels.colour[k]) {
            rows += static_cast<char>(part);
        }
    }
    using namespace std::string_literals;
    const std::string header = big_endian(static_cast<std::uint32_t>(pixels.width)) +
                               big_endian(static_cast<std::uint32_t>(pixels.height)) +
                               "\x08\x02\0\0\0"s; // 8 bits, true colour
    write_text(file, "\x89PNG\r\n\x1a\n"s + chunk("IHDR", header) +
                         chunk("tEXt", "Software\0hyoryu"s) + chunk("IDAT", compressed(rows)) +
                         chunk("IEND", ""));
}

} // namespace hyoryu
