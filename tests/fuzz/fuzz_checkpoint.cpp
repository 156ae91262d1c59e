// SPDX-License-Identifier: MIT
// Any bytes in the place of a checkpoint are one, or an error; and any state that bytes describe
// comes back from a checkpoint as it went in. The second asks what the first cannot: bytes that
// someone changed do not get past the checksum.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "scratch.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>

namespace hyoryu {
namespace {

/// Takes pieces off the front of the input; an input that has ended gives zeros and empty texts.
class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : left_(data, size) {}
    bool ended() const { return left_.empty(); }
    std::size_t number()
    {
        const std::string byte = text(1);
        return byte.empty() ? 0 : static_cast<std::uint8_t>(byte[0]);
    }
    std::string text(std::size_t length)
    {
        const auto piece = left_.first(std::min(length, left_.size()));
        left_ = left_.subspan(piece.size());
        return {piece.begin(), piece.end()};
    }
    /// A name as the program gives them: some letters and no end of a text among them.
    std::string name()
    {
        const std::string letters = text(1 + number() % 16);
        return letters.substr(0, letters.find('\0'));
    }

private:
    std::span<const std::uint8_t> left_;
};

template <class T>
std::vector<T> values(Input& input, int components)
{
    const std::string bytes = input.text(input.number() * sizeof(T));
    const std::size_t row = sizeof(T) * static_cast<std::size_t>(components);
    std::vector<T> result(bytes.size() / row * static_cast<std::size_t>(components));
    if (!result.empty()) {
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
    }
    return result;
}

Snapshot snapshot_of(Input input)
{
    Snapshot snapshot;
    while (!input.ended()) {
        const std::string name = input.name();
        const std::size_t kind = input.number() % 6;
        if (name.empty()) {
            continue;
        }
        if (kind == 0) {
            snapshot.texts[name] = input.text(input.number());
            continue;
        }
        Column column{input.name(), input.name(), input.number() % 2 == 0 ? 1 : 3, {}};
        switch (kind) {
        case 1:
            column.values = values<float>(input, column.components);
            break;
        case 2:
            column.values = values<double>(input, column.components);
            break;
        case 3:
            column.values = values<std::int32_t>(input, column.components);
            break;
        case 4:
            column.values = values<std::int64_t>(input, column.components);
            break;
        default:
            column.values = values<std::uint8_t>(input, column.components);
        }
        snapshot.arrays[name] = column;
    }
    return snapshot;
}

/// By their bytes: numbers that are none equal themselves.
bool equal(const Column& one, const Column& other)
{
    const auto bytes = [](const Column& column) {
        return std::visit([](const auto& values) { return std::as_bytes(std::span(values)); },
                          column.values);
    };
    return one.name == other.name && one.unit == other.unit && one.components == other.components &&
           one.values.index() == other.values.index() &&
           std::ranges::equal(bytes(one), bytes(other));
}

bool equal(const Snapshot& one, const Snapshot& other)
{
    return one.texts == other.texts &&
           std::ranges::equal(one.arrays, other.arrays, [](const auto& a, const auto& b) {
               return a.first == b.first && equal(a.second, b.second);
           });
}

} // namespace
} // namespace hyoryu

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hyoryu;
    static const test_help::Scratch scratch;
    const auto folder = scratch.put("checkpoint.h5", data, size).parent_path();
    try {
        read_newest_checkpoint(folder);
    } catch (const IoError&) {
        const auto written =
            folder / "written"; // what stands there is no older checkpoint of `folder`
        std::filesystem::create_directories(written);
        const Snapshot snapshot = snapshot_of({data, size});
        write_checkpoint(written, snapshot);
        if (!equal(read_checkpoint(written), snapshot)) {
            std::abort();
        }
    }
    return 0;
}
